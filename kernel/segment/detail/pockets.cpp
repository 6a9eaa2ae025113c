#include "kernel/segment/detail/pockets.h"

#include "kernel/model/detail/index.h"

#include <algorithm>
#include <cmath>

namespace oriel::detail {

namespace {

/// What has more facets is flooded and cut by itself.
constexpr std::size_t kMostPocketFacets = 64;

/// Points that are moved alike differ by no more than rounding.
bool is_same_place(Vec3 difference) {
  constexpr double kSame_m = 1e-9;  // tolerance of doubles, planes are compared exactly
  return dot(difference, difference) <= kSame_m * kSame_m;
}

bool is_of_pocket(const Region& region) {
  return region.is_natural && region.loops.size() == 1 && region.covered.empty();
}

Vec3 shift_in_metres(const std::array<std::int64_t, 3>& shift, double grid_m) {
  return {static_cast<double>(shift[0]) * grid_m, static_cast<double>(shift[1]) * grid_m,
          static_cast<double>(shift[2]) * grid_m};
}

}  // namespace

void Pockets::changed(const std::vector<Change>& changes) {
  order_.pocket = -1;
  StampSet& is_touched = body_.world().scratch.met_points;
  is_touched.start(body_.world().points.size());
  for (const Change& change : changes)
    for (const int p : change.points) is_touched.insert(p);
  const auto has_gone = [&](const Pocket& pocket) {
    const auto edges = edges_of(pocket);
    return std::ranges::any_of(kinds_[at(pocket.kind)].corners, [&](const Corner& corner) {
      return is_touched.contains(body_.origin(edges[at(corner.edge)]));
    });
  };
  for (Kind& kind : kinds_)
    if (kind.cap >= 0 && has_gone(pockets_[at(kind.first)])) kind.cap = -1;
  for (Pocket& pocket : pockets_)
    if (pocket.kind >= 0 && (kinds_[at(pocket.kind)].cap < 0 || has_gone(pocket))) pocket.kind = -1;
}

/// The pocket that was found in front of a region, when the body was the same there.
int Pockets::find_known(const Section& section, const Region& region) const {
  if (!is_of_pocket(region)) return -1;
  const int known =
      at_edge_.find(section.crossings[at(section.loops[at(region.loops[0])].first)].edge);
  if (known < 0 || pockets_[at(known)].kind < 0) return -1;
  const Kind& kind = kinds_[at(pockets_[at(known)].kind)];
  const bool is_of_section =
      kind.cap == section.split_side(region) && kind.direction == section.direction;
  return is_of_section ? known : -1;
}

int Pockets::find(const Section& section, int region, bool is_alone) {
  const Region& here = section.regions[at(region)];
  if (const int known = find_known(section, here); known >= 0) return known;
  if (!trace_rim(section, here)) return -1;
  Pocket pocket;
  const Side cap = section.split_side(here);
  for (int k = 0; !is_alone && k < std::ssize(kinds_) && pocket.kind < 0; ++k)
    if (kinds_[at(k)].cap == cap && kinds_[at(k)].direction == section.direction &&
        is_like(kinds_[at(k)], pocket, section))
      pocket.kind = k;
  if (pocket.kind < 0) {
    pocket.kind = new_kind(section, here);
    if (pocket.kind < 0) return -1;
    pocket.shift = {};
  }
  pocket.first_edge = static_cast<int>(edges_.size());
  pocket.first_rim = static_cast<int>(rims_.size());
  edges_.insert(edges_.end(), walk_.begin(), walk_.end());
  rims_.insert(rims_.end(), rim_.begin(), rim_.end());
  const int number = static_cast<int>(pockets_.size());
  pockets_.push_back(pocket);
  at_edge_.make_room(body_.half_edge_count());
  at_edge_.set(section.crossings[at(section.loops[at(here.loops[0])].first)].edge, number);
  return number;
}

/// The edges along the region's outline, and the facet beyond them. False if a chord is more or
/// less than an edge, or if they are not all of a hole of that facet.
bool Pockets::trace_rim(const Section& section, const Region& region) {
  if (!is_of_pocket(region)) return false;
  const auto& planes = body_.world().planes;
  const auto ranks = body_.world().points.ranks(planes.class_of(section.plane));
  const int rank = planes.rank_of(section.plane);
  StampSet& rim_edges = body_.world().scratch.rim_edges;
  rim_edges.start(body_.half_edge_count());
  rim_.clear();
  Box box;
  const int first = section.loops[at(region.loops[0])].first;
  int c = first;
  do {
    const int e = body_.next(section.crossings[at(c)].edge);
    c = section.crossings[at(c)].next;
    if (body_.next(e) != body_.twin(section.crossings[at(c)].edge)) return false;
    if (ranks[at(body_.origin(e))] != rank || ranks[at(body_.target(e))] != rank) return false;
    const int beyond = body_.twin(e);
    if (!rim_.empty() && body_.next(beyond) != body_.twin(rim_.back())) return false;
    rim_.push_back(e);
    rim_edges.insert(e);
    box.grow(body_.at(e));
  } while (c != first);
  corner_ = box.min;
  const int beyond = body_.twin(rim_.front());
  if (body_.next(beyond) != body_.twin(rim_.back())) return false;
  wall_ = body_.facet_of(beyond);
  return body_.loop(body_.edge(beyond).loop).is_hole &&
         body_.facet(wall_).side == section.split_side(region);
}

/// Lists what hangs together inside the rim. False if it is no pocket: its half-edges begin in
/// front of the section or on the rim, and to the wall there are edges of the rim only.
bool Pockets::list_facets(const Section& section, Kind& kind) {
  const auto& planes = body_.world().planes;
  const auto ranks = body_.world().points.ranks(planes.class_of(section.plane));
  const int limit = planes.rank_of(section.plane) * section.direction;
  StampSet& is_met = body_.world().scratch.facets_of_lump;
  StampMap& place = body_.world().scratch.place_in_walk;
  is_met.start(body_.facet_count());
  is_met.insert(wall_);
  place.start(body_.half_edge_count());
  walk_.clear();
  facets_.clear();
  if (!list_facet(kind, rim_[0])) return false;
  for (std::size_t i = 0; i < walk_.size(); ++i) {
    const int e = walk_[i], twin = body_.twin(e), beyond = body_.facet_of(twin);
    const int above = ranks[at(body_.origin(e))] * section.direction - limit;
    if (above < 0 || (above == 0 && !is_rim(e) && !is_rim(body_.prev(e)))) return false;
    if (beyond == wall_ && (above > 0 || !is_rim(e))) return false;
    if (!is_met.contains(beyond)) {
      kind.entries.push_back(static_cast<int>(i));
      if (!list_facet(kind, twin)) return false;
    }
    kind.twins.push_back(place.find(twin));
  }
  return has_own_sources();
}

/// False if it is none of a pocket.
bool Pockets::list_facet(Kind& kind, int first) {
  const int f = body_.facet_of(first), loop = body_.edge(first).loop;
  const auto& facet = body_.facet(f);
  if (!facet.marks.empty() || facets_.size() == kMostPocketFacets) return false;
  body_.world().scratch.facets_of_lump.insert(f);
  facets_.push_back(f);
  kind.sizes.push_back(0);
  list_loop(kind, first);
  if (facet.loops.size() == 1) return true;
  for (const int l : facet.loops)
    if (l != loop) list_loop(kind, body_.loop(l).first);
  bool has_rim = false;
  body_.for_each_edge(f, [&](int e) { has_rim |= is_rim(e) || is_rim(body_.prev(e)); });
  return !has_rim;
}

void Pockets::list_loop(Kind& kind, int first) {
  StampMap& place = body_.world().scratch.place_in_walk;
  const int before = static_cast<int>(walk_.size());
  int e = first;
  do {
    place.set(e, static_cast<int>(walk_.size()));
    walk_.push_back(e);
    e = body_.next(e);
  } while (e != first);
  kind.loops.push_back(static_cast<int>(walk_.size()) - before);
  kind.sizes.back() += kind.loops.back();
}

/// No two of its facets are made of one facet of the solid.
bool Pockets::has_own_sources() {
  sources_.clear();
  for (const int f : facets_) {
    const auto& sources = body_.facet(f).sources;
    sources_.insert(sources_.end(), sources.begin(), sources.end());
  }
  std::ranges::sort(sources_);
  return std::ranges::adjacent_find(sources_) == sources_.end();
}

std::span<const int> Pockets::edges_of(const Pocket& pocket) const {
  return std::span(edges_).subspan(at(pocket.first_edge), kinds_[at(pocket.kind)].twins.size());
}

/// Whether the pocket at hand is of a kind. If so its half-edges are in walk_, in the kind's order,
/// and all that list_facets() asks for is known to hold: nothing is asked for that the kind has
/// not.
bool Pockets::is_like(const Kind& kind, Pocket& pocket, const Section& section) {
  if (std::ssize(rim_) != kind.rim) return false;
  const double grid_m = body_.world().points.grid_m();
  const Vec3 difference = corner_ - kind.corner;
  pocket.shift = {std::llround(difference.x / grid_m), std::llround(difference.y / grid_m),
                  std::llround(difference.z / grid_m)};
  if (!is_moved(kind.cap, kind.cap, pocket.shift)) return false;
  const Vec3 shift = shift_in_metres(pocket.shift, grid_m);
  const Vec3 from = body_.at(edges_[at(pockets_[at(kind.first)].first_edge)]) + shift;
  const auto start =
      std::ranges::find_if(rim_, [&](int e) { return is_same_place(body_.at(e) - from); });
  return start != rim_.end() && walk_like(kind, *start, shift) &&
         are_corners_like(kind, shift, section) && are_facets_like(kind, pocket) &&
         has_own_sources();
}

/// Lists the half-edges of the pocket at hand from `start` on as those of the kind are listed.
/// False if its facets hang together otherwise.
bool Pockets::walk_like(const Kind& kind, int start, Vec3 shift) {
  StampSet& is_found = body_.world().scratch.facets_of_lump;
  is_found.start(body_.facet_count());
  is_found.insert(wall_);
  walk_.clear();
  facets_.clear();
  const auto model = edges_of(pockets_[at(kind.first)]);
  std::span<const int> loops = kind.loops;
  for (std::size_t f = 0; f < kind.sizes.size(); ++f) {
    const int e = f == 0 ? start : body_.twin(walk_[at(kind.entries[f - 1])]);
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
bool Pockets::walk_facet(int first, std::span<const int> model, std::span<const int>& loops,
                         Vec3 shift) {
  const int f = body_.facet_of(first);
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
bool Pockets::walk_loop(int first, int size) {
  int e = first;
  for (; size > 0; --size) {
    walk_.push_back(e);
    e = body_.next(e);
    if (e == first) break;
  }
  return size == 1;
}

/// A half-edge of a facet that begins at a place.
std::optional<int> Pockets::find_in_facet(int f, Vec3 place) const {
  std::optional<int> found;
  body_.for_each_edge(f, [&](int e) {
    if (!found && is_same_place(body_.at(e) - place)) found = e;
  });
  return found;
}

/// Vertices are those of the kind, moved; and those beside the rim are in front of the section.
bool Pockets::are_corners_like(const Kind& kind, Vec3 shift, const Section& section) const {
  const auto& planes = body_.world().planes;
  const auto ranks = body_.world().points.ranks(planes.class_of(section.plane));
  const int limit = planes.rank_of(section.plane) * section.direction;
  const auto edges = edges_of(pockets_[at(kind.first)]);
  return std::ranges::all_of(kind.corners, [&](const Corner& corner) {
    const int e = walk_[at(corner.edge)];
    return is_same_place(body_.at(e) - body_.at(edges[at(corner.edge)]) - shift) &&
           (corner.is_on_rim || ranks[at(body_.origin(e))] * section.direction > limit);
  });
}

/// The planes are those of the kind, moved, and the facets are made of as many of the solid's.
bool Pockets::are_facets_like(const Kind& kind, const Pocket& pocket) {
  const auto edges = edges_of(pockets_[at(kind.first)]);
  std::size_t i = 0;
  return std::ranges::all_of(kind.sizes, [&](int size) {
    const auto &one = body_.facet(body_.facet_of(edges[i])),
               &two = body_.facet(body_.facet_of(walk_[i]));
    i += at(size);
    return one.sources.size() == two.sources.size() && is_moved(one.side, two.side, pocket.shift);
  });
}

/// A side, moved, is the other one. The ground is none but itself.
bool Pockets::is_moved(Side from, Side to, const std::array<std::int64_t, 3>& shift) const {
  const auto& planes = body_.world().planes;
  if ((from & 1) != (to & 1) || planes.class_of(from >> 1) != planes.class_of(to >> 1))
    return false;
  const Plane& plane = planes.plane(from >> 1);
  std::int64_t offset = plane.offset;
  for (std::size_t i = 0; i < 3; ++i) offset += plane.coefficients[i] * shift[i];
  if (planes.plane(to >> 1).offset != offset) return false;
  return from == to || (from >> 1 != ground_plane_ && to >> 1 != ground_plane_);
}

/// The pocket at hand is the first of its kind; -1 if it is none.
int Pockets::new_kind(const Section& section, const Region& region) {
  Kind kind;
  constexpr std::size_t kFacets = 8;  // a window has no more, mostly
  kind.sizes.reserve(kFacets);
  kind.loops.reserve(kFacets);
  kind.entries.reserve(kFacets);
  kind.twins.reserve(4 * kFacets);
  if (!list_facets(section, kind)) return -1;
  kind.cap = section.split_side(region);
  kind.direction = section.direction;
  kind.first = static_cast<int>(pockets_.size());
  kind.corner = corner_;
  kind.rim = static_cast<int>(rim_.size());
  list_corners(kind);
  kind.is_convex = is_convex_pocket(kind, walk_, !region.is_material);
  judge(kind, !region.is_material);
  kinds_.push_back(std::move(kind));
  return static_cast<int>(kinds_.size()) - 1;
}

void Pockets::list_corners(Kind& kind) {
  StampMap& corner_at = body_.world().scratch.corner_at_point;
  corner_at.start(body_.world().points.size());
  kind.corners.reserve(walk_.size() / 2);  // no fewer half-edges begin at a vertex
  for (int i = 0; i < std::ssize(walk_); ++i) {
    const int e = walk_[at(i)], point = body_.origin(e);
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
void Pockets::judge(Kind& kind, bool is_hole) const {
  const StampMap& corner_at = body_.world().scratch.corner_at_point;
  const auto is_on_rim = [&](int point) {
    return kind.corners[at(corner_at.find(point))].is_on_rim;
  };
  // The edges of a convex one bend all one way.
  kind.has_bend = is_hole && kind.is_convex &&
                  std::ranges::any_of(kind.twins, [](int twin) { return twin >= 0; });
  kind.is_leaf = kind.is_convex && kind.loops.size() == kind.sizes.size() &&
                 std::ranges::all_of(kind.corners, [](const Corner& corner) {
                   return corner.facets + (corner.is_on_rim ? 1 : 0) > 2;
                 });
  std::size_t i = 0;
  for (const int size : kind.sizes) {
    int chords = 0;
    for (const std::size_t last = i + at(size); i < last; ++i) {
      const int e = walk_[i];
      if (kind.twins[i] < 0) {
        ++chords;
        continue;
      }
      kind.has_bend = kind.has_bend || (!kind.is_convex && body_.is_reflex(e));
      kind.is_unclear |= is_on_rim(body_.origin(e)) && is_on_rim(body_.target(e));
    }
    // Of one chord alone, and with area on its side for certain, the pieces are sound.
    kind.is_unclear |= chords > 1 || body_.area(body_.facet_of(walk_[i - 1])) <= kThin_m;
  }
}

std::optional<Pockets::Flooded> Pockets::flooded(int pocket, const Section& section,
                                                 const Region& region) const {
  const Kind& kind = kinds_[at(pockets_[at(pocket)].kind)];
  if (kind.is_unclear) return std::nullopt;
  const auto& planes = body_.world().planes;
  const auto edges = edges_of(pockets_[at(pocket)]);
  double sum = 0;
  std::size_t first = 0;
  for (const int size : kind.sizes) {
    const int f = body_.facet_of(edges[first]);
    sum += planes.offset_m(body_.facet(f).side) * body_.area(f);
    first += at(size);
  }
  const double cap = planes.offset_m(section.looking()) * region.area;
  return Flooded{((region.is_material ? sum : -sum) - cap) / 3, kind.has_bend};
}

bool Pockets::is_convex_pocket(const Kind& kind, std::span<const int> edges, bool is_hole) const {
  constexpr double kHardly = 0.02;  // sine: flatter edges are left to Boundary::is_reflex
  const auto& planes = body_.world().planes;
  for (std::size_t i = 0; i < edges.size(); ++i) {
    // One answer for both half-edges of an edge.
    if (kind.twins[i] >= 0 && at(kind.twins[i]) < i) continue;
    const int e = edges[i];
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

Cap Pockets::cap_of(int pocket) const {
  const Pocket& here = pockets_[at(pocket)];
  const Kind& kind = kinds_[at(here.kind)];
  Cap cap{kind.cap, {}, {}};
  CapLoop& loop = cap.loops.emplace_back();
  loop.edges.reserve(at(kind.rim));
  for (const int e : std::span(rims_).subspan(at(here.first_rim), at(kind.rim)))
    loop.edges.push_back({e, body_.origin(e), body_.target(e)});
  return cap;
}

Leaf Pockets::leaf_of(int pocket, bool is_hole) const {
  // Facet by facet and edge by edge as take_off() makes a body of it.
  const Kind& kind = kinds_[at(pockets_[at(pocket)].kind)];
  const int flip = is_hole ? 1 : 0;
  Leaf leaf;
  leaf.faces.reserve(kind.sizes.size() + 1);
  leaf.sources.reserve(kind.sizes.size());
  for (const int f : facets_of(pocket)) {
    const auto& facet = body_.facet(f);
    for (const int source : facet.sources)
      leaf.sources.push_back({source, static_cast<int>(leaf.faces.size())});
    Leaf::Face& face = leaf.faces.emplace_back(facet.side ^ flip, Loop{});
    const int first = body_.loop(facet.loops[0]).first;
    face.loop.reserve(4);  // mostly
    int e = first;
    do {
      face.loop.push_back(is_hole ? body_.target(e) : body_.origin(e));
      e = is_hole ? body_.prev(e) : body_.next(e);
    } while (e != first);
  }
  const auto rim = std::span(rims_).subspan(at(pockets_[at(pocket)].first_rim), at(kind.rim));
  Leaf::Face& cap = leaf.faces.emplace_back(kind.cap ^ flip ^ 1, Loop{});
  cap.loop.reserve(rim.size());
  for (const int e : rim) cap.loop.push_back(is_hole ? body_.origin(e) : body_.target(e));
  if (!is_hole) std::ranges::reverse(cap.loop);
  return leaf;
}

std::vector<int> Pockets::points_of(int pocket) const {
  const auto edges = edges_of(pockets_[at(pocket)]);
  const Kind& kind = kinds_[at(pockets_[at(pocket)].kind)];
  std::vector<int> points;
  points.reserve(kind.corners.size());
  for (const Corner& corner : kind.corners) points.push_back(body_.origin(edges[at(corner.edge)]));
  std::ranges::sort(points);
  return points;
}

std::vector<int> Pockets::facets_of(int pocket) const {
  const Pocket& here = pockets_[at(pocket)];
  const Kind& kind = kinds_[at(here.kind)];
  std::vector<int> facets;
  facets.reserve(kind.sizes.size());
  int i = here.first_edge;
  for (const int size : kind.sizes) {
    facets.push_back(body_.facet_of(edges_[at(i)]));
    i += size;
  }
  std::ranges::sort(facets);
  return facets;
}

Pockets::Order Pockets::order_of(int pocket) const {
  const Pocket& here = pockets_[at(pocket)];
  const Kind& kind = kinds_[at(here.kind)];
  const auto edges = edges_of(here);
  Order order{pocket, {}, {}, {}};
  for (const Corner& corner : kind.corners)
    order.points.emplace_back(body_.origin(edges[at(corner.edge)]), corner.edge);
  order.planes.emplace_back(kind.cap >> 1, -1);
  int first = 0;
  for (const int size : kind.sizes) {
    const auto& facet = body_.facet(body_.facet_of(edges[at(first)]));
    order.planes.emplace_back(facet.side >> 1, first);
    for (int i = 0; i < std::ssize(facet.sources); ++i)
      order.sources.push_back({facet.sources[at(i)], first, i});
    first += size;
  }
  std::ranges::sort(order.points);
  std::ranges::sort(order.planes);
  std::ranges::sort(order.sources);
  const auto again = std::ranges::unique(order.planes, {}, &std::pair<int, int>::first);
  order.planes.erase(again.begin(), again.end());
  return order;
}

Congruence Pockets::congruence(int model, int other) const {
  if (order_.pocket != model) order_ = order_of(model);
  const Pocket &one = pockets_[at(model)], &two = pockets_[at(other)];
  Congruence how;
  for (std::size_t i = 0; i < 3; ++i) how.shift[i] = two.shift[i] - one.shift[i];
  how.shift_m = shift_in_metres(how.shift, body_.world().points.grid_m());
  const auto others = edges_of(two);
  how.points.reserve(order_.points.size());
  how.planes.reserve(order_.planes.size());
  how.sources.reserve(order_.sources.size());
  for (const auto& [point, e] : order_.points)
    how.points.emplace_back(point, body_.origin(others[at(e)]));
  for (const auto& [plane, e] : order_.planes)
    how.planes.emplace_back(plane, e < 0 ? plane : body_.side_of_edge(others[at(e)]) >> 1);
  for (const auto& [source, e, i] : order_.sources)
    how.sources.emplace_back(source, body_.facet(body_.facet_of(others[at(e)])).sources[at(i)]);
  return how;
}

}  // namespace oriel::detail
