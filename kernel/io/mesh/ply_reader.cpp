#include "kernel/base/counted.h"
#include "kernel/io/json/words.h"
#include "kernel/io/mesh/mesh_reader.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

constexpr std::array<std::string_view, 16> kTypes{
    "char", "uchar", "short", "ushort", "int",   "uint",   "float",   "double",
    "int8", "uint8", "int16", "uint16", "int32", "uint32", "float32", "float64"};

struct PlyProperty {
  std::string name;
  bool is_list = false;
};

struct PlyElement {
  std::string name;
  long long count = 0;
  std::vector<PlyProperty> properties{};

  /// The place of a property, or nothing.
  [[nodiscard]] std::optional<std::size_t> find(std::string_view property) const {
    const auto found = std::ranges::find(properties, property, &PlyProperty::name);
    if (found == properties.end()) return std::nullopt;
    return static_cast<std::size_t>(found - properties.begin());
  }
};

class PlyReader {
 public:
  PlyReader(std::string_view text, const TextName& name) : name_(name), text_(text), words_(text) {}

  Checked<Document> read() {
    if (!read_header()) return refuse();
    for (const PlyElement& element : elements_)
      for (long long i = 0; i < element.count; ++i)
        if (!read_line(element, i)) return refuse();
    if (words_.next_line()) {
      fail(fmt::format("{} follows the last element; expected the end of the file",
                       in_quotes(*words_.next_word())));
      return refuse();
    }
    return document_of(std::move(mesh_), name_, Format::ply);
  }

 private:
  Checked<Document> refuse() { return {std::nullopt, {std::move(*issue_)}}; }

  bool fail(std::string sentence, Code code = Code::E110) {
    issue_ = error_at(name_, text_, words_.offset(), {code, std::move(sentence)});
    return false;
  }

  /// The next word, or an empty one at the line's end.
  std::string_view word() { return words_.next_word().value_or(std::string_view()); }

  bool ends_line(std::string_view what) {
    const std::string_view more = word();
    return more.empty() || fail(fmt::format("{} follows {}", in_quotes(more), what));
  }

  bool read_header() {
    if (!words_.next_line()) return fail("the file is empty; expected ply", Code::E102);
    if (const std::string_view first = word(); first != "ply")
      return fail(fmt::format("starts with {}; expected ply", in_quotes(first)), Code::E107);
    if (!ends_line("ply") || !read_format()) return false;
    while (words_.next_line()) {
      const std::string_view keyword = word();
      if (keyword == "end_header") return ends_line(keyword) && check_elements();
      if (!read_statement(keyword)) return false;
    }
    return fail("the file ends within its header; expected end_header");
  }

  bool read_format() {
    if (!words_.next_line() || word() != "format")
      return fail("expected format ascii 1.0 after ply");
    if (const std::string_view kind = word(); kind != "ascii")
      return fail(
          fmt::format("the format is {}; expected ascii: binary PLY is not read", in_quotes(kind)));
    if (const std::string_view version = word(); version != "1.0")
      return fail(fmt::format("the version is {}; expected 1.0", in_quotes(version)));
    return ends_line("the version");
  }

  bool read_statement(std::string_view keyword) {
    if (keyword == "obj_info") return true;
    if (keyword == "comment") return read_comment();
    if (keyword == "element") return read_element();
    if (keyword == "property") return read_property();
    return fail(
        fmt::format("unknown statement {}; expected element, property, comment or "
                    "end_header",
                    in_quotes(keyword)));
  }

  /// "comment feature 3 house window_w12" names a feature; all others are passed over.
  bool read_comment() {
    if (word() != "feature") return true;
    if (const auto number = as_whole(word())) features_[*number] = words_.rest_of_line();
    return true;
  }

  bool read_element() {
    PlyElement element{std::string(word())};
    const auto count = as_whole(word());
    if (!count || *count < 0)
      return fail(fmt::format("expected a number of elements after {}", in_quotes(element.name)));
    if (std::ranges::find(elements_, element.name, &PlyElement::name) != elements_.end())
      return fail(fmt::format("the element {} occurs here twice", in_quotes(element.name)));
    element.count = *count;
    elements_.push_back(std::move(element));
    return ends_line("the number of elements");
  }

  bool read_type(std::string_view type) {
    return std::ranges::find(kTypes, type) != kTypes.end() ||
           fail(fmt::format("{} is not a type of a property", in_quotes(type)));
  }

