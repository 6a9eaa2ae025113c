#include "kernel/describe/surfaces.h"

#include "kernel/base/index.h"
#include "kernel/describe/features/shape.h"
#include "kernel/describe/surfaces/surface_faces.h"
#include "kernel/describe/surfaces/vertical_lines.h"
#include "kernel/geometry/directions.h"
#include "model/polygon_owners.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace oriel {

namespace detail {

/// Which side of a face is the outer one, and what says so.
struct SurfaceFacing {
  bool is_turned = false;
  const char* source = "input";
  /// Outward from the facet of the solid that it lies in: it says more than `is_turned`.
  const Vec3* of_solid = nullptr;
};

}  // namespace detail

namespace {

using detail::LineCrossing;
using detail::SurfaceFace;
using detail::SurfaceFaces;
using detail::SurfaceFacing;

/// Within this of level a normal has no azimuth, as for features.
constexpr double kLevel_deg = 0.5;
/// How far beyond the outline, and above or below the surface, is looked for the building: more
/// than the millimetres that polygons are out of plane, less than a wall is thick.
constexpr double kProbe_m = 0.05;
/// From this share of the area on, the polygons that agree speak for all.
constexpr double kMajority = 0.75;

/// Where on an edge is looked, as shares of it.
constexpr std::array<double, 3> kProbes = {1.0 / 6, 0.5, 5.0 / 6};

}  // namespace

struct SurfaceSurvey::State {
  template <class Figures>
  State(const Figures& figures, const Tolerances& given);

  /// Judges the sides of the faces that are not known.
  void judge_facing(const std::vector<bool>& is_known);
  /// What is known of a face once its outer side is.
  void describe(std::size_t row);
  void measure_sides(std::size_t row);
  void measure_gaps(std::size_t row);
  void measure_surroundings(std::size_t row);

  [[nodiscard]] const detail::VerticalLines& lines();
  [[nodiscard]] Vec3 outward(std::size_t row) const {
    const SurfaceFacing& facing = facings[row];
    const Vec3 normal = faces[row].normal;
    const bool is_turned =
        facing.of_solid != nullptr ? dot(normal, *facing.of_solid) < 0 : facing.is_turned;
    return is_turned ? -normal : normal;
  }
  [[nodiscard]] std::optional<bool> looks_up_by_position(const SurfaceFace& face);
  [[nodiscard]] bool is_below(const std::optional<LineCrossing>& above, Vec3 point);

  Tolerances tolerances;
  SurfaceFaces faces;
  /// Once something is asked of them.
  std::optional<detail::VerticalLines> vertical_lines;
  std::vector<SurfaceFacing> facings;
  SurfaceTable table;
};

template <class Figures>
SurfaceSurvey::State::State(const Figures& figures, const Tolerances& given)
    : tolerances(given), faces(figures), facings(faces.size()), table(faces.size()) {}

const detail::VerticalLines& SurfaceSurvey::State::lines() {
  if (!vertical_lines) vertical_lines.emplace(faces);
  return *vertical_lines;
}

/// The topmost surface looks up and the lowest one down. Between them each surface that a line
/// meets changes between air and material, if it meets an even number of them in all; else
/// something is missing or overhangs, and the line says nothing.
std::optional<bool> SurfaceSurvey::State::looks_up_by_position(const SurfaceFace& face) {
  std::ptrdiff_t above = 0, below = 0;
  const Vec3 middle = face.middle();
  for (const LineCrossing& c : lines().at(middle)) {
    if (c.z > middle.z + tolerances.weld_m) ++above;
    if (c.z < middle.z - tolerances.weld_m) ++below;
  }
  if (above == 0 && below == 0) return std::nullopt;
  if (above == 0 || below == 0) return above == 0;
  if ((above + below) % 2 == 0) return std::nullopt;
  return above % 2 == 0;
}

void SurfaceSurvey::State::judge_facing(const std::vector<bool>& is_known) {
  double agree_m2 = 0, all_m2 = 0;
  std::vector<bool> is_told(faces.size(), false), is_against(faces.size(), false);
  for (std::size_t row = 0; row < faces.size(); ++row) {
    if (is_known[row]) continue;
    const SurfaceFace& face = faces[row];
    if (face.is_steep()) continue;
    const auto looks_up = looks_up_by_position(face);
    if (!looks_up) continue;
    is_against[row] = *looks_up != (face.normal.z > 0);
    is_told[row] = true;
    all_m2 += face.area_m2;
    if (!is_against[row]) agree_m2 += face.area_m2;
  }
  const bool is_as_given = agree_m2 >= kMajority * all_m2;
  const bool is_all_turned = !is_as_given && agree_m2 <= (1 - kMajority) * all_m2;
  for (std::size_t row = 0; row < faces.size(); ++row) {
    if (is_known[row]) continue;
    if (is_as_given)
      facings[row] = {false, "input"};
    else if (is_all_turned)
      facings[row] = {true, "position"};
    else if (!is_told[row])
      facings[row] = {false, "input"};
    else
      facings[row] = {is_against[row], "position"};
  }
}

