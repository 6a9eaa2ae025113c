#include "io/citygml/write/gml_attributes.h"

#include "io/citygml/write/xml_text.h"
#include "io/citygml/xml_node.h"
#include "kernel/base/text/json_text.h"
#include "kernel/base/text/xml.h"

#include <algorithm>
#include <array>
#include <optional>

namespace oriel::detail {

namespace {

/// What an element of the schema may hold.
enum class ElementKind { code, codes, text, year, date, whole, measure, measures };

struct ElementRule {
  std::string_view attribute;
  ElementKind kind = ElementKind::text;
  bool is_in_version_3 = true;
};

constexpr std::array<ElementRule, 3> kCodes{{{"class", ElementKind::code},
                                             {"function", ElementKind::codes},
                                             {"usage", ElementKind::codes}}};

/// In the order of the schema.
constexpr std::array<ElementRule, 8> kOfBuildings{
    {{"yearOfConstruction", ElementKind::year, false},
     {"yearOfDemolition", ElementKind::year, false},
     {"roofType", ElementKind::code},
     {"measuredHeight", ElementKind::measure, false},
     {"storeysAboveGround", ElementKind::whole},
     {"storeysBelowGround", ElementKind::whole},
     {"storeyHeightsAboveGround", ElementKind::measures, false},
     {"storeyHeightsBelowGround", ElementKind::measures, false}}};

constexpr std::array<ElementRule, 2> kDates{
    {{"creationDate", ElementKind::date}, {"terminationDate", ElementKind::date}}};

bool has_shape(std::string_view text, std::string_view shape) {
  return text.size() == shape.size() && std::ranges::equal(text, shape, [](char c, char of) {
           return of == '0' ? c >= '0' && c <= '9' : c == of;
         });
}

/// A scalar as it stands in XML; nothing for a list, a set, or no value.
std::optional<std::string> scalar_text(const CityValue& value) {
  if (const auto* text = value.get<std::string>()) return *text;
  if (const auto* whole = value.get<std::int64_t>()) return std::to_string(*whole);
  if (const auto* number = value.get<double>()) return shortest(*number);
  if (const auto* truth = value.get<bool>()) return *truth ? "true" : "false";
  return std::nullopt;
}

bool is_plain_text(const CityValue& value) {
  const auto* text = value.get<std::string>();
  return text != nullptr && text->find_first_not_of(" \t\r\n") != std::string::npos;
}

bool are_texts(const CityValue& value) {
  const auto* list = value.get<CityList>();
  return list != nullptr && list->size() > 1 && std::ranges::all_of(*list, is_plain_text);
}

bool is_numeric_value(const CityValue& value) {
  return value.get<double>() != nullptr || value.get<std::int64_t>() != nullptr;
}

/// True if the element can hold the value so that it is read back the same.
bool fits(const CityValue& value, ElementKind kind, GmlVersion version) {
  const auto* text = value.get<std::string>();
  const auto* whole = value.get<std::int64_t>();
  const auto* list = value.get<CityList>();
  switch (kind) {
    case ElementKind::code:
    case ElementKind::text:
      return is_plain_text(value);
    case ElementKind::codes:
      return is_plain_text(value) || are_texts(value);
    case ElementKind::year:
      return whole != nullptr && *whole >= 1000 && *whole <= 9999;
    case ElementKind::date:
      return text != nullptr &&
             (version == GmlVersion::two ? has_shape(*text, "0000-00-00")
                                         : has_shape(text->substr(0, 19), "0000-00-00T00:00:00") &&
                                               (text->size() == 19 || text->substr(19) == "Z"));
    case ElementKind::whole:
      return whole != nullptr && *whole >= 0;
    case ElementKind::measure:
      return is_numeric_value(value);
    case ElementKind::measures:
      return list != nullptr && !list->empty() && std::ranges::all_of(*list, is_numeric_value);
  }
  return false;
}

class AttributeWriter {
 public:
  AttributeWriter(GmlVersion version, GmlOwner owner) : version_(version), owner_(owner) {}

  GmlAttributes write(const CityMembers& members, std::string_view id) {
    for (const std::string_view name : {"description", "name"}) {
      const CityValue* value = member_of(members, name);
      if (value == nullptr || !(is_plain_text(*value) || (name == "name" && are_texts(*value))))
        continue;
      append_values(attributes_.names, "gml:" + std::string(name), *value);
      done_.push_back(name);
    }
    for (const ElementRule& rule : kDates) put(members, rule, "core:", attributes_.generic);
    if (owner_ != GmlOwner::surface)
      for (const ElementRule& rule : kCodes) put(members, rule, "bldg:", attributes_.building);
    if (owner_ == GmlOwner::building) write_building(members);
    for (const auto& [name, value] : members)
      if (std::ranges::find(done_, name) == done_.end())
        append_generic(attributes_.generic, name, value);
    if (!id.empty()) append_generic(attributes_.generic, kObjectId, {std::string(id)});
    return std::move(attributes_);
  }

