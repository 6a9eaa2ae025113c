#include "kernel/segment/boundary/boundary.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oriel::detail {

double Boundary::area(BodyFacetId f) const {
  double sum = 0;
  for (const LoopId l : facet(f).loops) sum += loop(l).area;
  return sum;
}

std::size_t Boundary::place_of(PlaneSide side) const {
  const auto place =
      std::ranges::lower_bound(number_of_side_, side, {}, &std::pair<PlaneSide, int>::first);
  return static_cast<std::size_t>(place - number_of_side_.begin());
}

const Boundary::OnSide* Boundary::on_side(PlaneSide side) const {
  const std::size_t place = place_of(side);
  if (place == number_of_side_.size() || number_of_side_[place].first != side) return nullptr;
  return &on_side_[index(number_of_side_[place].second)];
}

double Boundary::area_on(PlaneSide side) const {
  const OnSide* on = on_side(side);
  return on == nullptr || on->living == 0 ? 0 : on->area;
}

Boundary::OnPlane Boundary::on_plane(int plane) const {
  OnPlane found;
  for (std::size_t i = place_of(2 * plane); i < number_of_side_.size(); ++i) {
    const auto [side, number] = number_of_side_[i];
    if (side >> 1 != plane) break;
    const OnSide& on = on_side_[index(number)];
    if (on.living == 0) continue;
    found.areas[index(side & 1)] = on.area;
    found.has_facets[index(side & 1)] = true;
  }
  return found;
}

std::vector<PlaneSide> Boundary::sides() const {
  std::vector<PlaneSide> sides;
  sides.reserve(number_of_side_.size());
  for (const auto& [side, number] : number_of_side_)
    if (on_side_[index(number)].living > 0) sides.push_back(side);
  return sides;
}

std::vector<BodyFacetId> Boundary::facets_on(PlaneSide side) const {
  std::vector<BodyFacetId> living;
  if (const OnSide* on = on_side(side))
    for (const BodyFacetId f : on->facets)
      if (is_alive(f)) living.push_back(f);
  return living;
}

std::vector<BodyFacetId> Boundary::living_facets() const {
  std::vector<BodyFacetId> living;
  for (const BodyFacetId f : facet_ids())
    if (is_alive(f)) living.push_back(f);
  return living;
}

Outline Boundary::outline(LoopId l) const {
  Outline points;
  const EdgeId first = loop(l).first;
  EdgeId e = first;
  std::size_t size = 0;
  do {
    ++size;
    e = next(e);
  } while (e != first);
  points.reserve(size);
  do {
    points.push_back(at(e));
    e = next(e);
  } while (e != first);
  return points;
}

std::vector<Outline> Boundary::outlines(BodyFacetId f) const {
  std::vector<Outline> all;
  all.reserve(facet(f).loops.size());
  for (const LoopId l : facet(f).loops) all.push_back(outline(l));
  return all;
}

double Boundary::volume() const {
  double sum = 0;
  for (const BodyFacetId f : facet_ids())
    if (is_alive(f)) sum += world_->planes.offset_m(facet(f).side) * area(f);
  return sum / 3;
}

bool Boundary::bends_inward(EdgeId e) const {
  const PlaneSide mine = side_of_edge(e), theirs = side_of_edge(twin(e));
  if (mine >> 1 == theirs >> 1) return false;
  const Vec3 along = normalised(world_->points.at(target(e)) - at(e));
  const double bend = dot(cross(world_->planes.normal(mine), world_->planes.normal(theirs)), along);
  // The edge between two planes that hardly differ may run across their meeting: then the bulk of
  // the neighbour says on which side it lies.
  constexpr double kHardly = 0.02;
  if (std::abs(bend) > kHardly) return bend < 0;
  double above = 0;
  for_each_edge(facet_of(twin(e)), [&](EdgeId other) {
    above += dot(world_->planes.normal(mine), at(other)) - world_->planes.offset_m(mine);
  });
  return above > 0;
}

EdgeId Boundary::add_edge(PointId origin) { return half_edges_.push_back({origin}); }

void Boundary::reserve(int half_edges, int facets) {
  half_edges_.reserve(index(half_edges));
  loops_.reserve(index(facets));
  facets_.reserve(index(facets));
  on_side_.reserve(index(facets));
  number_of_side_.reserve(index(facets));
}

BodyFacetId Boundary::add_facet(PlaneSide side, const Sources& sources,
                                std::vector<CapMark> marks) {
  return add_facet_on(number_side(side), side, sources, std::move(marks));
}