void SurfaceSurvey::State::describe(std::size_t row) {
  const SurfaceFace& face = faces[row];
  table.set(row, SurfaceAttribute::area, face.area_m2);
  table.set(row, SurfaceAttribute::facing, std::string(facings[row].source));
  if (!face.box.is_empty()) {
    table.set(row, SurfaceAttribute::base_height, face.box.min.z - faces.low_m());
    table.set(row, SurfaceAttribute::top, face.box.max.z - faces.low_m());
    table.set(row, SurfaceAttribute::below_ridge, faces.high_m() - face.box.max.z);
  }
  if (face.normal == Vec3{}) return;
  const Vec3 normal = outward(row);
  const double inclination = inclination_deg(normal);
  table.set(row, SurfaceAttribute::inclination, inclination);
  if (std::min(inclination, 180 - inclination) <= kLevel_deg) return;
  table.set(row, SurfaceAttribute::azimuth, azimuth_deg(normal));
}

void SurfaceSurvey::State::measure_sides(std::size_t row) {
  if (faces[row].normal == Vec3{}) return;
  const detail::RectangleSides sides = detail::sides_of(faces[row]);
  table.set(row, SurfaceAttribute::a, sides.a_m);
  table.set(row, SurfaceAttribute::b, sides.b_m);
}

void SurfaceSurvey::State::measure_gaps(std::size_t row) {
  if (faces[row].normal == Vec3{}) return;
  const Vec3 middle = faces[row].middle();
  const double weld_m = tolerances.weld_m;
  if (const auto above = lines().next_above(middle, middle.z + weld_m))
    table.set(row, SurfaceAttribute::gap_above, above->z - middle.z);
  if (const auto below =
          lines().next_below(middle, std::nextafter(middle.z - weld_m, faces.low_m())))
    table.set(row, SurfaceAttribute::gap_below, middle.z - below->z);
}

/// Whether there is material at a point, of whose vertical line `above` is the next crossing: if
/// one leaves it there through a surface that looks up, and entered it through one that looks down.
/// An overhang of one sheet makes no material of the air below it.
bool SurfaceSurvey::State::is_below(const std::optional<LineCrossing>& above, Vec3 point) {
  if (!above || outward(at(above->face)).z <= 0) return false;
  const auto below = lines().next_below(point, point.z);
  return below && outward(at(below->face)).z < 0;
}

void SurfaceSurvey::State::measure_surroundings(std::size_t row) {
  const SurfaceFace& face = faces[row];
  if (face.is_steep()) return;
  const OutlineView outline = face.outlines[0];
  double all_m = 0, up_m = 0, down_m = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Vec3 from = outline[i], edge = outline[(i + 1) % outline.size()] - from;
    Vec3 out = cross(edge, face.normal);
    out.z = 0;
    out = normalised(out);
    const double share_m = length(edge) / static_cast<double>(kProbes.size());
    for (const double t : kProbes) {
      const Vec3 beyond = from + t * edge + kProbe_m * out;
      const Vec3 low = beyond - Vec3{0, 0, kProbe_m}, high = beyond + Vec3{0, 0, kProbe_m};
      const auto above = lines().next_above(low, low.z);
      const bool is_down = is_below(above, low);
      // Mostly the line meets nothing in between.
      const bool is_same = !above || above->z > high.z;
      const bool is_up = is_same ? is_down : is_below(lines().next_above(high, high.z), high);
      all_m += share_m;
      if (is_up) up_m += share_m;
      if (is_down) down_m += share_m;
    }
  }
  if (!(all_m > 0)) return;
  table.set(row, SurfaceAttribute::wall_up, up_m / all_m);
  table.set(row, SurfaceAttribute::wall_down, down_m / all_m);
}