 private:
  void write_building(const CityMembers& members) {
    for (const ElementRule& rule : kOfBuildings)
      if (version_ == GmlVersion::two || rule.is_in_version_3)
        put(members, rule, "bldg:", attributes_.building);
    const CityValue* height = member_of(members, "measuredHeight");
    if (version_ == GmlVersion::two || height == nullptr || !is_numeric_value(*height)) return;
    std::string& out = attributes_.construction;
    out += "<con:height><con:Height>\n";
    append_element(out, "con:highReference", "highestRoofEdge");
    append_element(out, "con:lowReference", "lowestGroundPoint");
    append_element(out, "con:status", "measured");
    append_element(out, "con:value", *scalar_text(*height), R"( uom="m")");
    out += "</con:Height></con:height>\n";
    done_.push_back("measuredHeight");
  }

  void put(const CityMembers& members, const ElementRule& rule, std::string_view prefix,
           std::string& out) {
    const CityValue* value = member_of(members, rule.attribute);
    if (value == nullptr || !fits(*value, rule.kind, version_)) return;
    done_.push_back(rule.attribute);
    const std::string name = std::string(prefix).append(rule.attribute);
    if (rule.kind == ElementKind::measure)
      append_element(out, name, *scalar_text(*value), R"( uom="m")");
    else if (rule.kind == ElementKind::measures)
      append_element(out, name, joined(*value->get<CityList>()), R"( uom="m")");
    else
      append_values(out, name, *value);
  }

  static std::string joined(const CityList& list) {
    std::string text;
    for (const CityValue& value : list) {
      if (!text.empty()) text += ' ';
      text += *scalar_text(value);
    }
    return text;
  }

  static void append_values(std::string& out, const std::string& name, const CityValue& value) {
    if (const auto* list = value.get<CityList>())
      for (const CityValue& one : *list) append_element(out, name, *scalar_text(one));
    else
      append_element(out, name, *scalar_text(value));
  }

  /// A list of several scalars is one attribute for each; any other list is its JSON.
  void append_generic(std::string& out, std::string_view name, const CityValue& value) {
    if (value.get<std::monostate>() != nullptr) return;
    const auto* list = value.get<CityList>();
    const auto* members = value.get<CityMembers>();
    if (list != nullptr && list->size() > 1 && std::ranges::all_of(*list, [](const CityValue& one) {
          return scalar_text(one).has_value();
        })) {
      for (const CityValue& one : *list) append_generic(out, name, one);
    } else if (members != nullptr && !members->empty()) {
      append_set(out, name, *members);
    } else if (const auto scalar = scalar_text(value)) {
      append_scalar(out, name, value, *scalar);
    } else {
      std::string json;
      append_json(json, value);
      append_scalar(out, name, {}, json);
    }
  }

  void append_scalar(std::string& out, std::string_view name, const CityValue& value,
                     std::string_view text) const {
    const bool is_three = version_ == GmlVersion::three;
    std::string element = is_three ? "gen:" : "gen:";
    const bool is_whole = value.get<std::int64_t>() != nullptr;
    const bool is_double = value.get<double>() != nullptr;
    const std::string_view kind = is_whole ? "int" : is_double ? "double" : "string";
    element += kind;
    element += "Attribute";
    if (!is_three) {
      out += '<' + element + " name=\"";
      out += escaped_xml(name);
      out += "\"><gen:value>";
    } else {
      element[4] = static_cast<char>(element[4] - 'a' + 'A');
      out += "<core:genericAttribute><" + element + "><gen:name>";
      out += escaped_xml(name);
      out += "</gen:name><gen:value>";
    }
    out += escaped_xml(text);
    out += "</gen:value></" + element + '>';
    if (is_three) out += "</core:genericAttribute>";
    out += '\n';
  }

  void append_set(std::string& out, std::string_view name, const CityMembers& members) {
    std::string inner;
    for (const auto& [key, value] : members) append_generic(inner, key, value);
    if (inner.empty()) return;
    const bool is_three = version_ == GmlVersion::three;
    out += is_three ? "<core:genericAttribute><gen:GenericAttributeSet><gen:name>"
                    : "<gen:genericAttributeSet name=\"";
    out += escaped_xml(name);
    out += is_three ? "</gen:name>\n" : "\">\n";
    out += is_three ? in_set(std::move(inner)) : inner;
    out += is_three ? "</gen:GenericAttributeSet></core:genericAttribute>\n"
                    : "</gen:genericAttributeSet>\n";
  }

  /// In a set of 3.0 the property is one of the generics module.
  static std::string in_set(std::string inner) {
    constexpr std::string_view kCore = "core:genericAttribute>", kGen = "gen:genericAttribute>";
    for (std::size_t at = inner.find(kCore); at != std::string::npos;
         at = inner.find(kCore, at + kGen.size()))
      inner.replace(at, kCore.size(), kGen);
    return inner;
  }

  GmlVersion version_;
  GmlOwner owner_;
  GmlAttributes attributes_;
  std::vector<std::string_view> done_;
};

}  // namespace

GmlAttributes gml_attributes(const CityMembers& members, GmlVersion version, GmlOwner owner,
                             std::string_view id) {
  return AttributeWriter(version, owner).write(members, id);
}

}  // namespace oriel::detail
