#include "kernel/segment/cuts/pockets.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>

namespace oriel::detail {

namespace {

/// What has more facets is flooded and cut by itself.
constexpr std::size_t kMostPocketFacets = 64;

bool is_of_pocket(const Region& region) {
  return region.is_natural && region.loops.size() == 1 && region.covered.empty();
}

}  // namespace

void Pockets::changed(std::span<const RestChange> changes) {
  order_.pocket = {};
  StampSet<PointId>& is_touched = body_.world().scratch.met_points;
  is_touched.start(body_.world().points.size());
  for (const RestChange& change : changes)
    for (const PointId p : change.points) is_touched.insert(p);
  const auto has_gone = [&](const Pocket& pocket) {
    const auto edges = edges_of(pocket);
    return std::ranges::any_of(kinds_[pocket.kind].corners, [&](const PocketCorner& corner) {
      return is_touched.contains(body_.origin(edges[at(corner.edge)]));
    });
  };
  for (PocketKind& kind : kinds_)
    if (kind.cap >= 0 && has_gone(pockets_[kind.first])) kind.cap = -1;
  for (Pocket& pocket : pockets_)
    if (pocket.kind.is_valid() && (kinds_[pocket.kind].cap < 0 || has_gone(pocket)))
      pocket.kind = {};
}

/// The pocket that was found in front of a region, when the body was the same there.
PocketId Pockets::find_known(const Section& section, const Region& region) const {
  if (!is_of_pocket(region)) return {};
  const PocketId known =
      at_edge_.find(section.crossings[section.loops[region.loops[0]].first].edge);
  if (!known.is_valid() || !pockets_[known].kind.is_valid()) return {};
  const PocketKind& kind = kinds_[pockets_[known].kind];
  const bool is_of_section =
      kind.cap == section.split_side(region) && kind.direction == section.direction;
  return is_of_section ? known : PocketId{};
}

PocketId Pockets::find(const Section& section, RegionId region, bool is_alone) {
  const Region& here = section.regions[region];
  if (const PocketId known = find_known(section, here); known.is_valid()) return known;
  if (!trace_rim(section, here)) return {};
  Pocket pocket;
  const PlaneSide cap = section.split_side(here);
  for (PocketKindId k{0}; !is_alone && kinds_.contains(k) && !pocket.kind.is_valid(); ++k.value)
    if (kinds_[k].cap == cap && kinds_[k].direction == section.direction &&
        is_like(kinds_[k], pocket, section))
      pocket.kind = k;
  if (!pocket.kind.is_valid()) {
    pocket.kind = new_kind(section, here);
    if (!pocket.kind.is_valid()) return {};
    pocket.shift = {};
  }
  pocket.first_edge = static_cast<int>(edges_.size());
  pocket.first_rim = static_cast<int>(rims_.size());
  edges_.insert(edges_.end(), walk_.begin(), walk_.end());
  rims_.insert(rims_.end(), rim_.begin(), rim_.end());
  const PocketId number = pockets_.push_back(pocket);
  at_edge_.make_room(body_.half_edge_count());
  at_edge_.set(section.crossings[section.loops[here.loops[0]].first].edge, number);
  return number;
}

/// The edges along the region's outline, and the facet beyond them. False if a chord is more or
/// less than an edge, or if they are not all of a hole of that facet.
bool Pockets::trace_rim(const Section& section, const Region& region) {
  if (!is_of_pocket(region)) return false;
  const auto& planes = body_.world().planes;
  const auto ranks = body_.world().points.ranks(planes.class_of(section.plane));
  const int rank = planes.rank_of(section.plane);
  StampSet<EdgeId>& rim_edges = body_.world().scratch.rim_edges;
  rim_edges.start(body_.half_edge_count());
  rim_.clear();
  Box box;
  const CrossingId first = section.loops[region.loops[0]].first;
  CrossingId c = first;
  do {
    const EdgeId e = body_.next(section.crossings[c].edge);
    c = section.crossings[c].next;
    if (body_.next(e) != body_.twin(section.crossings[c].edge)) return false;
    if (ranks[body_.origin(e)] != rank || ranks[body_.target(e)] != rank) return false;
    const EdgeId beyond = body_.twin(e);
    if (!rim_.empty() && body_.next(beyond) != body_.twin(rim_.back())) return false;
    rim_.push_back(e);
    rim_edges.insert(e);
    box.grow(body_.at(e));
  } while (c != first);
  corner_ = box.min;
  const EdgeId beyond = body_.twin(rim_.front());
  if (body_.next(beyond) != body_.twin(rim_.back())) return false;
  wall_ = body_.facet_of(beyond);
  return body_.loop(body_.edge(beyond).loop).is_hole &&
         body_.facet(wall_).side == section.split_side(region);
}

/// Lists what hangs together inside the rim. False if it is no pocket: its half-edges begin in
/// front of the section or on the rim, and to the wall there are edges of the rim only.
bool Pockets::list_facets(const Section& section, PocketKind& kind) {
  const auto& planes = body_.world().planes;
  const auto ranks = body_.world().points.ranks(planes.class_of(section.plane));
  const int limit = planes.rank_of(section.plane) * section.direction;
  StampSet<BodyFacetId>& is_met = body_.world().scratch.facets_of_lump;
  StampMap<EdgeId>& place = body_.world().scratch.place_in_walk;
  is_met.start(body_.facet_count());
  is_met.insert(wall_);
  place.start(body_.half_edge_count());
  walk_.clear();
  facets_.clear();
  if (!list_facet(kind, rim_[0])) return false;
  for (std::size_t i = 0; i < walk_.size(); ++i) {
    const EdgeId e = walk_[i], twin = body_.twin(e);
    const BodyFacetId beyond = body_.facet_of(twin);
    const int above = ranks[body_.origin(e)] * section.direction - limit;
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
bool Pockets::list_facet(PocketKind& kind, EdgeId first) {
  const BodyFacetId f = body_.facet_of(first);
  const LoopId loop = body_.edge(first).loop;
  const auto& facet = body_.facet(f);
  if (!facet.marks.empty() || facets_.size() == kMostPocketFacets) return false;
  body_.world().scratch.facets_of_lump.insert(f);
  facets_.push_back(f);
  kind.sizes.push_back(0);
  list_loop(kind, first);
  if (facet.loops.size() == 1) return true;
  for (const LoopId l : facet.loops)
    if (l != loop) list_loop(kind, body_.loop(l).first);
  bool has_rim = false;
  body_.for_each_edge(f, [&](EdgeId e) { has_rim |= is_rim(e) || is_rim(body_.prev(e)); });
  return !has_rim;
}

void Pockets::list_loop(PocketKind& kind, EdgeId first) {
  StampMap<EdgeId>& place = body_.world().scratch.place_in_walk;
  const int before = static_cast<int>(walk_.size());
  EdgeId e = first;
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
  StampSet<FacetId>& is_met = body_.world().scratch.met_sources;
  is_met.start(0);
  for (const BodyFacetId f : facets_)
    for (const FacetId source : body_.facet(f).sources) {
      is_met.make_room(source.value + 1);
      if (!is_met.insert(source)) return false;
    }
  return true;
}

std::span<const EdgeId> Pockets::edges_of(const Pocket& pocket) const {
  return std::span(edges_).subspan(at(pocket.first_edge), kinds_[pocket.kind].twins.size());
}

CutCap Pockets::cap_of(PocketId pocket) const {
  const Pocket& here = pockets_[pocket];
  const PocketKind& kind = kinds_[here.kind];
  CutCap cap{kind.cap, {}, {}};
  CapLoop& loop = cap.loops.emplace_back();
  loop.edges.reserve(at(kind.rim));
  for (const EdgeId e : std::span(rims_).subspan(at(here.first_rim), at(kind.rim)))
    loop.edges.push_back({e, body_.origin(e), body_.target(e)});
  return cap;
}

PocketLeaf Pockets::leaf_of(PocketId pocket, std::span<const BodyFacetId> facets,
                            bool is_hole) const {
  ORIEL_ASSERT(is_leaf(kind_of(pocket)));
  // Facet by facet and edge by edge as take_off() makes a body of it.
  const PocketKind& kind = kinds_[pockets_[pocket].kind];
  const int flip = is_hole ? 1 : 0;
  PocketLeaf leaf;
  leaf.faces.reserve(kind.sizes.size() + 1);
  leaf.sources.reserve(kind.sizes.size());
  for (const BodyFacetId f : facets) {
    const auto& facet = body_.facet(f);
    for (const FacetId source : facet.sources)
      leaf.sources.push_back({source, static_cast<int>(leaf.faces.size())});
    PocketLeaf::LeafFace& face = leaf.faces.emplace_back(facet.side ^ flip, Loop{});
    const EdgeId first = body_.loop(facet.loops[0]).first;
    face.loop.reserve(4);  // mostly
    EdgeId e = first;
    do {
      face.loop.push_back((is_hole ? body_.target(e) : body_.origin(e)).value);
      e = is_hole ? body_.prev(e) : body_.next(e);
    } while (e != first);
  }
  const auto rim = std::span(rims_).subspan(at(pockets_[pocket].first_rim), at(kind.rim));
  PocketLeaf::LeafFace& cap = leaf.faces.emplace_back(kind.cap ^ flip ^ 1, Loop{});
  cap.loop.reserve(rim.size());
  for (const EdgeId e : rim)
    cap.loop.push_back((is_hole ? body_.origin(e) : body_.target(e)).value);
  if (!is_hole) std::ranges::reverse(cap.loop);
  return leaf;
}

std::vector<PointId> Pockets::points_of(PocketId pocket) const {
  const auto edges = edges_of(pockets_[pocket]);
  const PocketKind& kind = kinds_[pockets_[pocket].kind];
  std::vector<PointId> points;
  points.reserve(kind.corners.size());
  for (const PocketCorner& corner : kind.corners)
    points.push_back(body_.origin(edges[at(corner.edge)]));
  std::ranges::sort(points);
  return points;
}

std::vector<BodyFacetId> Pockets::facets_of(PocketId pocket) const {
  const Pocket& here = pockets_[pocket];
  const PocketKind& kind = kinds_[here.kind];
  std::vector<BodyFacetId> facets;
  facets.reserve(kind.sizes.size());
  int i = here.first_edge;
  for (const int size : kind.sizes) {
    facets.push_back(body_.facet_of(edges_[at(i)]));
    i += size;
  }
  std::ranges::sort(facets);
  return facets;
}

Pockets::PocketOrder Pockets::order_of(PocketId pocket) const {
  const Pocket& here = pockets_[pocket];
  const PocketKind& kind = kinds_[here.kind];
  const auto edges = edges_of(here);
  PocketOrder order{pocket, {}, {}, {}};
  order.points.reserve(kind.corners.size());
  order.planes.reserve(kind.sizes.size() + 1);
  order.sources.reserve(kind.sizes.size());
  for (const PocketCorner& corner : kind.corners)
    order.points.emplace_back(body_.origin(edges[at(corner.edge)]), corner.edge);
  order.planes.emplace_back(kind.cap >> 1, -1);
  int first = 0;
  for (const int size : kind.sizes) {
    const auto& facet = body_.facet(body_.facet_of(edges[at(first)]));
    order.planes.emplace_back(facet.side >> 1, first);
    for (int i = 0; i < std::ssize(facet.sources); ++i)
      order.sources.emplace_back(facet.sources[at(i)], first, i);
    first += size;
  }
  std::ranges::sort(order.points);
  std::ranges::sort(order.planes);
  std::ranges::sort(order.sources);
  const auto again = std::ranges::unique(order.planes, {}, &std::pair<int, int>::first);
  order.planes.erase(again.begin(), again.end());
  return order;
}

Congruence Pockets::congruence(PocketId model, PocketId other) const {
  ORIEL_ASSERT(kind_of(model) == kind_of(other), "only pockets of one kind are congruent");
  if (order_.pocket != model) order_ = order_of(model);
  const Pocket &one = pockets_[model], &two = pockets_[other];
  Congruence how;
  for (std::size_t i = 0; i < 3; ++i) how.shift[i] = two.shift[i] - one.shift[i];
  how.shift_m = in_metres(how.shift);
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
