#include "model/description/attributes.h"

#include <algorithm>

namespace oriel {

namespace {

template <class Id, std::size_t count>
std::optional<Id> find(const std::vector<AttributeInfo>& schema, const std::array<Id, count>& ids,
                       std::string_view name) {
  const auto found = std::ranges::find(schema, name, &AttributeInfo::name);
  if (found == schema.end()) return std::nullopt;
  return ids[static_cast<std::size_t>(found - schema.begin())];
}

}  // namespace

#define ORIEL_ATTRIBUTE(name, unit, meaning, source, ...) \
  {#name, Unit::unit, meaning, source, {__VA_ARGS__}},
const std::vector<AttributeInfo>& feature_schema() {
  static const std::vector<AttributeInfo> schema = {
#include "model/description/feature_attributes.inc"
  };
  return schema;
}

const std::vector<AttributeInfo>& surface_schema() {
  static const std::vector<AttributeInfo> schema = {
#include "model/description/surface_attributes.inc"
  };
  return schema;
}
#undef ORIEL_ATTRIBUTE

std::string_view suffix_of(Unit unit) {
  switch (unit) {
    case Unit::metre:
      return "m";
    case Unit::square_metre:
      return "m2";
    case Unit::cubic_metre:
      return "m3";
    case Unit::degree:
      return "deg";
    default:
      return "";
  }
}

const std::vector<RelationKind>& relation_schema() {
  static const std::vector<RelationKind> schema = {
      {"host", "the feature that owns the facet in which its largest cap lies"},
      {"contains", "features that it hosts, and features that those host"},
      {"inside", "features that host it, and features that host those"},
      {"same_facade", "features on the same facade"},
      {"same_storey", "openings in the same storey"},
      {"alike",
       "features of similar size nearby: same facade and kind, a and b within 10 %, "
       "centres within 6 m"},
      {"beside", "features on the same facade at overlapping heights, no more than 1 m apart"},
      {"above",
       "features directly above it on the same facade, overlapping in width, no more than 1 m "
       "apart"},
  };
  return schema;
}

std::optional<Attribute> find_attribute(std::string_view name) {
  return find(feature_schema(), kAttributes, name);
}

std::optional<SurfaceAttribute> find_surface_attribute(std::string_view name) {
  return find(surface_schema(), kSurfaceAttributes, name);
}

std::string record_name(const AttributeInfo& attribute) {
  const std::string_view suffix = suffix_of(attribute.unit);
  return suffix.empty() ? attribute.name : attribute.name + "_" + std::string(suffix);
}

}  // namespace oriel