namespace {

/// The rows of polygons by their numbers.
std::vector<int> rows_by_source(const Building& building) {
  std::vector<int> rows;
  for (std::size_t row = 0; row < building.polygons.size(); ++row) {
    const int source = building.polygons[row].source;
    if (source < 0) continue;
    if (at(source) >= rows.size()) rows.resize(at(source) + 1, -1);
    rows[at(source)] = static_cast<int>(row);
  }
  return rows;
}

/// A polygon looks where the solid's facet looks that it lies in. True for those that lie in one.
std::vector<bool> take_facing(const Solid& solid, const std::vector<int>& rows,
                              std::vector<SurfaceFacing>& facings) {
  std::vector<bool> is_known(facings.size(), false);
  for (const Facet& facet : solid.facets) {
    const Vec3& normal = solid.planes[facet.plane.index()].normal;
    for (const int source : facet.polygons) {
      if (source < 0 || at(source) >= rows.size() || rows[at(source)] < 0) continue;
      const std::size_t row = at(rows[at(source)]);
      facings[row] = {false, "solid", &normal};
      is_known[row] = true;
    }
  }
  return is_known;
}

/// The smallest feature that lists each polygon.
void add_features(const SurfaceContext& context, const PolygonOwners& owners,
                  const Building& building, std::span<const int> rows, SurfaceTable& table) {
  for (const int row : rows) {
    const int source = building.polygons[at(row)].source;
    if (source < 0 || owners[at(source)].empty()) continue;
    const FeatureId innermost{owners[at(source)].front()};
    table.set(at(row), SurfaceAttribute::sense,
              to_string(context.segmentation->features[innermost.index()].sense));
    if (const auto host = context.features->number(innermost, Attribute::host_inclination))
      table.set(at(row), SurfaceAttribute::host_inclination, *host);
  }
}

std::vector<int> rows_up_to(std::size_t count) {
  std::vector<int> rows(count);
  std::iota(rows.begin(), rows.end(), 0);
  return rows;
}

SurfaceTable fully_measured(SurfaceSurvey survey) {
  const std::vector<int> rows = rows_up_to(survey.table().rows());
  for (const SurfaceMeasure what : kSurfaceMeasures) survey.measure(what, rows);
  return std::move(survey.table());
}

}  // namespace

std::optional<SurfaceMeasure> measure_of(SurfaceAttribute attribute) {
  using enum SurfaceAttribute;
  if (attribute == a || attribute == b) return SurfaceMeasure::sides;
  if (attribute == gap_above || attribute == gap_below) return SurfaceMeasure::gaps;
  if (attribute == wall_up || attribute == wall_down) return SurfaceMeasure::surroundings;
  return std::nullopt;
}

SurfaceSurvey::SurfaceSurvey(const Building& building, const Tolerances& tolerances,
                             const SurfaceContext& context)
    : SurfaceSurvey(building, tolerances, context, rows_up_to(building.polygons.size())) {}

SurfaceSurvey::SurfaceSurvey(const Building& building, const Tolerances& tolerances,
                             const SurfaceContext& context, std::span<const int> rows)
    : state_(std::make_unique<State>(building, tolerances)) {
  const auto by_source = rows_by_source(building);
  std::vector<bool> is_known(state_->faces.size(), false);
  if (context.solid != nullptr) is_known = take_facing(*context.solid, by_source, state_->facings);
  state_->judge_facing(is_known);
  for (const int row : rows) {
    state_->describe(at(row));
    state_->table.set(at(row), SurfaceAttribute::synthetic, 0.0);
  }
  if (context.segmentation == nullptr || context.features == nullptr) return;
  SurfaceTable& table = state_->table;
  if (context.owners != nullptr)
    add_features(context, *context.owners, building, rows, table);
  else
    add_features(context, polygon_owners(*context.segmentation, building), building, rows, table);
}

SurfaceSurvey::SurfaceSurvey(const Solid& solid, const Tolerances& tolerances)
    : state_(std::make_unique<State>(solid, tolerances)) {
  std::ranges::fill(state_->facings, SurfaceFacing{false, "solid"});
  SurfaceTable& table = state_->table;
  for (std::size_t row = 0; row < table.rows(); ++row) {
    state_->describe(row);
    table.set(row, SurfaceAttribute::synthetic, solid.facets[row].polygons.empty() ? 1.0 : 0.0);
  }
}

SurfaceSurvey::SurfaceSurvey(SurfaceSurvey&&) noexcept = default;
SurfaceSurvey::~SurfaceSurvey() = default;

SurfaceTable& SurfaceSurvey::table() { return state_->table; }

void SurfaceSurvey::measure(SurfaceMeasure what, std::span<const int> rows) {
  for (const int row : rows) {
    if (what == SurfaceMeasure::sides) state_->measure_sides(at(row));
    if (what == SurfaceMeasure::gaps) state_->measure_gaps(at(row));
    if (what == SurfaceMeasure::surroundings) state_->measure_surroundings(at(row));
  }
}

SurfaceTable describe_surfaces(const Building& building, const Tolerances& tolerances,
                               const SurfaceContext& context) {
  return fully_measured(SurfaceSurvey(building, tolerances, context));
}

SurfaceTable describe_facets(const Solid& solid, const Tolerances& tolerances) {
  return fully_measured(SurfaceSurvey(solid, tolerances));
}

}  // namespace oriel
