#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

/// What is known of features and of surfaces: the contract between describe (which fills the
/// values), interpret (which checks rules against it before any building is read) and the records
/// that are written.
///
/// To add an attribute: one row in feature_attributes.inc (or surface_attributes.inc), and the
/// function in kernel/describe that sets it. Rules, tests of rules, explain and records know it
/// then. Code says Attribute::height; names are for what people write and read.
namespace oriel {

/// The unit of an attribute, and so its type in a rule.
enum class Unit { text, yes_no, count, ratio, metre, square_metre, cubic_metre, degree };

/// "m", "m2", "m3", "deg"; empty for the others.
std::string_view suffix_of(Unit unit);

#define ORIEL_ATTRIBUTE(name, ...) name,
/// The attributes of features; their numbers are the columns of FeatureTable.
enum class Attribute : std::uint8_t {
#include "model/description/feature_attributes.inc"
};

/// The attributes of surfaces; their numbers are the columns of SurfaceTable.
enum class SurfaceAttribute : std::uint8_t {
#include "model/description/surface_attributes.inc"
};
#undef ORIEL_ATTRIBUTE

/// All of them, in the order of their columns.
#define ORIEL_ATTRIBUTE(name, ...) Attribute::name,
inline constexpr std::array kAttributes = {
#include "model/description/feature_attributes.inc"
};
#undef ORIEL_ATTRIBUTE
#define ORIEL_ATTRIBUTE(name, ...) SurfaceAttribute::name,
inline constexpr std::array kSurfaceAttributes = {
#include "model/description/surface_attributes.inc"
};
#undef ORIEL_ATTRIBUTE

/// A row of the table.
struct AttributeInfo {
  std::string name;
  Unit unit = Unit::ratio;
  std::string meaning;
  /// The section of the paper, or "rules.md", that asks for it.
  std::string source;
  /// What a text can be; empty if it can be anything.
  std::vector<std::string> words;
};

/// The table: one row for each attribute, by column.
const std::vector<AttributeInfo>& feature_schema();
const std::vector<AttributeInfo>& surface_schema();

constexpr std::size_t column_of(Attribute attribute) { return static_cast<std::size_t>(attribute); }
constexpr std::size_t column_of(SurfaceAttribute attribute) {
  return static_cast<std::size_t>(attribute);
}

inline const AttributeInfo& info_of(Attribute attribute) {
  return feature_schema()[column_of(attribute)];
}
inline const AttributeInfo& info_of(SurfaceAttribute attribute) {
  return surface_schema()[column_of(attribute)];
}

/// The attribute that people call `name`, or nothing.
std::optional<Attribute> find_attribute(std::string_view name);
std::optional<SurfaceAttribute> find_surface_attribute(std::string_view name);

/// The name that records carry: the attribute's name with its unit (`height_m`, `quality`).
std::string record_name(const AttributeInfo& attribute);

/// A relation that describe makes (FeatureGraph), with its meaning: self -> other.
struct RelationKind {
  std::string name;
  std::string meaning;
};
const std::vector<RelationKind>& relation_schema();

}  // namespace oriel