int Boundary::number_side(PlaneSide side) {
  const std::size_t place = place_of(side);
  if (place < number_of_side_.size() && number_of_side_[place].first == side)
    return number_of_side_[place].second;
  const int number = static_cast<int>(on_side_.size());
  number_of_side_.insert(number_of_side_.begin() + static_cast<std::ptrdiff_t>(place),
                         {side, number});
  on_side_.emplace_back();
  return number;
}

namespace {

/// For each of a list its id among those that live; invalid for the dead.
template <class IdType, class Item, class IsAlive>
IndexedVector<IdType, IdType> ids_of_living(const IndexedVector<IdType, Item>& items,
                                            IsAlive is_alive) {
  IndexedVector<IdType, IdType> ids(items.size());
  IdType next{0};
  for (const IdType id : items.ids())
    if (is_alive(items[id])) ids[id] = IdType{next.value++};
  return ids;
}

}  // namespace

Boundary Boundary::without_dead() const {
  const auto edges = ids_of_living(half_edges_, [](const auto& e) { return e.next.is_valid(); });
  const auto loops = ids_of_living(loops_, [](const auto& l) { return l.facet.is_valid(); });
  const auto facets = ids_of_living(facets_, [](const auto& f) { return f.side >= 0; });
  Boundary out(*world_);
  out.reserve(half_edge_count() - dead_edges_, facet_count());
  for (const HalfEdgeRecord& e : half_edges_)
    if (e.next.is_valid())
      out.half_edges_.push_back({e.origin, edges[e.next], edges[e.prev], edges[e.twin],
                                 loops[e.loop], facets[e.facet], e.bend});
  for (const LoopRecord& l : loops_)
    if (l.facet.is_valid())
      out.loops_.push_back({edges[l.first], facets[l.facet], l.area, l.is_hole});
  for (const FacetRecord& f : facets_) {
    if (f.side < 0) continue;
    FacetRecord& copy = out.facets_[out.facets_.push_back(f)];
    for (LoopId& l : copy.loops) l = loops[l];
  }
  out.on_side_ = on_side_;
  for (OnSide& on : out.on_side_) {
    auto end = on.facets.begin();
    for (const BodyFacetId f : on.facets)
      if (facets[f].is_valid()) *end++ = facets[f];
    on.facets.erase(end, on.facets.end());
  }
  out.number_of_side_ = number_of_side_;
  return out;
}

BodyFacetId Boundary::add_facet_on(int number, PlaneSide side, const Sources& sources,
                                   std::vector<CapMark> marks) {
  ORIEL_ASSERT(side >= 0 && number == number_side(side));
  const BodyFacetId f = facets_.next_id();
  OnSide& on = on_side_[index(number)];
  on.facets.push_back(f);
  ++on.living;
  FacetRecord& facet = facets_[facets_.emplace_back()];
  facet.side = side;
  facet.sources.assign(sources.begin(), sources.end());
  facet.marks = std::move(marks);
  facet.on_side = number;
  return f;
}

EdgeId Boundary::add_cycle(std::span<const PointId> origins, BodyFacetId f, bool is_backward) {
  ORIEL_ASSERT(!origins.empty());
  const EdgeId first = half_edges_.next_id();
  const LoopId l = loops_.next_id();
  const int step = is_backward ? -1 : 1;
  for (const PointId origin : origins) {
    const int e = half_edge_count();
    half_edges_.push_back({origin, EdgeId{e + step}, EdgeId{e - step}, EdgeId{}, l, f});
  }
  const EdgeId last{half_edge_count() - 1};
  is_backward ? link(first, last) : link(last, first);
  // The sum of attach(), from the first half-edge on along the loop.
  const Vec3 start = world_->points.at(origins[0]);
  Vec3 sum, from;
  for (std::size_t i = 1; i < origins.size(); ++i) {
    const Vec3 to = world_->points.at(origins[is_backward ? origins.size() - i : i]) - start;
    sum = sum + cross(from, to);
    from = to;
  }
  loops_.push_back({first, f});
  join(l, f, dot(sum, world_->planes.normal(facet(f).side)) / 2);
  return first;
}

double Boundary::perimeter(LoopId l) const {
  double sum = 0;
  const EdgeId first = loop(l).first;
  EdgeId e = first;
  do {
    const EdgeId after = next(e);
    sum += length(at(after) - at(e));
    e = after;
  } while (e != first);
  return sum;
}

LoopId Boundary::trace(EdgeId first) {
  ORIEL_ASSERT(is_alive_edge(first));
  const LoopId l = loops_.push_back({first});
  EdgeId e = first;
  do {
    half_edges_[e].loop = l;
    e = next(e);
  } while (e != first);
  return l;
}

