#include "kernel/io/citygml/citygml_attributes.h"

#include "kernel/io/json/json_text.h"
#include "kernel/io/json/words.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <unordered_map>
#include <utility>
#include <vector>

namespace oriel::detail {

namespace {

enum class ValueKind { text, number, whole, numbers };

struct CityGmlAttribute {
  std::string name;
  /// As JSON.
  std::vector<std::string> values;
};

ValueKind kind_of(std::string_view name) {
  constexpr std::array<std::string_view, 4> kWhole{"storeysAboveGround", "storeysBelowGround",
                                                   "yearOfConstruction", "yearOfDemolition"};
  if (name == "measuredHeight") return ValueKind::number;
  if (name == "storeyHeightsAboveGround" || name == "storeyHeightsBelowGround")
    return ValueKind::numbers;
  return std::ranges::find(kWhole, name) != kWhole.end() ? ValueKind::whole : ValueKind::text;
}

/// "stringAttribute" of 2.0, "StringAttribute" of 3.0: the kind of its value.
std::optional<ValueKind> kind_of_generic(const XmlNode& node) {
  const std::string_view name = node.name;
  if (node.vocabulary != Vocabulary::generics || !name.ends_with("Attribute")) return std::nullopt;
  const auto starts = [&](std::string_view lower, std::string_view upper) {
    return name.starts_with(lower) || name.starts_with(upper);
  };
  if (starts("generic", "Generic")) return std::nullopt;
  if (starts("int", "Int")) return ValueKind::whole;
  if (starts("double", "Double") || starts("measure", "Measure")) return ValueKind::number;
  return ValueKind::text;
}

std::string json_of(std::string_view text, ValueKind kind) {
  std::string json;
  const auto number = as_double(text);
  const auto whole = as_whole(text);
  if (kind == ValueKind::whole && whole) {
    append_json(json, static_cast<std::int64_t>(*whole));
  } else if (kind == ValueKind::number && number && std::isfinite(*number)) {
    append_json(json, *number);
  } else if (kind == ValueKind::numbers) {
    json += '[';
    std::size_t at = text.find_first_not_of(" \t\r\n");
    while (at < text.size()) {
      const std::size_t end = std::min(text.find_first_of(" \t\r\n", at), text.size());
      if (json.size() > 1) json += ',';
      json += json_of(text.substr(at, end - at), ValueKind::number);
      at = text.find_first_not_of(" \t\r\n", end);
    }
    json += ']';
  } else {
    append_json(json, text);
  }
  return json;
}

const XmlNode* child_named(const XmlNode& node, std::string_view name) {
  const auto found = std::ranges::find(node.children, name, &XmlNode::name);
  return found == node.children.end() ? nullptr : &*found;
}

class Attributes {
 public:
  void read(const XmlNode& object) {
    for (const XmlNode& child : object.children) read_property(child);
  }

  void append_to(std::string& out, const std::vector<std::string_view>& reserved) const {
    for (const CityGmlAttribute& attribute : attributes_) {
      const bool is_reserved = std::ranges::find(reserved, attribute.name) != reserved.end();
      std::string key(is_reserved ? "_" : "");
      append_json_key(out, key.append(attribute.name));
      if (attribute.values.size() == 1) {
        out += attribute.values[0];
        continue;
      }
      for (const std::string& value : attribute.values) {
        out += &value == &attribute.values.front() ? '[' : ',';
        out += value;
      }
      out += ']';
    }
  }

 private:
  void read_property(const XmlNode& property) {
    if (property.vocabulary == Vocabulary::other) return;
    if (read_generic(property)) return;
    if (property.name == "genericAttribute") {
      for (const XmlNode& value : property.children) read_generic(value);
    } else if (property.name == "height" && property.vocabulary == Vocabulary::construction) {
      read_height(property);
    } else if (const std::string_view text = trimmed(property.text);
               property.children.empty() && !text.empty()) {
      add(property.name, json_of(text, kind_of(property.name)));
    }
  }

  /// An attribute of the generics module: its name is an attribute in 2.0, an element in 3.0.
  bool read_generic(const XmlNode& node) {
    const bool is_set = node.name == "genericAttributeSet" || node.name == "GenericAttributeSet";
    const auto kind = kind_of_generic(node);
    if (node.vocabulary != Vocabulary::generics || (!kind && !is_set)) return false;
    const XmlNode* named = child_named(node, "name");
    const std::string name(named != nullptr ? trimmed(named->text) : node.attribute("name"));
    const XmlNode* value = child_named(node, "value");
    if (is_set) {
      Attributes inner;
      for (const XmlNode& child : node.children)
        if (child.name != "name") inner.read_property(child);
      std::string json = "{";
      inner.append_to(json, {});
      json += '}';
      add(name, std::move(json));
    } else if (value != nullptr) {
      add(name, json_of(trimmed(value->text), *kind));
    }
    return true;
  }

  void read_height(const XmlNode& property) {
    const XmlNode* height = child_named(property, "Height");
    const XmlNode* value = height != nullptr ? child_named(*height, "value") : nullptr;
    if (value != nullptr && !number_of_.contains("measuredHeight"))
      add("measuredHeight", json_of(trimmed(value->text), ValueKind::number));
  }

  void add(const std::string& name, std::string value) {
    const auto [found, is_new] = number_of_.try_emplace(name, attributes_.size());
    if (is_new) attributes_.push_back({name, {}});
    attributes_[found->second].values.push_back(std::move(value));
  }

  std::vector<CityGmlAttribute> attributes_;
  std::unordered_map<std::string, std::size_t> number_of_;
};

}  // namespace

void append_attributes(std::string& out, const XmlNode& object,
                       const std::vector<std::string_view>& reserved) {
  Attributes attributes;
  attributes.read(object);
  attributes.append_to(out, reserved);
}

}  // namespace oriel::detail
