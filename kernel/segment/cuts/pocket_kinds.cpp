#include "kernel/base/index.h"
#include "kernel/segment/cuts/pockets.h"

#include <algorithm>
#include <cmath>

// Kinds of pockets: what those that are congruent have in common.

namespace oriel::detail {

namespace {

/// Points that are moved alike differ by no more than rounding.
bool is_same_place(Vec3 difference) {
  constexpr double kSame_m = 1e-9;  // tolerance of doubles, planes are compared exactly
  return dot(difference, difference) <= kSame_m * kSame_m;
}

}  // namespace

Vec3 Pockets::in_metres(const std::array<std::int64_t, 3>& shift) const {
  const double grid_m = body_.world().points.grid_m();
  return {static_cast<double>(shift[0]) * grid_m, static_cast<double>(shift[1]) * grid_m,
          static_cast<double>(shift[2]) * grid_m};
}

/// Whether the pocket at hand is of a kind. If so its half-edges are in walk_, in the kind's order,
/// and all that list_facets() asks for is known to hold: nothing is asked for that the kind has
/// not.
bool Pockets::is_like(const PocketKind& kind, Pocket& pocket, const Section& section) {
  if (std::ssize(rim_) != kind.rim) return false;
  const double grid_m = body_.world().points.grid_m();
  const Vec3 difference = corner_ - kind.corner;
  pocket.shift = {std::llround(difference.x / grid_m), std::llround(difference.y / grid_m),
                  std::llround(difference.z / grid_m)};
  if (!is_moved(kind.cap, kind.cap, pocket.shift)) return false;
  const Vec3 shift = in_metres(pocket.shift);
  const Vec3 from = body_.at(edges_[at(pockets_[kind.first].first_edge)]) + shift;
  const auto start =
      std::ranges::find_if(rim_, [&](EdgeId e) { return is_same_place(body_.at(e) - from); });
  return start != rim_.end() && walk_like(kind, *start, shift) &&
         are_corners_like(kind, shift, section) && are_facets_like(kind, pocket) &&
         has_own_sources();
}

/// Lists the half-edges of the pocket at hand from `start` on as those of the kind are listed.
/// False if its facets hang together otherwise.
bool Pockets::walk_like(const PocketKind& kind, EdgeId start, Vec3 shift) {
  StampSet<BodyFacetId>& is_found = body_.world().scratch.facets_of_lump;
  is_found.start(body_.facet_count());
  is_found.insert(wall_);
  walk_.clear();
  facets_.clear();
  const auto model = edges_of(pockets_[kind.first]);
  std::span<const int> loops = kind.loops;
  for (std::size_t f = 0; f < kind.sizes.size(); ++f) {
    const EdgeId e = f == 0 ? start : body_.twin(walk_[at(kind.entries[f - 1])]);
    if (!is_found.insert(body_.facet_of(e))) return false;
    if (!walk_facet(e, model.subspan(walk_.size(), at(kind.sizes[f])), loops, shift)) return false;
  }
  for (std::size_t i = 0; i < walk_.size(); ++i) {
    const int twin = kind.twins[i];
    if (twin < 0 ? !is_rim(walk_[i]) : body_.twin(walk_[i]) != walk_[at(twin)]) return false;
  }
  return true;
}

/// Lists the half-edges of a facet loop by loop, as those of the model's facet are listed. False if
/// its loops, the first of `loops`, which are taken from there, are others, or if it has marks.
bool Pockets::walk_facet(EdgeId first, std::span<const EdgeId> model, std::span<const int>& loops,
                         Vec3 shift) {
  const BodyFacetId f = body_.facet_of(first);
  if (!body_.facet(f).marks.empty()) return false;
  facets_.push_back(f);
  std::size_t listed = 0, count = 0;
  for (; listed < model.size(); ++count) {
    const auto start = count == 0 ? first : find_in_facet(f, body_.at(model[listed]) + shift);
    if (!start || !walk_loop(*start, loops[count])) return false;
    listed += at(loops[count]);
  }
  loops = loops.subspan(count);
  return body_.facet(f).loops.size() == count;
}

/// Lists the half-edges of a loop. False if they are more or fewer.
bool Pockets::walk_loop(EdgeId first, int size) {
  EdgeId e = first;
  for (; size > 0; --size) {
    walk_.push_back(e);
    e = body_.next(e);
    if (e == first) break;
  }
  return size == 1;
}

/// A half-edge of a facet that begins at a place.
std::optional<EdgeId> Pockets::find_in_facet(BodyFacetId f, Vec3 place) const {
  std::optional<EdgeId> found;
  body_.for_each_edge(f, [&](EdgeId e) {
    if (!found && is_same_place(body_.at(e) - place)) found = e;
  });
  return found;
}

/// Vertices are those of the kind, moved; and those beside the rim are in front of the section.
bool Pockets::are_corners_like(const PocketKind& kind, Vec3 shift, const Section& section) const {
  const auto& planes = body_.world().planes;
  const auto ranks = body_.world().points.ranks(planes.class_of(section.plane));
  const int limit = planes.rank_of(section.plane) * section.direction;
  const auto edges = edges_of(pockets_[kind.first]);
  return std::ranges::all_of(kind.corners, [&](const PocketCorner& corner) {
    const EdgeId e = walk_[at(corner.edge)];
    return is_same_place(body_.at(e) - body_.at(edges[at(corner.edge)]) - shift) &&
           (corner.is_on_rim || ranks[body_.origin(e)] * section.direction > limit);
  });
}

/// The planes are those of the kind, moved, and the facets are made of as many of the solid's.
bool Pockets::are_facets_like(const PocketKind& kind, const Pocket& pocket) {
  const auto edges = edges_of(pockets_[kind.first]);
  std::size_t i = 0;
  return std::ranges::all_of(kind.sizes, [&](int size) {
    const auto &one = body_.facet(body_.facet_of(edges[i])),
               &two = body_.facet(body_.facet_of(walk_[i]));
    i += at(size);
    return one.sources.size() == two.sources.size() && is_moved(one.side, two.side, pocket.shift);
  });
}

/// A side, moved, is the other one. The ground is none but itself.
bool Pockets::is_moved(PlaneSide from, PlaneSide to,
                       const std::array<std::int64_t, 3>& shift) const {
  const auto& planes = body_.world().planes;
  if ((from & 1) != (to & 1) || planes.class_of(from >> 1) != planes.class_of(to >> 1))
    return false;
  const Plane& plane = planes.plane(from >> 1);
  std::int64_t offset = plane.offset;
  for (std::size_t i = 0; i < 3; ++i) offset += plane.coefficients[i] * shift[i];
  if (planes.plane(to >> 1).offset != offset) return false;
  return from == to || (from >> 1 != ground_plane_ && to >> 1 != ground_plane_);
}

/// The pocket at hand is the first of its kind; invalid if it is none.
PocketKindId Pockets::new_kind(const Section& section, const Region& region) {
  PocketKind kind;
  constexpr std::size_t kFacets = 8;  // a window has no more, mostly
  kind.sizes.reserve(kFacets);
  kind.loops.reserve(kFacets);
  kind.entries.reserve(kFacets);
  kind.twins.reserve(4 * kFacets);
  if (!list_facets(section, kind)) return {};
  kind.cap = section.split_side(region);
  kind.direction = section.direction;
  kind.first = pockets_.next_id();
  kind.corner = corner_;
  kind.rim = static_cast<int>(rim_.size());
  list_corners(kind);
  kind.is_convex = is_convex_pocket(kind, walk_, !region.is_material);
  judge(kind, !region.is_material);
  return kinds_.push_back(std::move(kind));
}

void Pockets::list_corners(PocketKind& kind) {
  StampMap<PointId>& corner_at = body_.world().scratch.corner_at_point;
  corner_at.start(body_.world().points.size());
  kind.corners.reserve(walk_.size() / 2);  // no fewer half-edges begin at a vertex
  for (int i = 0; i < std::ssize(walk_); ++i) {
    const EdgeId e = walk_[at(i)];
    const PointId point = body_.origin(e);
    int number = corner_at.find(point);
    if (number < 0) {
      number = static_cast<int>(kind.corners.size());
      corner_at.set(point, number);
      kind.corners.push_back({i, is_rim(e) || is_rim(body_.prev(e))});
    }
    ++kind.corners[at(number)].facets;
  }
}

/// What its lump and its leaf ask for, beside convexity.
void Pockets::judge(PocketKind& kind, bool is_hole) const {
  const StampMap<PointId>& corner_at = body_.world().scratch.corner_at_point;
  const auto is_on_rim = [&](PointId point) {
    return kind.corners[at(corner_at.find(point))].is_on_rim;
  };
  // The edges of a convex one bend all one way.
  kind.has_bend = is_hole && kind.is_convex &&
                  std::ranges::any_of(kind.twins, [](int twin) { return twin >= 0; });
  kind.is_leaf = kind.is_convex && kind.loops.size() == kind.sizes.size() &&
                 std::ranges::all_of(kind.corners, [](const PocketCorner& corner) {
                   return corner.facets + (corner.is_on_rim ? 1 : 0) > 2;
                 });
  std::size_t i = 0;
  for (const int size : kind.sizes) {
    int chords = 0;
    for (const std::size_t last = i + at(size); i < last; ++i) {
      const EdgeId e = walk_[i];
      if (kind.twins[i] < 0) {
        ++chords;
        continue;
      }
      // One answer for both half-edges of an edge.
      if (at(kind.twins[i]) < i) continue;
      kind.has_bend = kind.has_bend || (!kind.is_convex && body_.is_reflex(e));
      kind.is_unclear |= is_on_rim(body_.origin(e)) && is_on_rim(body_.target(e));
    }
    // Of one chord alone, and with area on its side for certain, the pieces are sound.
    kind.is_unclear |= chords > 1 || body_.area(body_.facet_of(walk_[i - 1])) <= kThin_m;
  }
}

std::optional<Pockets::FloodedPocket> Pockets::flooded(PocketId pocket, const Section& section,
                                                       const Region& region) const {
  const PocketKind& kind = kinds_[pockets_[pocket].kind];
  if (kind.is_unclear) return std::nullopt;
  const auto& planes = body_.world().planes;
  const auto edges = edges_of(pockets_[pocket]);
  double sum = 0;
  std::size_t first = 0;
  for (const int size : kind.sizes) {
    const BodyFacetId f = body_.facet_of(edges[first]);
    sum += planes.offset_m(body_.facet(f).side) * body_.area(f);
    first += at(size);
  }
  const double cap = planes.offset_m(section.looking()) * region.area;
  return FloodedPocket{((region.is_material ? sum : -sum) - cap) / 3, kind.has_bend};
}

bool Pockets::is_convex_pocket(const PocketKind& kind, std::span<const EdgeId> edges,
                               bool is_hole) const {
  constexpr double kHardly = 0.02;  // sine: flatter edges are left to Boundary::is_reflex
  const auto& planes = body_.world().planes;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    // One answer for both half-edges of an edge.
    if (kind.twins[i] >= 0 && at(kind.twins[i]) < i) continue;
    const EdgeId e = edges[i];
    const Vec3 mine = planes.normal(body_.side_of_edge(e));
    const Vec3 along = normalised(body_.world().points.at(body_.target(e)) - body_.at(e));
    // A cap in the rest looks the other way than one on the lump, as the walls of a hole do.
    const Vec3 theirs = kind.twins[i] < 0 ? -planes.normal(kind.cap)
                                          : planes.normal(body_.side_of_edge(body_.twin(e)));
    const double bend = dot(cross(mine, theirs), along);
    if ((is_hole ? -bend : bend) <= kHardly) return false;
  }
  return true;
}

}  // namespace oriel::detail
