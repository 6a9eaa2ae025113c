#pragma once

#include "tests/support/glb_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::test {

/// A point in micrometres.
using WholePlace = std::array<std::int64_t, 3>;

/// The directed edges of a face, of which none is met by its opposite.
class FaceEdges {
 public:
  void add(const WholePlace& from, const WholePlace& to) {
    if (from != to && edges_.erase({to, from}) == 0) edges_.insert({from, to});
  }
  [[nodiscard]] bool is_empty() const { return edges_.empty(); }
  [[nodiscard]] std::string text() const {
    std::string text;
    for (const auto& [from, to] : edges_)
      text += fmt::format("{} {} {}>{} {} {};", from[0], from[1], from[2], to[0], to[1], to[2]);
    return text;
  }

 private:
  std::set<std::pair<WholePlace, WholePlace>> edges_;
};

/// What a face is: its semantic surface, and its feature with all that the tables say of it.
struct FaceMeaning {
  std::string surface, id, label, rule;
  float score = -1;
  [[nodiscard]] std::string text() const {
    return fmt::format("{}|{}|{}|{}|{}|", surface, id, label, rule, score);
  }
};

/// The faces of a building: what each is and its edges, sorted.
using FaceTexts = std::vector<std::string>;

/// The faces of the buildings in the files of a level of a series, read by the tests' own.
/// Buildings that are not oriel's, as a selection leaves them in their records, are passed over.
class LevelFaces {
 public:
  /// Adds a file, or a line with the transform of its header.
  void add(const nlohmann::json& city, const nlohmann::json& transform) {
    places_.clear();
    installation_at_.clear();
    for (const auto& vertex : city["vertices"]) {
      WholePlace place{};
      for (std::size_t i = 0; i < 3; ++i)
        place[i] =
            std::llround(1e6 * (vertex[i].get<double>() * transform["scale"][i].get<double>() +
                                transform["translate"][i].get<double>()));
      places_.push_back(place);
    }
    for (const auto& [id, object] : city["CityObjects"].items())
      if (object["type"] == "BuildingInstallation") add_installation(id, object);
    for (const auto& [id, object] : city["CityObjects"].items())
      if (object.value("attributes", nlohmann::json::object()).contains("oriel_version"))
        add_building(id, highest(object["geometry"]));
  }

  [[nodiscard]] const std::map<std::string, FaceTexts>& faces() const { return faces_; }
  /// The vertices of a building; none if it was passed over.
  [[nodiscard]] std::set<WholePlace> places(const std::string& building) const {
    const auto found = used_.find(building);
    return found == used_.end() ? std::set<WholePlace>() : found->second;
  }

 private:
  /// The geometry of the highest level of detail.
  static const nlohmann::json& highest(const nlohmann::json& geometries) {
    return *std::ranges::max_element(
        geometries, {}, [](const nlohmann::json& one) { return one["lod"].get<std::string>(); });
  }
  [[nodiscard]] FaceEdges edges_of(const nlohmann::json& rings) const {
    FaceEdges edges;
    for (const auto& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i)
        edges.add(places_.at(ring[i]), places_.at(ring[(i + 1) % ring.size()]));
    return edges;
  }
  static FaceMeaning meaning_of(const nlohmann::json& members) {
    return {"", members.value("oriel_id", ""), members.value("oriel_label", ""),
            members.value("oriel_rule", ""),
            static_cast<float>(members.value("oriel_score", -1.0))};
  }

  void add_installation(const std::string& id, const nlohmann::json& object) {
    FaceMeaning meaning = meaning_of(object["attributes"]);
    meaning.id = id;
    for (const auto& polygon : object["geometry"][0]["boundaries"])
      installation_at_[edges_of(polygon).text()] = meaning;
  }

  void add_building(const std::string& id, const nlohmann::json& geometry) {
    if (geometry["type"] != "Solid" || !geometry.contains("semantics")) return;
    const auto& surfaces = geometry["semantics"]["surfaces"];
    const auto& boundaries = geometry["boundaries"];
    const auto& values = geometry["semantics"]["values"];
    for (std::size_t shell = 0; shell < boundaries.size(); ++shell)
      for (std::size_t f = 0; f < boundaries[shell].size(); ++f)
        if (!values[shell][f].is_null())
          add_face(id, boundaries[shell][f], surfaces[values[shell][f].get<std::size_t>()]);
    std::ranges::sort(faces_[id]);
  }

