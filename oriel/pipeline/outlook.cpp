#include "oriel/pipeline/outlook.h"

#include "kernel/base/index.h"
#include "kernel/geometry/directions.h"
#include "kernel/geometry/outlines.h"
#include "model/description/surface_table.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/ranges.h>

namespace oriel {

namespace {

/// A wall of a model leans by 5 degrees at most.
constexpr double kWallFrom_deg = 85, kWallTo_deg = 95;
/// From this share on what lies against others is a party wall.
constexpr double kPartyShare = 0.5;

/// What is known of a figure on a wall.
struct WallOutlook {
  double exposed = 1;
  std::optional<Outlook> outlook;

  [[nodiscard]] bool is_party_wall() const { return exposed <= 1 - kPartyShare; }
  /// Nothing where nobody knows what lies before it.
  [[nodiscard]] std::optional<bool> faces(Outlook what) const {
    if (!outlook) return std::nullopt;
    return !is_party_wall() && *outlook == what;
  }
};

template <class Table, class Row, class Kind>
void set_outlook(Table& table, Row row, const WallOutlook& of, bool is_upright) {
  if (is_upright) {
    table.set(row, Kind::party_wall, of.is_party_wall() ? 1.0 : 0.0);
    table.set(row, Kind::exposed, of.exposed);
  }
  if (const auto street = of.faces(Outlook::street))
    table.set(row, Kind::faces_street, *street ? 1.0 : 0.0);
  if (const auto yard = of.faces(Outlook::yard))
    table.set(row, Kind::faces_yard, *yard ? 1.0 : 0.0);
}

/// The rectangle that a feature takes up in the plane of its cap.
Outline rectangle_of(const Segmentation& segmentation, const Feature& feature, const Plane& plane) {
  const ReachAxes axes = axes_in(plane.normal);
  Reach reach;
  for (const int v : feature.vertices) axes.grow(reach, segmentation.vertices[at(v)].point);
  const auto corner = [&](double u, double v) {
    return plane.offset_m * plane.normal + u * axes.u + v * axes.v;
  };
  return {corner(reach.u0, reach.v0), corner(reach.u1, reach.v0), corner(reach.u1, reach.v1),
          corner(reach.u0, reach.v1)};
}

/// Outward, as the table says it.
Vec3 normal_of(double inclination_deg, double azimuth_deg) {
  const double i = inclination_deg * kDegree_rad, a = azimuth_deg * kDegree_rad;
  return {std::sin(i) * std::sin(a), std::sin(i) * std::cos(a), std::cos(i)};
}

/// As many digits as a person reads of a share.
double to_four_digits(double share) { return std::round(share * 1e4) / 1e4; }

/// The polygon's surface gets what the table of surfaces has of it.
void add_to_surface(const SurfaceTable& table, std::size_t row, SemanticSurface& surface) {
  const auto exposed = table.number(row, SurfaceAttribute::exposed);
  if (!exposed) return;
  const bool is_party = table.number(row, SurfaceAttribute::party_wall).value_or(0) > 0;
  FeatureLabel label = *surface.label;
  label.is_party_wall = is_party;
  label.exposed = to_four_digits(*exposed);
  for (const auto& [attribute, word] : {std::pair(SurfaceAttribute::faces_street, "street"),
                                        std::pair(SurfaceAttribute::faces_yard, "yard")})
    if (table.number(row, attribute).value_or(0) > 0) label.faces = word;
  surface.label = std::move(label);
}

}  // namespace

void describe_outlook_of_features(const Segmentation& segmentation, const LabelOptions& options,
                                  const std::optional<Neighbourhood>& around, FeatureTable& table) {
  if (!around) return;
  for (std::size_t i = 0; i < segmentation.features.size(); ++i) {
    const Feature& feature = segmentation.features[i];
    if (feature.planes.empty()) continue;
    const Plane& plane = segmentation.planes[feature.planes.front().index()];
    const Outline rectangle = rectangle_of(segmentation, feature, plane);
    WallOutlook of;
    const bool is_upright = std::abs(plane.normal.z) <= std::cos(kWallFrom_deg * kDegree_rad);
    if (is_upright) of.exposed = 1 - around->covered_share(std::span(&rectangle, 1), plane.normal);
    of.outlook =
        options.neighbours->outlook(*around, 0.5 * (rectangle[0] + rectangle[2]), plane.normal);
    set_outlook<FeatureTable, FeatureId, Attribute>(table, FeatureId{static_cast<int>(i)}, of,
                                                    is_upright);
  }
}

void describe_outlook_of_surfaces(const Building& building, std::span<const int> rows,
                                  const LabelOptions& options,
                                  const std::optional<Neighbourhood>& around, SurfaceTable& table) {
  if (!around) return;
  for (const int row : rows) {
    const auto inclination = table.number(at(row), SurfaceAttribute::inclination);
    const auto azimuth = table.number(at(row), SurfaceAttribute::azimuth);
    if (!inclination || !azimuth || *inclination < kWallFrom_deg || *inclination > kWallTo_deg)
      continue;
    const auto outlines = outlines_of(building, building.polygons[at(row)]);
    if (outlines.empty() || outlines[0].size() < 3) continue;
    const Vec3 normal = normal_of(*inclination, *azimuth);
    WallOutlook of;
    of.exposed = 1 - around->covered_share(outlines, normal);
    if (const auto middle = interior_point(outlines, normal))
      of.outlook = options.neighbours->outlook(*around, *middle, normal);
    set_outlook<SurfaceTable, std::size_t, SurfaceAttribute>(table, at(row), of, true);
  }
}

void add_outlook(const Building& building, const PipelineResult& result, LabelledBuilding& out) {
  if (!result.surroundings) return;
  double contact_m2 = 0;
  std::vector<std::string> ids;
  for (const BuildingContact& contact : result.surroundings->contacts) {
    contact_m2 += contact.area_m2;
    ids.push_back(contact.building);
  }
  out.attributes.emplace_back("oriel_neighbours", fmt::format("{}", fmt::join(ids, ";")));
  out.attributes.emplace_back("oriel_party_walls_m2", std::round(100 * contact_m2) / 100);
  if (result.surfaces.rows() != building.polygons.size()) return;
  for (std::size_t row = 0; row < building.polygons.size(); ++row) {
    const int source = building.polygons[row].source;
    if (source < 0 || at(source) >= out.surface_of_polygon.size()) continue;
    const int surface = out.surface_of_polygon[at(source)];
    if (surface >= 0 && out.surfaces[at(surface)].parent < 0 &&
        out.surfaces[at(surface)].label->id.empty())
      add_to_surface(result.surfaces, row, out.surfaces[at(surface)]);
  }
}

}  // namespace oriel
