#include "kernel/neighbours/standing_building.h"

#include "kernel/geometry/directions.h"
#include "kernel/geometry/outlines.h"
#include "kernel/geometry/shared_area.h"
#include "kernel/neighbours/before_wall.h"
#include "model/tolerances.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace oriel {

namespace {

constexpr Vec3 kUpwards{0, 0, 1};
/// What is smaller does not make a contact of kContact_m2 even with a few of its like.
constexpr double kLeastWall_m2 = 0.05;
/// As kernel/blocks has it.
constexpr double kGroundOver_m = 0.5;

Box box_of_outline(const Outline& outline) {
  Box box;
  for (const Vec3 p : outline) box.grow(p);
  return box;
}

/// Seen from above, the outer outline counter-clockwise.
std::vector<Outline> flattened(std::vector<Outline> outlines) {
  for (Outline& outline : outlines)
    for (Vec3& p : outline) p.z = 0;
  if (signed_area(outlines[0], kUpwards) < 0)
    for (Outline& outline : outlines) std::ranges::reverse(outline);
  return outlines;
}

/// A polygon that is not steep.
struct GentlePolygon {
  std::vector<Outline> outlines;  ///< seen from above
  double area_m2 = 0;
  double mean_m = 0;  ///< of its corners' heights
  double low_m = 0, high_m = 0;
  double up = 0;  ///< of its normal
  Vec3 falls_to;  ///< level, of length 1; nothing of one that is level
  bool looks_up = false;
  bool is_low = false;
};

/// The mean height of the upper ones by area: of a closed building each spot has as many that look
/// up as look down.
double roof_height_m(const std::vector<GentlePolygon>& flats, double otherwise_m) {
  double sum = 0, all_m2 = 0;
  for (const GentlePolygon& flat : flats) {
    if (!flat.looks_up || flat.is_low) continue;
    sum += flat.area_m2 * flat.mean_m;
    all_m2 += flat.area_m2;
  }
  return all_m2 > 0 ? sum / all_m2 : otherwise_m;
}

/// Larger walls are never panes.
constexpr double kLargestPane_m2 = 4;
/// The rim of a pane is left out, as it may be on the outline of the ground.
constexpr double kMostly = 0.9;
constexpr double kStepBefore_m = 0.01;
constexpr double kSameSide = 0.9848;  // the cosine of 10 degrees
constexpr double kFlatRoof = 0.9848;  // upwards to 10 degrees
constexpr double kOfRoof = 0.8, kOfEachSide = 0.2;

/// The steeper ones by their largest: which way it falls is across the ridge.
std::optional<GabledRoof> gabled_roof(const std::vector<GentlePolygon>& flats) {
  const GentlePolygon* largest = nullptr;
  double all_m2 = 0;
  const auto is_roof = [](const GentlePolygon& flat) { return flat.looks_up && !flat.is_low; };
  for (const GentlePolygon& flat : flats) {
    if (!is_roof(flat)) continue;
    all_m2 += flat.area_m2;
    if (flat.up <= kFlatRoof && (largest == nullptr || flat.area_m2 > largest->area_m2))
      largest = &flat;
  }
  if (largest == nullptr) return std::nullopt;
  std::array<double, 2> sides_m2{};
  GabledRoof roof;
  roof.ridge = {-largest->falls_to.y, largest->falls_to.x, 0};
  for (const GentlePolygon& flat : flats) {
    const double side = dot(flat.falls_to, largest->falls_to);
    if (!is_roof(flat) || flat.up > kFlatRoof || std::abs(side) < kSameSide) continue;
    sides_m2[side > 0 ? 0 : 1] += flat.area_m2;
    roof.ridge_m += flat.area_m2 * flat.high_m;
    roof.eaves_m += flat.area_m2 * flat.low_m;
  }
  const double both_m2 = sides_m2[0] + sides_m2[1];
  if (both_m2 < kOfRoof * all_m2 || std::min(sides_m2[0], sides_m2[1]) < kOfEachSide * all_m2)
    return std::nullopt;
  roof.ridge_m /= both_m2;
  roof.eaves_m /= both_m2;
  return roof;
}

/// True if what looks down is the ground.
bool take_ground(std::vector<GentlePolygon>& flats, StandingBuilding& out, StandingShape& shape) {
  double low_m2 = 0, up_m2 = 0;
  for (const GentlePolygon& flat : flats) {
    if (flat.is_low) low_m2 += flat.area_m2;
    if (flat.looks_up) up_m2 += flat.area_m2;
  }
  const bool has_ground = low_m2 > 0 && low_m2 >= up_m2 / 2;
  for (GentlePolygon& flat : flats) {
    if (has_ground ? !flat.is_low : !flat.looks_up) continue;
    out.ground_m2 += flat.area_m2;
    shape.ground.push_back(std::move(flat.outlines));
  }
  return has_ground;
}

/// True of a small wall, as around and behind the pane of a window, all of which has ground of the
/// building itself before it, further than walls that touch are apart.
bool looks_at_own_ground(const UprightWall& wall, const StandingShape& own) {
  const Outline& outline = wall.outlines[0];
  if (figure_area_m2(wall.outlines, wall.normal) > kLargestPane_m2) return false;
  Vec3 middle;
  for (const Vec3 p : outline) middle = middle + (1.0 / static_cast<double>(outline.size())) * p;
  const auto is_own = [&](Vec3 p) {
    const Vec3 before =
        middle + kMostly * (p - middle) + (kContact_m + kStepBefore_m) * wall.normal;
    return detail::is_on_ground(own.ground, {before.x, before.y, 0});
  };
  for (std::size_t i = 0; i < outline.size(); ++i)
    if (!is_own(outline[i]) || !is_own(0.5 * (outline[i] + outline[(i + 1) % outline.size()])))
      return false;
  return true;
}

}  // namespace

