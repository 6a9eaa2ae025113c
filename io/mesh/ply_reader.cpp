#include "io/json/words.h"
#include "io/mesh/mesh_reader.h"
#include "io/mesh/ply_header.h"
#include "kernel/base/text/counted.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

/// The values of a PLY file's elements one after the other, in words or in bytes.
class PlyValues {
 public:
  virtual ~PlyValues() = default;

  /// Moves to the next element; false at the end of the file.
  virtual bool next_element() = 0;
  /// The value of a property that is no list; nothing, and what is `wrong`, if there is none.
  virtual std::optional<double> number(const PlyProperty& property, Fault& wrong) = 0;
  /// As number(), for the length of a list, at least 0, or a member of one.
  virtual std::optional<long long> length(const PlyProperty& property, Fault& wrong) = 0;
  virtual std::optional<long long> whole(const PlyProperty& property, Fault& wrong) = 0;
  /// What stands after the last property of an element, or after the last element, and its verb:
  /// "'x' follows".
  virtual std::optional<std::string> rest_of_element() = 0;
  virtual std::optional<std::string> rest_of_file() = 0;
  /// The finding at the value that was read last. `element` says which one it is of: "vertex 3".
  [[nodiscard]] virtual Issue error(const std::string& element, Fault fault) const = 0;
};

/// One line for each element.
class PlyWords final : public PlyValues {
 public:
  PlyWords(std::string_view text, const TextName& name, std::size_t start)
      : name_(name), text_(text), words_(text, start) {}

  bool next_element() override { return words_.next_line(); }

  std::optional<double> number(const PlyProperty& property, Fault& wrong) override {
    const std::string_view text = word();
    const auto number = as_double(text);
    if (!number)
      wrong = {Code::E110, text.empty()
                               ? fmt::format("the line ends before the property {}", property.name)
                               : fmt::format("{} is not a number", in_quotes(text))};
    return number;
  }

  std::optional<long long> length(const PlyProperty& /*property*/, Fault& wrong) override {
    const std::string_view text = word();
    const auto count = as_whole(text);
    if (count && *count >= 0) return count;
    wrong = {Code::E110, fmt::format("{} is not the length of a list", in_quotes(text))};
    return std::nullopt;
  }

  std::optional<long long> whole(const PlyProperty& property, Fault& wrong) override {
    const std::string_view text = word();
    const auto number = as_whole(text);
    if (!number)
      wrong = {Code::E110, text.empty()
                               ? fmt::format("the line ends within the list {}", property.name)
                               : fmt::format("{} is not a whole number", in_quotes(text))};
    return number;
  }

  std::optional<std::string> rest_of_element() override {
    if (const auto more = words_.next_word()) return in_quotes(*more) + " follows";
    return std::nullopt;
  }

  std::optional<std::string> rest_of_file() override {
    if (!words_.next_line()) return std::nullopt;
    return in_quotes(word()) + " follows";
  }

  [[nodiscard]] Issue error(const std::string& /*element*/, Fault fault) const override {
    return error_at(name_, text_, words_.offset(), std::move(fault));
  }

 private:
  /// The next word, or an empty one at the line's end.
  std::string_view word() { return words_.next_word().value_or(std::string_view()); }

  const TextName& name_;
  std::string_view text_;
  WordReader words_;
};

/// Elements without anything between them.
class PlyBytes final : public PlyValues {
 public:
  PlyBytes(std::string_view text, const TextName& name, const PlyHeader& header)
      : name_(name),
        rest_(text.substr(header.end)),
        is_little_endian_(header.encoding == PlyEncoding::little_endian) {}

  bool next_element() override { return !rest_.empty(); }

  std::optional<double> number(const PlyProperty& property, Fault& wrong) override {
    return read(property.type, property, wrong);
  }

  std::optional<long long> length(const PlyProperty& property, Fault& wrong) override {
    const auto count = read(*property.length_type, property, wrong);
    if (!count) return std::nullopt;
    if (*count >= 0) return static_cast<long long>(*count);
    wrong = {Code::E110, fmt::format("{} is not the length of a list", *count)};
    return std::nullopt;
  }

  std::optional<long long> whole(const PlyProperty& property, Fault& wrong) override {
    const auto number = read(property.type, property, wrong);
    if (!number) return std::nullopt;
    // Whole numbers of a PLY file have at most four bytes.
    if (*number == std::floor(*number) && std::abs(*number) < 0x1p32)
      return static_cast<long long>(*number);
    wrong = {Code::E110, fmt::format("{} is not a whole number", *number)};
    return std::nullopt;
  }

  std::optional<std::string> rest_of_element() override { return std::nullopt; }