  void add_face(const std::string& building, const nlohmann::json& rings,
                const nlohmann::json& surface) {
    const FaceEdges edges = edges_of(rings);
    if (edges.is_empty()) return;
    FaceMeaning meaning = meaning_of(surface);
    const std::string type = surface["type"];
    const auto found = installation_at_.find(edges.text());
    if (found != installation_at_.end() && type != "Window" && type != "Door")
      meaning = found->second;
    else if (meaning.label.empty())
      meaning.label = label_of(type);
    meaning.surface = type;
    faces_[building].push_back(meaning.text() + edges.text());
    for (const auto& ring : rings)
      for (const auto& v : ring) used_[building].insert(places_.at(v));
  }

  static std::string label_of(std::string type) {
    if (type.ends_with("Surface")) type.resize(type.size() - 7);
    std::ranges::transform(type, type.begin(), [](unsigned char c) { return std::tolower(c); });
    return type;
  }

  std::vector<WholePlace> places_;
  std::map<std::string, FaceMeaning> installation_at_;
  std::map<std::string, FaceTexts> faces_;
  std::map<std::string, std::set<WholePlace>> used_;
};

/// The faces of the buildings of a GLB: triangles that share points make a face again, and its
/// points are put back to the vertices of `level` that lie within the resolution of single numbers.
/// A building with a point that has none there has no faces.
class TileFaces {
 public:
  TileFaces(const GlbReader& glb, const std::array<double, 3>& shift, const LevelFaces& level)
      : rows_(glb.rows()), ids_(glb.feature_ids()), corners_(glb.indices()) {
    const auto points = glb.points();
    double largest = 1;
    for (const float number : glb.local_numbers())
      largest = std::max(largest, std::abs(static_cast<double>(number)));
    std::map<std::string, std::set<WholePlace>> vertices;
    reach_ = std::max<std::int64_t>(1, std::llround(1e6 * largest * kUnit));
    for (std::size_t v = 0; v < points.size(); ++v) {
      const std::string& building = row(v).building;
      WholePlace place{};
      for (std::size_t i = 0; i < 3; ++i) place[i] = std::llround(1e6 * (points[v][i] + shift[i]));
      const auto known = vertices.try_emplace(building).first;
      if (known->second.empty()) known->second = level.places(building);
      places_.push_back(back(place, known->second));
      if (!places_.back()) astray_.insert(building);
    }
    gather();
  }

  [[nodiscard]] const std::map<std::string, FaceTexts>& faces() const { return faces_; }

 private:
  /// Two units in the last place of a single number, of two that are added.
  static constexpr double kUnit = 1.0 / (1 << 22);

  [[nodiscard]] const GlbRow& row(std::size_t vertex) const {
    return rows_.at(static_cast<std::size_t>(ids_.at(vertex)));
  }

  /// The vertex within reach, if there is one and no other.
  [[nodiscard]] std::optional<WholePlace> back(const WholePlace& place,
                                               const std::set<WholePlace>& vertices) const {
    std::optional<WholePlace> found;
    const WholePlace least{place[0] - reach_, INT64_MIN, INT64_MIN};
    for (auto one = vertices.lower_bound(least); one != vertices.end(); ++one) {
      if ((*one)[0] > place[0] + reach_) break;
      if (std::abs((*one)[1] - place[1]) > reach_ || std::abs((*one)[2] - place[2]) > reach_)
        continue;
      if (found) return std::nullopt;
      found = *one;
    }
    return found;
  }

  std::uint32_t root(std::uint32_t v) {
    while (parents_[v] != v) v = parents_[v] = parents_[parents_[v]];
    return v;
  }

  void gather() {
    parents_.resize(places_.size());
    std::iota(parents_.begin(), parents_.end(), 0U);
    for (std::size_t i = 0; i < corners_.size(); i += 3)
      for (const std::size_t next : {i + 1, i + 2})
        parents_[root(corners_[next])] = root(corners_[i]);
    std::map<std::uint32_t, FaceEdges> edges_of;
    for (std::size_t i = 0; i < corners_.size(); ++i) {
      const std::size_t next = i % 3 == 2 ? i - 2 : i + 1;
      const auto &from = places_[corners_[i]], &to = places_[corners_[next]];
      if (from && to) edges_of[root(corners_[i])].add(*from, *to);
    }
    for (const auto& [vertex, edges] : edges_of) {
      const GlbRow& of = row(vertex);
      if (astray_.contains(of.building)) continue;
      const FaceMeaning meaning{of.surface, of.id, of.label, of.rule, of.score};
      faces_[of.building].push_back(meaning.text() + edges.text());
    }
    for (auto& [building, faces] : faces_) std::ranges::sort(faces);
  }

  std::vector<GlbRow> rows_;
  std::vector<float> ids_;
  std::vector<std::uint32_t> corners_;
  std::int64_t reach_ = 0;
  std::vector<std::optional<WholePlace>> places_;
  std::vector<std::uint32_t> parents_;
  std::set<std::string> astray_;
  std::map<std::string, FaceTexts> faces_;
};

}  // namespace oriel::test
