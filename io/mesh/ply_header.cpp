#include "io/mesh/ply_header.h"

#include "io/json/words.h"

#include <algorithm>
#include <array>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

struct NamedPlyType {
  std::string_view name;
  PlyType type;
};

constexpr std::array<NamedPlyType, 16> kPlyTypes{{{"char", PlyType::int8},
                                                  {"uchar", PlyType::uint8},
                                                  {"short", PlyType::int16},
                                                  {"ushort", PlyType::uint16},
                                                  {"int", PlyType::int32},
                                                  {"uint", PlyType::uint32},
                                                  {"float", PlyType::float32},
                                                  {"double", PlyType::float64},
                                                  {"int8", PlyType::int8},
                                                  {"uint8", PlyType::uint8},
                                                  {"int16", PlyType::int16},
                                                  {"uint16", PlyType::uint16},
                                                  {"int32", PlyType::int32},
                                                  {"uint32", PlyType::uint32},
                                                  {"float32", PlyType::float32},
                                                  {"float64", PlyType::float64}}};

struct NamedPlyEncoding {
  std::string_view name;
  PlyEncoding encoding;
};

constexpr std::array<NamedPlyEncoding, 3> kPlyEncodings{
    {{"ascii", PlyEncoding::words},
     {"binary_little_endian", PlyEncoding::little_endian},
     {"binary_big_endian", PlyEncoding::big_endian}}};

bool is_whole(PlyType type) { return type != PlyType::float32 && type != PlyType::float64; }

class PlyHeaderReader {
 public:
  PlyHeaderReader(std::string_view text, const TextName& name)
      : name_(name), text_(text), words_(text) {}

  Checked<PlyHeader> read() {
    if (!read_lines()) return {std::nullopt, {std::move(*issue_)}};
    header_.end = std::min(text_.find('\n', words_.offset()), text_.size() - 1) + 1;
    return {std::move(header_), {}};
  }

 private:
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

  bool read_lines() {
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
    const std::string_view kind = word();
    const auto* const found = std::ranges::find(kPlyEncodings, kind, &NamedPlyEncoding::name);
    if (found == kPlyEncodings.end())
      return fail(
          fmt::format("the format is {}; expected ascii, binary_little_endian or "
                      "binary_big_endian",
                      in_quotes(kind)));
    header_.encoding = found->encoding;
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

  /// All comments but those that name a feature are passed over.
  bool read_comment() {
    if (word() != "feature") return true;
    if (const auto number = as_whole(word())) header_.features[*number] = words_.rest_of_line();
    return true;
  }

  bool read_element() {
    PlyElement element{std::string(word())};
    const auto count = as_whole(word());
    if (!count || *count < 0)
      return fail(fmt::format("expected a number of elements after {}", in_quotes(element.name)));
    if (std::ranges::find(header_.elements, element.name, &PlyElement::name) !=
        header_.elements.end())
      return fail(fmt::format("the element {} occurs here twice", in_quotes(element.name)));
    element.count = *count;
    header_.elements.push_back(std::move(element));
    return ends_line("the number of elements");
  }

  std::optional<PlyType> read_type(std::string_view name) {
    const auto* const found = std::ranges::find(kPlyTypes, name, &NamedPlyType::name);
    if (found != kPlyTypes.end()) return found->type;
    fail(fmt::format("{} is not a type of a property", in_quotes(name)));
    return std::nullopt;
  }

  bool read_property() {
    if (header_.elements.empty()) return fail("a property before any element");
    PlyProperty property;
    std::string_view type_name = word();
    if (type_name == "list") {
      property.length_type = read_type(word());
      if (!property.length_type) return false;
      if (header_.encoding != PlyEncoding::words && !is_whole(*property.length_type))
        return fail("the length of a list is no whole number");
      type_name = word();
    }
    const auto type = read_type(type_name);
    if (!type) return false;
    property.type = *type;
    property.name = word();
    if (property.name.empty()) return fail("a property without a name");
    if (header_.elements.back().find(property.name))
      return fail(fmt::format("the property {} occurs here twice", in_quotes(property.name)));
    header_.elements.back().properties.push_back(std::move(property));
    return ends_line("the name of a property");
  }

  bool check_elements() {
    for (const PlyElement& element : header_.elements)
      if (element.properties.empty())
        return fail(fmt::format("the element {} has no property", in_quotes(element.name)));
    return true;
  }

  const TextName& name_;
  std::string_view text_;
  WordReader words_;
  PlyHeader header_;
  std::optional<Issue> issue_;
};

}  // namespace

std::size_t size_of(PlyType type) {
  constexpr std::array<std::size_t, 8> kSizes{1, 1, 2, 2, 4, 4, 4, 8};
  return kSizes[static_cast<std::size_t>(type)];
}

std::optional<std::size_t> PlyElement::find(std::string_view property) const {
  const auto found = std::ranges::find(properties, property, &PlyProperty::name);
  if (found == properties.end()) return std::nullopt;
  return static_cast<std::size_t>(found - properties.begin());
}

Checked<PlyHeader> read_ply_header(std::string_view text, const TextName& name) {
  return PlyHeaderReader(text, name).read();
}

}  // namespace oriel::detail
