#include "kernel/segment/boundary/boundary.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oriel::detail {

double Boundary::area(int f) const {
  double sum = 0;
  for (const int l : facet(f).loops) sum += loop(l).area;
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

std::vector<int> Boundary::facets_on(PlaneSide side) const {
  std::vector<int> living;
  if (const OnSide* on = on_side(side))
    for (const int f : on->facets)
      if (is_alive(f)) living.push_back(f);
  return living;
}

std::vector<int> Boundary::living_facets() const {
  std::vector<int> living;
  for (int f = 0; f < facet_count(); ++f)
    if (is_alive(f)) living.push_back(f);
  return living;
}

Outline Boundary::outline(int l) const {
  Outline points;
  const int first = loop(l).first;
  int e = first;
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

std::vector<Outline> Boundary::outlines(int f) const {
  std::vector<Outline> all;
  all.reserve(facet(f).loops.size());
  for (const int l : facet(f).loops) all.push_back(outline(l));
  return all;
}

double Boundary::volume() const {
  double sum = 0;
  for (int f = 0; f < facet_count(); ++f)
    if (is_alive(f)) sum += world_->planes.offset_m(facet(f).side) * area(f);
  return sum / 3;
}

bool Boundary::bends_inward(int e) const {
  const PlaneSide mine = side_of_edge(e), theirs = side_of_edge(twin(e));
  if (mine >> 1 == theirs >> 1) return false;
  const Vec3 along = normalised(world_->points.at(target(e)) - at(e));
  const double bend = dot(cross(world_->planes.normal(mine), world_->planes.normal(theirs)), along);
  // The edge between two planes that hardly differ may run across their meeting: then the bulk of
  // the neighbour says on which side it lies.
  constexpr double kHardly = 0.02;
  if (std::abs(bend) > kHardly) return bend < 0;
  double above = 0;
  for_each_edge(facet_of(twin(e)), [&](int other) {
    above += dot(world_->planes.normal(mine), at(other)) - world_->planes.offset_m(mine);
  });
  return above > 0;
}

int Boundary::add_edge(int origin) {
  half_edges_.push_back({origin});
  return half_edge_count() - 1;
}

void Boundary::reserve(int half_edges, int facets) {
  half_edges_.reserve(index(half_edges));
  loops_.reserve(index(facets));
  facets_.reserve(index(facets));
  on_side_.reserve(index(facets));
  number_of_side_.reserve(index(facets));
}

int Boundary::add_facet(PlaneSide side, const Sources& sources, std::vector<CapMark> marks) {
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

int Boundary::add_facet_on(int number, PlaneSide side, const Sources& sources,
                           std::vector<CapMark> marks) {
  const int f = facet_count();
  OnSide& on = on_side_[index(number)];
  on.facets.push_back(f);
  ++on.living;
  FacetRecord& facet = facets_.emplace_back();
  facet.side = side;
  facet.sources.assign(sources.begin(), sources.end());
  facet.marks = std::move(marks);
  facet.on_side = number;
  return f;
}

int Boundary::add_cycle(std::span<const int> origins, int f, bool is_backward) {
  const int first = half_edge_count(), last = first + static_cast<int>(origins.size()) - 1;
  const int l = static_cast<int>(loops_.size());
  const int step = is_backward ? -1 : 1;
  for (int e = first; const int origin : origins) {
    half_edges_.push_back({origin, e + step, e - step, -1, l, f});
    ++e;
  }
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

double Boundary::perimeter(int l) const {
  double sum = 0;
  const int first = loop(l).first;
  int e = first;
  do {
    const int after = next(e);
    sum += length(at(after) - at(e));
    e = after;
  } while (e != first);
  return sum;
}

int Boundary::trace(int first) {
  const int l = static_cast<int>(loops_.size());
  loops_.push_back({first, -1, 0});
  int e = first;
  do {
    half_edges_[index(e)].loop = l;
    e = next(e);
  } while (e != first);
  return l;
}

void Boundary::attach(int l, int f) {
  LoopRecord& record = loops_[index(l)];
  const Vec3 start = at(record.first);
  Vec3 sum, from;
  half_edges_[index(record.first)].facet = f;
  for (int e = next(record.first); e != record.first; e = next(e)) {
    half_edges_[index(e)].facet = f;
    const Vec3 to = at(e) - start;
    sum = sum + cross(from, to);
    from = to;
  }
  record.facet = f;
  join(l, f, dot(sum, world_->planes.normal(facet(f).side)) / 2);
}

/// Counts a loop among those of its facet.
void Boundary::join(int l, int f, double area) {
  LoopRecord& record = loops_[index(l)];
  record.area = area;
  // A loop of no width is the outer loop of a sliver: no hole is so thin.
  record.is_hole = record.area < 0 && -record.area > kThin_m * perimeter(l);
  facets_[index(f)].loops.push_back(l);
  if (!record.is_hole) ++facets_[index(f)].outer_loops;
  on_side_of(f).area += record.area;
}

void Boundary::detach(int l) {
  LoopRecord& record = loops_[index(l)];
  on_side_of(record.facet).area -= record.area;
  auto& loops = facets_[index(record.facet)].loops;
  loops.erase(std::ranges::find(loops, l));
  if (!record.is_hole) --facets_[index(record.facet)].outer_loops;
  record.facet = -1;
}

int Boundary::add_loop(int first, int f) {
  const int l = trace(first);
  attach(l, f);
  return l;
}

void Boundary::kill_facet(int f) {
  FacetRecord& record = facets_[index(f)];
  OnSide& on = on_side_of(f);
  for (const int l : record.loops) {
    on.area -= loop(l).area;
    loops_[index(l)].facet = -1;
  }
  record.loops.clear();
  record.outer_loops = 0;
  --on.living;
  record.side = -1;
  record.marks.clear();
}

void Boundary::remove(const std::vector<int>& facets) {
  for (const int f : facets) {
    for (const int l : facet(f).loops)
      for (int e = loop(l).first; is_alive_edge(e);) {
        const int after = next(e);
        kill_edge(e);
        e = after;
      }
    kill_facet(f);
  }
}

void Boundary::fill_hole(int hole, double cap_area) {
  // The sum goes the way it goes when the cap is added, merged and freed of its seams, so that it
  // is the same to the last bit; and the cap's half-edges count among the dead.
  const int f = loop(hole).facet;
  double& area = on_side_of(f).area;
  area += cap_area;
  area -= cap_area;
  area += cap_area;
  detach(hole);
  area -= cap_area;
  std::size_t size = 0;
  for (int e = loop(hole).first; is_alive_edge(e); ++size) {
    const int after = next(e);
    kill_edge(e);
    e = after;
  }
  half_edges_.resize(half_edges_.size() + size);
  dead_edges_ += static_cast<int>(size);
  part(f);
}

void Boundary::split_edge(int e, int point) {
  const int t = twin(e);
  const int e2 = add_edge(point), t2 = add_edge(point);
  half_edges_[index(e2)].loop = edge(e).loop;
  half_edges_[index(e2)].facet = edge(e).facet;
  half_edges_[index(t2)].loop = edge(t).loop;
  half_edges_[index(t2)].facet = edge(t).facet;
  const int after_e = next(e), after_t = next(t);
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
  for (int e = 0; e < body_.half_edge_count(); ++e)
    if (body_.is_alive_edge(e) && e < body_.twin(e))
      edges_.push_back({body_.origin(e), body_.target(e)});
  return edges_;
}

std::span<const FlatBody::RankedFacet> FlatBody::facets() {
  if (!facets_.empty()) return facets_;
  const PlaneTable& planes = body_.world().planes;
  for (int f = 0; f < body_.facet_count(); ++f) {
    if (!body_.is_alive(f)) continue;
    const int plane = body_.facet(f).side >> 1;
    facets_.push_back({f, planes.class_of(plane), planes.rank_of(plane)});
  }
  return facets_;
}

}  // namespace oriel::detail