  std::optional<std::string> rest_of_file() override {
    if (rest_.empty()) return std::nullopt;
    return fmt::format("{} {}", counted(rest_.size(), "byte"),
                       agreeing(rest_.size(), "follows", "follow"));
  }

  [[nodiscard]] Issue error(const std::string& element, Fault fault) const override {
    if (!element.empty()) fault.sentence = fmt::format("{}: {}", element, fault.sentence);
    return error_in(name_, std::move(fault));
  }

 private:
  std::optional<double> read(PlyType type, const PlyProperty& property, Fault& wrong) {
    const std::size_t size = size_of(type);
    if (rest_.size() < size) {
      wrong = {Code::E105, fmt::format("the file ends within the property {}", property.name)};
      return std::nullopt;
    }
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < size; ++i)
      bits = bits << 8U | static_cast<unsigned char>(rest_[is_little_endian_ ? size - 1 - i : i]);
    rest_.remove_prefix(size);
    return number_of(type, bits);
  }

  static double number_of(PlyType type, std::uint64_t bits) {
    switch (type) {
      case PlyType::int8:
        return static_cast<std::int8_t>(bits);
      case PlyType::int16:
        return static_cast<std::int16_t>(bits);
      case PlyType::int32:
        return static_cast<std::int32_t>(bits);
      case PlyType::float32:
        return std::bit_cast<float>(static_cast<std::uint32_t>(bits));
      case PlyType::float64:
        return std::bit_cast<double>(bits);
      default:
        return static_cast<double>(bits);
    }
  }

  const TextName& name_;
  std::string_view rest_;
  bool is_little_endian_;
};

/// Those of `text` after `header`. Both must outlive what is returned.
std::unique_ptr<PlyValues> ply_values(std::string_view text, const TextName& name,
                                      const PlyHeader& header) {
  if (header.encoding == PlyEncoding::words)
    return std::make_unique<PlyWords>(text, name, header.end);
  return std::make_unique<PlyBytes>(text, name, header);
}

class PlyReader {
 public:
  PlyReader(std::string_view text, const TextName& name, const PlyHeader& header)
      : name_(name), header_(header), text_(text), values_(ply_values(text, name, header)) {}

  Checked<Document> read() {
    if (!check_elements() || !read_elements()) return {std::nullopt, {std::move(*issue_)}};
    return document_of(std::move(mesh_), name_, Format::ply);
  }

 private:
  bool fail(Fault fault) {
    issue_ = values_->error(
        element_ == nullptr ? std::string() : fmt::format("{} {}", element_->name, number_),
        std::move(fault));
    return false;
  }

  bool fail(std::string sentence, Code code = Code::E110) {
    return fail({code, std::move(sentence)});
  }

  bool fail_in_header(std::string sentence) {
    issue_ = error_at(name_, text_, header_.end - 1, {Code::E110, std::move(sentence)});
    return false;
  }

  /// Finds the properties that are read.
  bool check_elements() {
    for (const PlyElement& element : header_.elements) {
      if (element.name == "vertex" && !find_coordinates(element)) return false;
      if (element.name == "face" && !find_corners(element)) return false;
    }
    for (const std::string_view name : {"vertex", "face"})
      if (std::ranges::find(header_.elements, name, &PlyElement::name) == header_.elements.end())
        return fail_in_header(fmt::format("the header has no element {}", in_quotes(name)));
    return true;
  }

  bool find_coordinates(const PlyElement& element) {
    vertex_count_ = element.count;
    constexpr std::array<std::string_view, 3> kNames{"x", "y", "z"};
    for (std::size_t i = 0; i < kNames.size(); ++i) {
      const auto place = element.find(kNames[i]);
      if (!place || element.properties[*place].is_list())
        return fail_in_header(fmt::format("a vertex has no number {}", kNames[i]));
      coordinates_[i] = *place;
    }
    return true;
  }

  bool find_corners(const PlyElement& element) {
    auto place = element.find("vertex_indices");
    if (!place) place = element.find("vertex_index");
    if (!place || !element.properties[*place].is_list())
      return fail_in_header("a face has no list vertex_indices");
    corners_ = *place;
    feature_ = element.find("feature");
    return true;
  }

  bool read_elements() {
    for (const PlyElement& element : header_.elements)
      for (long long i = 0; i < element.count; ++i)
        if (!read_element(element, i)) return false;
    element_ = nullptr;
    const auto more = values_->rest_of_file();
    return !more || fail(*more + " the last element; expected the end of the file");
  }

