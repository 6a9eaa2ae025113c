#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <map>
#include <meshoptimizer.h>
#include <stdexcept>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace oriel::test {

/// A row of the property table, and what its triangles are.
struct GlbRow {
  std::string building, id, label, surface, rule;
  float score = 0, height = 0;
  std::size_t triangles = 0;
};

/// A GLB as oriel writes it, read by the tests' own: nothing of the writer is used.
class GlbReader {
 public:
  explicit GlbReader(const std::string& bytes) {
    if (bytes.substr(0, 4) != "glTF" || number(bytes, 4) != 2 || number(bytes, 8) != bytes.size())
      throw std::runtime_error("no GLB");
    const std::size_t size = number(bytes, 12);
    head_ = nlohmann::json::parse(bytes.substr(20, size));
    if (20 + size < bytes.size()) binary_ = bytes.substr(28 + size, number(bytes, 20 + size));
  }

  [[nodiscard]] const nlohmann::json& head() const { return head_; }

  /// Positions with the translation of the node, z up.
  [[nodiscard]] std::vector<std::array<double, 3>> points() const {
    std::array<double, 3> shift{};
    if (head_["nodes"][0].contains("translation")) shift = head_["nodes"][0]["translation"];
    const auto flat = numbers<float>(attribute("POSITION"));
    std::vector<std::array<double, 3>> out;
    for (std::size_t i = 0; i + 2 < flat.size(); i += 3)
      out.push_back({flat[i] + shift[0], -(flat[i + 2] + shift[2]), flat[i + 1] + shift[1]});
    return out;
  }

  /// Positions as they are stored, one number behind the other.
  [[nodiscard]] std::vector<float> local_numbers() const {
    return numbers<float>(attribute("POSITION"));
  }

  [[nodiscard]] std::vector<std::uint32_t> indices(std::size_t primitive = 0) const {
    const auto& accessor = head_["accessors"][number_at(primitive)];
    if (accessor["componentType"] == 5125) return numbers<std::uint32_t>(accessor);
    const auto shorts = numbers<std::uint16_t>(accessor);
    return {shorts.begin(), shorts.end()};
  }

  [[nodiscard]] std::vector<std::array<unsigned char, 4>> colours() const {
    const auto flat = numbers<unsigned char>(attribute("COLOR_0"));
    std::vector<std::array<unsigned char, 4>> out(flat.size() / 4);
    std::memcpy(out.data(), flat.data(), flat.size());
    return out;
  }

  [[nodiscard]] std::vector<float> feature_ids() const {
    return numbers<float>(attribute("_FEATURE_ID_0"));
  }

  [[nodiscard]] std::vector<GlbRow> rows() const {
    const auto& metadata = head_["extensions"]["EXT_structural_metadata"];
    const auto& table = metadata["propertyTables"][0];
    std::vector<GlbRow> rows(table["count"].get<std::size_t>());
    const auto& columns = table["properties"];
    const auto labels = view<std::uint16_t>(columns["label"]["values"]),
               surfaces = view<std::uint16_t>(columns["surface"]["values"]);
    const auto scores = view<float>(columns["score"]["values"]),
               heights = view<float>(columns["height"]["values"]);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      rows[i].building = text(columns["building"], i);
      rows[i].id = text(columns["id"], i);
      rows[i].rule = text(columns["rule"], i);
      rows[i].label = name(metadata["schema"]["enums"]["label"], labels.at(i));
      rows[i].surface = name(metadata["schema"]["enums"]["surface"], surfaces.at(i));
      rows[i].score = scores.at(i);
      rows[i].height = heights.at(i);
    }
    const auto ids = feature_ids();
    const auto corners = indices();
    for (std::size_t i = 0; i < corners.size(); i += 3)
      ++rows.at(static_cast<std::size_t>(ids.at(corners[i]))).triangles;
    return rows;
  }

  /// How often each label is a feature's, of those with an id, by building.
  [[nodiscard]] std::map<std::string, std::map<std::string, int>> labels() const {
    std::map<std::string, std::map<std::string, std::string>> seen;
    for (const GlbRow& row : rows())
      if (!row.id.empty()) seen[row.building][row.id] = row.label;
    std::map<std::string, std::map<std::string, int>> counts;
    for (const auto& [building, features] : seen)
      for (const auto& [id, label] : features) ++counts[building][label];
    return counts;
  }

  /// The bytes of a view; what is compressed comes decoded.
  [[nodiscard]] std::string view_bytes(std::size_t number) const {
    const auto& view = head_["bufferViews"][number];
    const auto whole = [&](const nlohmann::json& of, const char* name) {
      return of[name].get<std::size_t>();
    };
    if (!view.contains("extensions"))
      return binary_.substr(whole(view, "byteOffset"), whole(view, "byteLength"));
    const auto& packed = view["extensions"]["EXT_meshopt_compression"];
    std::string bytes(whole(view, "byteLength"), '\0');
    const auto* from =
        reinterpret_cast<const unsigned char*>(binary_.data()) + whole(packed, "byteOffset");
    const std::size_t size = whole(packed, "byteLength"), count = whole(packed, "count"),
                      stride = whole(packed, "byteStride");
    const int fault = packed["mode"] == "ATTRIBUTES"
                          ? meshopt_decodeVertexBuffer(bytes.data(), count, stride, from, size)
                          : meshopt_decodeIndexSequence(bytes.data(), count, stride, from, size);
    if (fault != 0 || count * stride != bytes.size())
      throw std::runtime_error("a view that cannot be decoded");
    return bytes;
  }

 private:
  static std::size_t number(const std::string& bytes, std::size_t at) {
    std::uint32_t value = 0;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  }
  [[nodiscard]] std::size_t number_at(std::size_t primitive) const {
    return head_["meshes"][0]["primitives"][primitive]["indices"].get<std::size_t>();
  }
  [[nodiscard]] const nlohmann::json& attribute(const char* name) const {
    return head_["accessors"]
                [head_["meshes"][0]["primitives"][0]["attributes"][name].get<std::size_t>()];
  }
  template <class Number>
  [[nodiscard]] std::vector<Number> view(const nlohmann::json& index) const {
    const std::string bytes = view_bytes(index.get<std::size_t>());
    std::vector<Number> out(bytes.size() / sizeof(Number));
    std::memcpy(out.data(), bytes.data(), out.size() * sizeof(Number));
    return out;
  }
  template <class Number>
  [[nodiscard]] std::vector<Number> numbers(const nlohmann::json& accessor) const {
    const std::map<std::string, std::size_t> sizes{{"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}};
    auto all = view<Number>(accessor["bufferView"]);
    if (all.size() !=
        accessor["count"].get<std::size_t>() * sizes.at(accessor["type"].get<std::string>()))
      throw std::runtime_error("an accessor has not the length of its view");
    return all;
  }
  [[nodiscard]] std::string text(const nlohmann::json& column, std::size_t row) const {
    const auto offsets = view<std::uint32_t>(column["stringOffsets"]);
    const auto letters = view<char>(column["values"]);
    return {letters.data() + offsets.at(row), offsets.at(row + 1) - offsets.at(row)};
  }
  static std::string name(const nlohmann::json& enumeration, unsigned value) {
    for (const auto& one : enumeration["values"])
      if (one["value"] == value) return one["name"];
    throw std::runtime_error("a value that the enumeration does not have");
  }

  nlohmann::json head_;
  std::string binary_;
};

}  // namespace oriel::test