void Boundary::attach(LoopId l, BodyFacetId f) {
  LoopRecord& record = loops_[l];
  const Vec3 start = at(record.first);
  Vec3 sum, from;
  half_edges_[record.first].facet = f;
  for (EdgeId e = next(record.first); e != record.first; e = next(e)) {
    half_edges_[e].facet = f;
    const Vec3 to = at(e) - start;
    sum = sum + cross(from, to);
    from = to;
  }
  record.facet = f;
  join(l, f, dot(sum, world_->planes.normal(facet(f).side)) / 2);
}

/// Counts a loop among those of its facet.
void Boundary::join(LoopId l, BodyFacetId f, double area) {
  LoopRecord& record = loops_[l];
  record.area = area;
  // A loop of no width is the outer loop of a sliver: no hole is so thin.
  record.is_hole = record.area < 0 && -record.area > kThin_m * perimeter(l);
  facets_[f].loops.push_back(l);
  if (!record.is_hole) ++facets_[f].outer_loops;
  on_side_of(f).area += record.area;
}

void Boundary::detach(LoopId l) {
  LoopRecord& record = loops_[l];
  on_side_of(record.facet).area -= record.area;
  auto& loops = facets_[record.facet].loops;
  loops.erase(std::ranges::find(loops, l));
  if (!record.is_hole) --facets_[record.facet].outer_loops;
  record.facet = {};
}

LoopId Boundary::add_loop(EdgeId first, BodyFacetId f) {
  const LoopId l = trace(first);
  attach(l, f);
  return l;
}

void Boundary::kill_facet(BodyFacetId f) {
  FacetRecord& record = facets_[f];
  OnSide& on = on_side_of(f);
  for (const LoopId l : record.loops) {
    on.area -= loop(l).area;
    loops_[l].facet = {};
  }
  record.loops.clear();
  record.outer_loops = 0;
  --on.living;
  record.side = -1;
  record.marks.clear();
}

void Boundary::remove(std::span<const BodyFacetId> facets) {
  for (const BodyFacetId f : facets) {
    for (const LoopId l : facet(f).loops)
      for (EdgeId e = loop(l).first; is_alive_edge(e);) {
        const EdgeId after = next(e);
        kill_edge(e);
        e = after;
      }
    kill_facet(f);
  }
}

void Boundary::fill_hole(LoopId hole, double cap_area) {
  // The sum goes the way it goes when the cap is added, merged and freed of its seams, so that it
  // is the same to the last bit; and the cap's half-edges count among the dead.
  ORIEL_ASSERT(loop(hole).is_hole);
  const BodyFacetId f = loop(hole).facet;
  double& area = on_side_of(f).area;
  area += cap_area;
  area -= cap_area;
  area += cap_area;
  detach(hole);
  area -= cap_area;
  std::size_t size = 0;
  for (EdgeId e = loop(hole).first; is_alive_edge(e); ++size) {
    const EdgeId after = next(e);
    kill_edge(e);
    e = after;
  }
  half_edges_.resize(half_edges_.size() + size);
  dead_edges_ += static_cast<int>(size);
  part(f);
}

void Boundary::split_edge(EdgeId e, PointId point) {
  ORIEL_ASSERT(is_alive_edge(e));
  const EdgeId t = twin(e);
  const EdgeId e2 = add_edge(point), t2 = add_edge(point);
  half_edges_[e2].loop = edge(e).loop;
  half_edges_[e2].facet = edge(e).facet;
  half_edges_[t2].loop = edge(t).loop;
  half_edges_[t2].facet = edge(t).facet;
  const EdgeId after_e = next(e), after_t = next(t);
  link(e, e2);
  link(e2, after_e);
  link(t, t2);
  link(t2, after_t);
  pair(e, t2);
  pair(t, e2);
}

std::span<const FlatBody::EdgePoints> FlatBody::edges() {
  if (!edges_.empty()) return edges_;
  edges_.reserve(at(body_.half_edge_count()) / 2);
  for (const EdgeId e : body_.half_edge_ids())
    if (body_.is_alive_edge(e) && e < body_.twin(e))
      edges_.push_back({body_.origin(e), body_.target(e)});
  return edges_;
}

std::span<const FlatBody::RankedFacet> FlatBody::facets() {
  if (!facets_.empty()) return facets_;
  const PlaneTable& planes = body_.world().planes;
  for (const BodyFacetId f : body_.facet_ids()) {
    if (!body_.is_alive(f)) continue;
    const int plane = body_.facet(f).side >> 1;
    facets_.push_back({f, planes.class_of(plane), planes.rank_of(plane)});
  }
  return facets_;
}

}  // namespace oriel::detail
