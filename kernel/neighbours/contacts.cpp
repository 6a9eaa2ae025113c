#include "kernel/neighbours/contacts.h"

#include "kernel/geometry/boxes.h"
#include "kernel/geometry/shared_area.h"
#include "model/tolerances.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace oriel::detail {

namespace {

/// A wall in the plane of another.
struct MovedWall {
  std::vector<Outline> outlines;
  double widest_m = 0;  ///< how far it was moved
};

/// Nothing if a corner of it is further off than walls that touch are.
std::optional<MovedWall> moved_into_plane(const UprightWall& wall, Vec3 moved_m, Vec3 point,
                                          Vec3 normal) {
  MovedWall out;
  for (const Outline& outline : wall.outlines) {
    Outline& flat = out.outlines.emplace_back();
    for (const Vec3 p : outline) {
      const double off_m = dot(p + moved_m - point, normal);
      if (std::abs(off_m) > kContact_m) return std::nullopt;
      out.widest_m = std::max(out.widest_m, std::abs(off_m));
      flat.push_back(p + moved_m - off_m * normal);
    }
  }
  return out;
}

/// A plane into which a wall was moved, so that it does not stand in it twice.
struct TakenPlane {
  const UprightWall* wall;
  Vec3 point, normal;
};

bool is_taken(const std::vector<TakenPlane>& taken, const UprightWall& wall, Vec3 point) {
  return std::ranges::any_of(taken, [&](const TakenPlane& plane) {
    return plane.wall == &wall && std::abs(dot(point - plane.point, plane.normal)) <= kPartyWall_m;
  });
}

}  // namespace

BuildingContact contact_between(const ShapedBuilding& one, const ShapedBuilding& other,
                                std::vector<NeighbourWall>* walls) {
  BuildingContact out;
  out.building = other.known.id;
  const Vec3 moved_m = other.known.origin_m - one.known.origin_m;
  const Box its = other.known.box.moved(moved_m);
  std::vector<TakenPlane> taken;
  for (const UprightWall& wall : one.shape->walls) {
    if (!overlap(wall.box, its, kContact_m)) continue;
    for (const UprightWall& against : other.shape->walls) {
      if (length(wall.normal + against.normal) > kPartyWallLean ||
          !overlap(wall.box, against.box.moved(moved_m), kContact_m))
        continue;
      const Vec3 point = wall.outlines[0][0];
      auto moved = moved_into_plane(against, moved_m, point, wall.normal);
      if (!moved) continue;
      const double area_m2 = shared_area_m2(wall.outlines, moved->outlines, wall.normal);
      if (area_m2 <= kPartyWall_m2) continue;
      out.area_m2 += area_m2;
      out.widest_m = std::max(out.widest_m, moved->widest_m);
      if (walls == nullptr || is_taken(taken, against, point)) continue;
      taken.push_back({&against, point, wall.normal});
      walls->push_back({other.known.id, std::move(moved->outlines), -wall.normal});
    }
  }
  return out;
}

double common_ground_m2(const ShapedBuilding& one, const ShapedBuilding& other) {
  const Vec3 moved_m = other.known.origin_m - one.known.origin_m;
  const Box own_box = one.known.box, its = other.known.box.moved(moved_m);
  const double high_m = std::min(own_box.max.z, its.max.z) - std::max(own_box.min.z, its.min.z);
  if (!overlap(own_box, its) || high_m <= kContact_m) return 0;
  double sum_m2 = 0;
  for (const auto& piece : moved_ground(*other.shape, moved_m))
    for (const auto& own : one.shape->ground) sum_m2 += shared_area_m2(own, piece, {0, 0, 1});
  return sum_m2;
}

}  // namespace oriel::detail
