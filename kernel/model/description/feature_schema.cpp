#include "kernel/model/description/feature_table.h"

#include <algorithm>

namespace oriel {

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

const std::vector<Attribute>& feature_schema() {
  using enum Unit;
  static const std::vector<Attribute> schema = {
      // What the segmentation says.
      {"sense", text, "protrusion, hole, cavity or imprint", "4 a, b"},
      {"natural", yes_no, "the cut follows existing edges and splits no facet", "rules.md"},
      {"value", ratio, "the key the order of cuts sorted by", "rules.md"},
      {"quality", ratio, "new area / old area in the split planes", "4"},
      {"new_area", square_metre,
       "area of the caps that the cut added to the rest, of an imprint within its outline",
       "4, 5.1"},
      {"old_area", square_metre, "area of the facets that lay in the split planes before", "4"},
      {"volume", cubic_metre, "volume of the feature, of a hole the volume of its air", "5.1"},
      {"surface", square_metre, "area of the feature's boundary without the caps", "5.1"},
      {"split_order", count, "number of split planes; 0 for a cavity or an imprint", "4"},
      // Its size, in the smallest box that stands on the z-axis.
      {"a", metre, "longest edge of the minimum box standing on the z-axis", "5.1"},
      {"b", metre, "middle edge of that box", "5.1"},
      {"c", metre, "shortest edge of that box", "5.1"},
      {"silhouette", square_metre, "largest silhouette, a times b", "5.1"},
      // Its size as seen from its host.
      {"width", metre, "horizontal extent along the host's facet", "rules.md"},
      {"height", metre, "vertical extent", "rules.md"},
      {"depth", metre, "extent along the normal of the host's facet", "rules.md"},
      {"recess", metre,
       "how far behind the plane of its cap half of its outline shows the feature's surface; "
       "negative before it",
       "rules.md"},
      {"inclination", degree, "of the largest cap: 0 horizontal, 90 vertical, above 90 facing down",
       "5.2"},
      {"azimuth", degree,
       "of the largest cap's normal, clockwise from north; missing if horizontal", "5.2"},
      // How far it sticks out of the box of its host: difference of bounding boxes.
      {"growth_up", metre, "how far it reaches above the box of its host", "5.1"},
      {"growth_down", metre, "how far it reaches below the box of its host", "5.1"},
      {"growth_out", metre, "how far it sticks out of the host's box along the cap's normal",
       "5.1"},
      {"growth_side", metre, "how far it sticks out sideways along the host's facet", "5.1"},
      // Its place.
      {"base_height", metre, "of its bottom over the ground at its foot", "5.2"},
      {"top", metre, "of its top over the ground at its foot", "5.2"},
      {"ground_source", text,
       "what the ground at its foot is: facet (a ground facet beneath), wall (the foot of its "
       "wall) or body "
       "(the lowest point of the building)",
       "5.2"},
      {"below_ridge", metre, "how far its top stays under the building's highest roof point",
       "rules.md"},
      {"above_eaves", metre, "of its bottom over the eaves of the roof it stands on or of its wall",
       "rules.md"},
      {"edge_gap", metre, "smallest distance of its cap to the outline of the host's facet",
       "rules.md"},
      {"along", metre,
       "of its middle from the left end of the host's facet, seen from outside; missing if level",
       "rules.md"},
      {"host_inclination", degree, "of the host's facet: 0 faces up, 90 a wall, 180 faces down",
       "5.2"},
      {"storey", count,
       "number of its storey among the openings' storeys, from 0; missing where none", "5.2"},
      {"per_facade", count, "features of its kind on its facade, itself included", "5.2"},
      {"per_storey", count, "features of its kind in its storey, itself included", "5.2"},
      // Of the building.
      {"lod", ratio, "level of detail that the input states, such as 2.2; missing if none",
       "rules.md"},
  };
  return schema;
}

const std::vector<RelationKind>& relation_schema() {
  static const std::vector<RelationKind> schema = {
      {"host", "the feature that owns the facet its largest cap lies in"},
      {"contains", "features it hosts, and those that they host"},
      {"inside", "features that host it, and those that host them"},
      {"same_facade", "features on the same facade"},
      {"same_storey", "openings in the same storey"},
      {"alike",
       "features of like size in the neighbourhood: same facade and kind, a and b within 10 %, "
       "centres within 6 m"},
      {"beside", "features on the same facade at overlapping heights, no more than 1 m apart"},
      {"above",
       "features right above it on the same facade: overlapping in width, no more than 1 m apart"},
  };
  return schema;
}

std::optional<std::size_t> column_of(std::string_view name) {
  const auto& schema = feature_schema();
  const auto found = std::ranges::find(schema, name, &Attribute::name);
  if (found == schema.end()) return std::nullopt;
  return static_cast<std::size_t>(found - schema.begin());
}

std::string record_name(const Attribute& attribute) {
  const std::string_view suffix = suffix_of(attribute.unit);
  return suffix.empty() ? attribute.name : attribute.name + "_" + std::string(suffix);
}

}  // namespace oriel