  bool read_property() {
    if (elements_.empty()) return fail("a property before any element");
    PlyProperty property;
    std::string_view type = word();
    property.is_list = type == "list";
    if (property.is_list) {
      if (!read_type(word())) return false;
      type = word();
    }
    if (!read_type(type)) return false;
    property.name = word();
    if (property.name.empty()) return fail("a property without a name");
    if (elements_.back().find(property.name))
      return fail(fmt::format("the property {} occurs here twice", in_quotes(property.name)));
    elements_.back().properties.push_back(std::move(property));
    return ends_line("the name of a property");
  }

  /// Finds the properties that are read.
  bool check_elements() {
    for (const PlyElement& element : elements_) {
      if (element.properties.empty())
        return fail(fmt::format("the element {} has no property", in_quotes(element.name)));
      if (element.name == "vertex" && !find_coordinates(element)) return false;
      if (element.name == "face" && !find_corners(element)) return false;
    }
    for (const std::string_view name : {"vertex", "face"})
      if (std::ranges::find(elements_, name, &PlyElement::name) == elements_.end())
        return fail(fmt::format("the header has no element {}", in_quotes(name)));
    return true;
  }

  bool find_coordinates(const PlyElement& element) {
    vertex_count_ = element.count;
    constexpr std::array<std::string_view, 3> kNames{"x", "y", "z"};
    for (std::size_t i = 0; i < kNames.size(); ++i) {
      const auto place = element.find(kNames[i]);
      if (!place || element.properties[*place].is_list)
        return fail(fmt::format("a vertex has no number {}", kNames[i]));
      coordinates_[i] = *place;
    }
    return true;
  }

  bool find_corners(const PlyElement& element) {
    auto place = element.find("vertex_indices");
    if (!place) place = element.find("vertex_index");
    if (!place || !element.properties[*place].is_list)
      return fail("a face has no list vertex_indices");
    corners_ = *place;
    feature_ = element.find("feature");
    return true;
  }

  /// Reads the line of element `i`: its numbers, those of lists with their count before them.
  bool read_line(const PlyElement& element, long long i) {
    if (!words_.next_line())
      return fail(fmt::format("the file ends after {} of {} elements {}", i, element.count,
                              in_quotes(element.name)));
    const bool is_good = element.name == "vertex" ? read_vertex(element)
                         : element.name == "face" ? read_face(element)
                                                  : pass_others(element);
    return is_good && ends_line("the last property");
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
      if (p == feature_ && !element.properties[p].is_list) {
        const auto number = read_number(element.properties[p]);
        if (!number) return false;
        hint = name_of_feature(*number);
      } else if (p == corners_ ? !read_corners() : !pass(element.properties[p])) {
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
    return property.is_list ? pass_list(property) : read_number(property).has_value();
  }

  std::optional<double> read_number(const PlyProperty& property) {
    const std::string_view text = word();
    const auto number = as_double(text);
    if (!number)
      fail(text.empty() ? fmt::format("the line ends before the property {}", property.name)
                        : fmt::format("{} is not a number", in_quotes(text)));
    return number;
  }

  bool check_finite(double coordinate) {
    return std::isfinite(coordinate) ||
           fail(fmt::format("the coordinate is {}; expected a finite number", coordinate),
                Code::E506);
  }

  std::optional<long long> read_count() {
    const std::string_view text = word();
    const auto count = as_whole(text);
    if (count && *count >= 0) return count;
    fail(fmt::format("{} is not the length of a list", in_quotes(text)));
    return std::nullopt;
  }

  bool pass_list(const PlyProperty& property) {
    const auto count = read_count();
    for (long long i = 0; count && i < *count; ++i)
      if (!read_number(property)) return false;
    return count.has_value();
  }

  bool read_corners() {
    const auto count = read_count();
    if (!count) return false;
    if (*count < 3)
      return fail(fmt::format("a face of {}; expected 3 or more (val3dity 101 "
                              "TOO_FEW_POINTS)",
                              counted(*count, "vertex", "vertices")),
                  Code::E311);
    std::vector<int> face;
    for (long long i = 0; i < *count; ++i) {
      const auto number = as_whole(word());
      if (!number) return fail(fmt::format("a face of {} vertices lists {}", *count, i));
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
    const auto found = features_.find(std::isfinite(number) ? std::llround(number) : -1);
    return found == features_.end() ? std::string() : found->second;
  }

  const TextName& name_;
  std::string_view text_;
  WordReader words_;
  std::vector<PlyElement> elements_;
  std::map<long long, std::string> features_;
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
  return PlyReader(text, name).read();
}

}  // namespace oriel::detail
