#include "kernel/segment/sections/natural_chains.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <tuple>
#include <utility>

namespace oriel::detail {

NaturalChains::NaturalChains(const Boundary& body, std::span<const int> planes, PlaneSide free_side,
                             bool are_necks_free)
    : body_(body),
      world_(body.world()),
      planes_(planes),
      free_side_(free_side),
      are_necks_free_(are_necks_free),
      answers_(2 * planes.size(), 0),
      entries_(at(world_.planes.size()), -1) {
  for (std::size_t i = 0; i < planes.size(); ++i) {
    entries_[at(planes[i])] = static_cast<int>(i);
    const int k = world_.planes.class_of(planes[i]);
    if (classes_.empty() || classes_.back().number != k) classes_.push_back({k, i, i});
    ++classes_.back().last;
  }
}

void NaturalChains::expect(std::span<const std::pair<PointId, PointId>> new_edges) {
  for (ChainsOfClass& c : classes_)
    for (std::size_t i = 0; c.is_known && i < new_edges.size(); ++i) {
      const int rank = world_.points.rank(new_edges[i].first, c.number);
      c.is_known = (rank & 1) == 0 || world_.points.rank(new_edges[i].second, c.number) != rank;
    }
  if (!are_necks_free_) return;
  for (const auto& [from, to] : new_edges) grown_.insert(grown_.end(), {from, to});
}

void NaturalChains::forget() {
  for (ChainsOfClass& c : classes_) c.is_known = false;
}

void NaturalChains::refresh() {
  const auto are_all_known = [&] {
    return std::ranges::all_of(classes_, &ChainsOfClass::is_known);
  };
  if (grown_.empty() && are_all_known()) return;
  find_living_edges();
  forget_grown();
  if (are_all_known()) return;
  world_.work.add(body_.half_edge_count());
  if (free_side_ >= 0) {
    free_ranks_ = world_.points.ranks(world_.planes.class_of(free_side_ >> 1));
    free_rank_ = world_.planes.rank_of(free_side_ >> 1);
  }
  for (ChainsOfClass& c : classes_) {
    if (world_.work.is_used_up()) return;
    if (!std::exchange(c.is_known, true)) look(c);
  }
}

void NaturalChains::find_living_edges() {
  edges_.clear();
  edges_.reserve(at(body_.half_edge_count() - body_.dead_edge_count()) / 2);
  for (const EdgeId e : body_.half_edge_ids()) {
    const EdgeId twin = body_.twin(e);
    if (!body_.is_alive_edge(e) || e > twin) continue;
    edges_.push_back({e, twin, body_.origin(e), body_.origin(twin), body_.side_of_edge(e) >> 1,
                      body_.side_of_edge(twin) >> 1});
  }
}

/// A facet that has grown at the end of an edge may turn another way there, and the edge be a
/// shoulder.
void NaturalChains::forget_grown() {
  if (grown_.empty()) return;
  auto& is_grown = world_.scratch.neck_points;
  is_grown.start(world_.points.size());
  for (const PointId point : grown_) is_grown.insert(point);
  grown_.clear();
  std::vector<std::pair<PointId, PointId>> edges;
  for (const LivingEdge& edge : edges_)
    if (is_grown.contains(edge.from) || is_grown.contains(edge.to))
      edges.emplace_back(edge.from, edge.to);
  for (ChainsOfClass& c : classes_)
    for (std::size_t i = 0; c.is_known && i < edges.size(); ++i) {
      const int rank = world_.points.rank(edges[i].first, c.number);
      c.is_known = (rank & 1) == 0 || world_.points.rank(edges[i].second, c.number) != rank;
    }
}

/// A step on the side from which the facet's outline comes to the plane that `e` lies in, runs in
/// it along `e` and goes back; none if it goes through the plane or lies in it.
[[gnu::always_inline]] inline void NaturalChains::add_step(int entry, PointRanks ranks, EdgeId e,
                                                           PointId from, PointId to) {
  const int rank = ranks[from];
  const auto& half = body_.edge(e);
  const EdgeId last = half.prev, second = body_.next(half.next);
  int rank_before = ranks[body_.origin(last)], rank_after = ranks[body_.origin(second)];
  if (rank_before == rank || rank_after == rank)
    std::tie(rank_before, rank_after) = ranks_around(ranks, e, rank);
  const bool is_up = rank_before > rank;
  if (rank_before == rank) return;
  if (is_up != (rank_after > rank)) {
    if (are_necks_free_)
      shoulders_.push_back({entry, body_.facet(half.facet).side, is_up ? -1 : 1, from, to});
    return;
  }
  // The outlines of triangles and quadrangles surround what they run around, holes do not.
  const bool may_hang =
      (second != last && body_.next(second) != last) || body_.loop(half.loop).is_hole;
  if (may_hang) {
    const bool is_known = world_.points.is_meeting(from) && world_.points.is_meeting(to);
    const bool hangs = is_known && hangs_below(e, from, to, is_up);
    if (are_necks_free_ && (hangs || !is_known))
      shoulders_.push_back({entry, body_.facet(half.facet).side, 0, from, to});
    if (hangs) return;
  }
  steps_.push_back({2 * entry + (is_up ? 0 : 1), from, to});
}

/// The ranks of the last point before the half-edge `e` and the first one behind it that have
/// another rank than those of `e`; the same rank if there is none.
std::pair<int, int> NaturalChains::ranks_around(PointRanks ranks, EdgeId e, int rank) const {
  const auto rank_at = [&](EdgeId half) { return ranks[body_.origin(half)]; };
  EdgeId before = body_.prev(e), after = body_.next(body_.next(e));
  while (before != e && rank_at(before) == rank) before = body_.prev(before);
  if (before == e) return {rank, rank};
  while (rank_at(after) == rank) after = body_.next(after);
  return {rank_at(before), rank_at(after)};
}

void NaturalChains::look(const ChainsOfClass& c) {
  world_.work.add_flat(std::ssize(edges_));
  const auto ranks = world_.points.ranks(c.number);
  const auto& [normal, planes, offsets] = world_.planes.normal_class(c.number);
  normal_ = normal;
  steps_.clear();
  shoulders_.clear();
  Scratch& scratch = world_.scratch;
  if (scratch.leaving.size() < ranks.size()) {
    scratch.leaving.resize(ranks.size(), 0);
    scratch.entering.resize(ranks.size(), 0);
  }
  for (const LivingEdge& edge : edges_) {
    const int rank = ranks[edge.from];
    if ((rank & 1) == 0 || ranks[edge.to] != rank) continue;
    // Mostly one of the facets lies in the plane and the other one does not.
    const int plane = planes[at(rank / 2)];
    if (edge.plane == plane && edge.twin_plane == plane) continue;
    const int entry = entries_[at(plane)];
    if (entry < 0) continue;
    if (edge.plane != plane) add_step(entry, ranks, edge.half, edge.from, edge.to);
    if (edge.twin_plane != plane) add_step(entry, ranks, edge.twin, edge.to, edge.from);
  }
  sort_steps(c);
  find_necks();
  for (std::size_t slot = 2 * c.first; slot < 2 * c.last; ++slot) {
    const int first = ends_[slot - 2 * c.first], last = ends_[slot - 2 * c.first + 1];
    const auto steps = std::span(sorted_).subspan(at(first), at(last - first));
    if (slot % 2 == 0) free_necks(static_cast<int>(slot / 2));
    answers_[slot] = !steps.empty() && has_chain(steps, slot) ? 1 : 0;
  }
}

/// Puts the steps of each slot together, in their order: those of the i-th slot of the class stand
/// from ends_[i] up to ends_[i + 1].
void NaturalChains::sort_steps(const ChainsOfClass& c) {
  const std::size_t slots = 2 * (c.last - c.first);
  ends_.assign(slots + 2, 0);
  // A place on, as each end moves from the first of its steps to the last.
  int* const ends = ends_.data() - 2 * c.first + 1;
  for (const ChainStep& step : steps_) ++ends[step.slot + 1];
  for (std::size_t i = 2; i < ends_.size(); ++i) ends_[i] += ends_[i - 1];
  sorted_.resize(steps_.size());
  for (const ChainStep& step : steps_) sorted_[at(ends[step.slot]++)] = step;
}

/// A facet may have a neck between two of its shoulders, but not where its outline leads up, or
/// down, at all of them. Facets of one side are taken together: they may grow into one.
void NaturalChains::find_necks() {
  necks_.clear();
  std::ranges::sort(shoulders_);
  const auto place = [](const NeckShoulder& one) { return std::pair(one.entry, one.side); };
  for (auto first = shoulders_.begin(); first != shoulders_.end();) {
    const auto last = std::find_if(first, shoulders_.end(), [&](const NeckShoulder& one) {
      return place(one) != place(*first);
    });
    // Those that lead down stand before those that lead up.
    if (last - first > 1 && (first->turn != (last - 1)->turn || first->turn == 0))
      for (auto one = first; one != last; ++one) {
        necks_.emplace_back(one->entry, one->from);
        necks_.emplace_back(one->entry, one->to);
      }
    first = last;
  }
}

/// Makes the corners at necks in a plane free. The planes of a class are asked for in their order.
void NaturalChains::free_necks(int entry) {
  const auto [first, last] =
      std::ranges::equal_range(necks_, entry, {}, &std::pair<int, PointId>::first);
  has_necks_here_ = first != last;
  if (!has_necks_here_) return;
  world_.scratch.neck_points.start(world_.points.size());
  for (auto neck = first; neck != last; ++neck) world_.scratch.neck_points.insert(neck->second);
}

/// The facet surrounds the run from the other side, as a wall does the sill of a hole in it. To be
/// asked only of edges between points where their planes meet.
bool NaturalChains::hangs_below(EdgeId e, PointId from, PointId to, bool is_up) const {
  const Vec3 up = is_up ? normal_ : -normal_;
  const Vec3 along = world_.points.at(to) - world_.points.at(from);
  const double inward = dot(cross(world_.planes.normal(body_.side_of_edge(e)), along), up);
  constexpr double kFlat = 1e-9;  // tolerance of doubles
  return inward < 0 && inward < -kFlat * length(along);
}

/// Takes away what comes from nowhere or leads to nowhere, again and again, and tells whether
/// something is left. Gives up after some rounds: then there may be a chain.
bool NaturalChains::has_chain(std::span<ChainStep> steps, std::size_t slot) {
  IndexedVector<PointId, int>&leaving = world_.scratch.leaving, &entering = world_.scratch.entering;
  for (const ChainStep& step : steps) {
    ++leaving[step.from];
    ++entering[step.to];
  }
  const auto is_loose = [&](const ChainStep& step) {
    const bool is = (entering[step.from] == 0 && !is_free(step.from)) ||
                    (leaving[step.to] == 0 && !is_free(step.to));
    if (is) {
      --leaving[step.from];
      --entering[step.to];
    }
    return is;
  };
  std::size_t left = steps.size();
  constexpr int kRounds = 16;
  for (int round = 0; round < kRounds; ++round) {
    const auto kept =
        std::remove_if(steps.begin(), steps.begin() + static_cast<std::ptrdiff_t>(left), is_loose);
    const auto now = static_cast<std::size_t>(kept - steps.begin());
    if (now == left) break;
    left = now;
  }
  const bool has = left > 0 && may_bound(steps.first(left), slot);
  for (const ChainStep& step : steps.first(left)) leaving[step.from] = entering[step.to] = 0;
  return has;
}

/// Whether one of the chains may be the outline of a region that can be cut: that runs
/// counter-clockwise around material, for which the body has facets on the looked-at side, and
/// clockwise around air, for which it has some on the other one. Told only of closed chains that do
/// not touch.
bool NaturalChains::may_bound(std::span<const ChainStep> steps, std::size_t slot) {
  const PlaneSide looking = 2 * planes_[slot / 2] + static_cast<int>(slot & 1);
  const auto has_facets = body_.on_plane(looking >> 1).has_facets;
  const bool has_material = has_facets[at(looking & 1)], has_air = has_facets[at(~looking & 1)];
  if (has_material && has_air) return true;
  Scratch& scratch = world_.scratch;
  for (const ChainStep& step : steps)
    if (scratch.leaving[step.to] != 1 || scratch.entering[step.from] != 1 ||
        scratch.leaving[step.from] != 1 || is_free(step.from))
      return true;
  auto& after = scratch.after;
  if (after.size() < scratch.leaving.size()) after.resize(scratch.leaving.size());
  for (const ChainStep& step : steps) after[step.from] = step.to;
  const Vec3 normal = world_.planes.normal(looking);
  constexpr PointId kDone;
  return std::ranges::any_of(steps, [&](const ChainStep& start) {
    if (after[start.from] == kDone) return false;
    const Vec3 origin = world_.points.at(start.from);
    Vec3 sum, from;
    for (PointId p = start.from; after[p] != kDone;) {
      p = std::exchange(after[p], kDone);
      const Vec3 to = world_.points.at(p) - origin;
      sum = sum + cross(from, to);
      from = to;
    }
    constexpr double kHardly_m2 = 1e-6;  // what has less area may turn either way by rounding
    const double doubled = dot(sum, normal);
    return has_material ? doubled > -kHardly_m2 : has_air && doubled < kHardly_m2;
  });
}

}  // namespace oriel::detail