  /// Reads element `i`: its numbers, those of lists with their count before them.
  bool read_element(const PlyElement& element, long long i) {
    element_ = nullptr;
    if (!values_->next_element())
      return fail(fmt::format("the file ends after {} of {} elements {}", i, element.count,
                              in_quotes(element.name)),
                  header_.encoding == PlyEncoding::words ? Code::E110 : Code::E105);
    element_ = &element;
    number_ = i;
    const bool is_good = element.name == "vertex" ? read_vertex(element)
                         : element.name == "face" ? read_face(element)
                                                  : pass_others(element);
    if (!is_good) return false;
    const auto more = values_->rest_of_element();
    return !more || fail(*more + " the last property");
  }

  bool read_vertex(const PlyElement& element) {
    std::array<double, 3> point{};
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const auto* const axis = std::ranges::find(coordinates_, p);
      if (axis == coordinates_.end()) {
        if (!pass(element.properties[p])) return false;
        continue;
      }
      const auto number = read_number(element.properties[p]);
      if (!number || !check_finite(*number)) return false;
      point[static_cast<std::size_t>(axis - coordinates_.begin())] = *number;
    }
    mesh_.points.push_back({point[0], point[1], point[2]});
    return true;
  }

  bool read_face(const PlyElement& element) {
    std::string hint;
    for (std::size_t p = 0; p < element.properties.size(); ++p) {
      const PlyProperty& property = element.properties[p];
      if (p == feature_ && !property.is_list()) {
        const auto number = read_number(property);
        if (!number) return false;
        hint = name_of_feature(*number);
      } else if (p == corners_ ? !read_corners(property) : !pass(property)) {
        return false;
      }
    }
    mesh_.hints.push_back(std::move(hint));
    return true;
  }

  bool pass_others(const PlyElement& element) {
    return std::ranges::all_of(element.properties,
                               [&](const PlyProperty& property) { return pass(property); });
  }

  bool pass(const PlyProperty& property) {
    return property.is_list() ? pass_list(property) : read_number(property).has_value();
  }

  std::optional<double> read_number(const PlyProperty& property) {
    Fault wrong;
    const auto number = values_->number(property, wrong);
    if (!number) fail(std::move(wrong));
    return number;
  }

  bool check_finite(double coordinate) {
    return std::isfinite(coordinate) ||
           fail(fmt::format("the coordinate is {}; expected a finite number", coordinate),
                Code::E506);
  }

  std::optional<long long> read_length(const PlyProperty& property) {
    Fault wrong;
    const auto length = values_->length(property, wrong);
    if (!length) fail(std::move(wrong));
    return length;
  }

  bool pass_list(const PlyProperty& property) {
    const auto count = read_length(property);
    for (long long i = 0; count && i < *count; ++i)
      if (!read_number(property)) return false;
    return count.has_value();
  }

  bool read_corners(const PlyProperty& property) {
    const auto count = read_length(property);
    if (!count) return false;
    if (*count < 3)
      return fail(fmt::format("a face of {}; expected 3 or more (val3dity 101 "
                              "TOO_FEW_POINTS)",
                              counted(*count, "vertex", "vertices")),
                  Code::E311);
    std::vector<int> face;
    for (long long i = 0; i < *count; ++i) {
      Fault wrong;
      const auto number = values_->whole(property, wrong);
      if (!number) {
        wrong.sentence =
            fmt::format("a face of {} vertices lists {}: {}", *count, i, wrong.sentence);
        return fail(std::move(wrong));
      }
      if (*number < 0 || *number >= vertex_count_)
        return fail(fmt::format("there is no vertex {}; there {} {}, counted from 0", *number,
                                agreeing(vertex_count_, "is", "are"), vertex_count_),
                    Code::E203);
      face.push_back(static_cast<int>(*number));
    }
    mesh_.faces.push_back(std::move(face));
    return true;
  }

  [[nodiscard]] std::string name_of_feature(double number) const {
    const auto found = header_.features.find(std::isfinite(number) ? std::llround(number) : -1);
    return found == header_.features.end() ? std::string() : found->second;
  }

  const TextName& name_;
  const PlyHeader& header_;
  std::string_view text_;
  std::unique_ptr<PlyValues> values_;
  /// The one that is read and its number; null between two.
  const PlyElement* element_ = nullptr;
  long long number_ = 0;
  long long vertex_count_ = 0;
  /// Places of properties: of vertices x, y, z, of faces the corners and the feature.
  std::array<std::size_t, 3> coordinates_{};
  std::size_t corners_ = 0;
  std::optional<std::size_t> feature_;
  RawMesh mesh_;
  std::optional<Issue> issue_;
};

}  // namespace

Checked<Document> read_ply(std::string_view text, const TextName& name) {
  Checked<PlyHeader> header = read_ply_header(text, name);
  if (!header.value) return {std::nullopt, std::move(header.issues)};
  return PlyReader(text, name, *header.value).read();
}

}  // namespace oriel::detail