std::pair<StandingBuilding, StandingShape> standing_building(const Building& building) {
  StandingBuilding out;
  StandingShape shape;
  out.id = building.id;
  out.origin_m = building.frame.origin_m;
  std::vector<std::pair<std::vector<Outline>, Vec3>> polygons;
  for (const Polygon& polygon : building.polygons) {
    auto outlines = outlines_of(building, polygon);
    if (outlines.empty() || outlines[0].size() < 3) continue;
    const Vec3 area = area_vector(outlines[0]);
    for (const Vec3 p : outlines[0]) out.box.grow(p);
    if (length(area) > 0) polygons.emplace_back(std::move(outlines), area);
  }
  out.ground_m = out.box.is_empty() ? 0 : out.box.min.z;
  std::vector<GentlePolygon> flats;
  for (auto& [outlines, area] : polygons) {
    const Vec3 normal = normalised(area);
    if (std::abs(normal.z) <= kPartyWallLean) {
      if (length(area) >= kLeastWall_m2) shape.walls.push_back({std::move(outlines), normal, {}});
      continue;
    }
    if (looks_aside(normal)) continue;
    GentlePolygon flat;
    for (const Vec3 p : outlines[0]) flat.mean_m += p.z / static_cast<double>(outlines[0].size());
    flat.looks_up = normal.z > 0;
    flat.up = normal.z;
    const Vec3 level{normal.x, normal.y, 0};
    if (length(level) > 0) flat.falls_to = normalised(level);
    const Box box = box_of_outline(outlines[0]);
    flat.low_m = box.min.z;
    flat.high_m = box.max.z;
    flat.is_low = !flat.looks_up && box.max.z <= out.ground_m + kGroundOver_m;
    flat.outlines = flattened(std::move(outlines));
    flat.area_m2 = std::max(0.0, figure_area_m2(flat.outlines, kUpwards));
    flats.push_back(std::move(flat));
  }
  for (UprightWall& wall : shape.walls) wall.box = box_of_outline(wall.outlines[0]);
  out.roof_m = roof_height_m(flats, out.box.is_empty() ? 0 : out.box.max.z);
  out.gable = gabled_roof(flats);
  if (take_ground(flats, out, shape))
    std::erase_if(shape.walls,
                  [&](const UprightWall& wall) { return looks_at_own_ground(wall, shape); });
  shape.walls.shrink_to_fit();
  return {std::move(out), std::move(shape)};
}

std::vector<std::vector<Outline>> moved_ground(const StandingShape& shape, Vec3 moved_m) {
  std::vector<std::vector<Outline>> out = shape.ground;
  for (auto& piece : out)
    for (Outline& outline : piece)
      for (Vec3& p : outline) p = {p.x + moved_m.x, p.y + moved_m.y, 0};
  return out;
}

}  // namespace oriel
