/// What cuts mean to the sections of a body (docs/segmentation.md, "What is not looked at").
#include "kernel/base/index.h"
#include "kernel/segment/cuts/slots.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>
#include <utility>

namespace oriel::detail {

namespace {

/// No plane with this normal cuts a larger piece out of a box.
double most_area(const Box& box, Vec3 normal) {
  const Vec3 size = box.max - box.min;
  double least = std::numeric_limits<double>::infinity();
  if (normal.x != 0) least = std::min(least, size.y * size.z / std::abs(normal.x));
  if (normal.y != 0) least = std::min(least, size.x * size.z / std::abs(normal.y));
  if (normal.z != 0) least = std::min(least, size.x * size.y / std::abs(normal.z));
  return least;
}

}  // namespace

void Slots::changed(const std::vector<Change>& changes) {
  edges_.update();
  std::vector<Seen> all;
  all.reserve(changes.size());
  for (const Change& change : changes) {
    change.has_covered ? chains_.forget() : chains_.expect(change.new_edges);
    all.push_back(look_at(change));
  }
  for (std::size_t k = 0; k < classes_.size(); ++k) apply(k, all);
  margins_.take_out_spent([&](std::size_t number) { make_stale(number); });
}

Slots::Seen Slots::look_at(const Change& change) const {
  const auto is_exact = [&](int p) { return world_.points.is_meeting(p); };
  Seen seen{&change, {}, change.is_ring && std::ranges::all_of(change.points, is_exact)};
  for (const int p : change.part.empty() ? change.points : change.part)
    seen.part.grow(world_.points.at(p));
  return seen;
}

void Slots::apply(std::size_t k, std::span<const Seen> changes) {
  const Class& c = classes_[k];
  // Of many a class no section was asked for yet.
  const auto slots = std::span(slots_).subspan(2 * c.first, 2 * (c.last - c.first));
  if (std::ranges::all_of(slots, &Slot::is_stale)) return;
  ranks_ = &edges_.ranks_of_class(k);
  find_runs(c, changes);
  const auto is_plain = [](const Run& run) { return run.reach.is_plain(); };
  if (std::ranges::all_of(runs_, is_plain)) merge_runs();
  for (const Run& run : runs_)
    if (!run.is_merged) touch_all(c, run);
}

/// Of equal windows those of a row, or of a column, mean the same to one class: they are looked at
/// together.
void Slots::find_runs(const Class& c, std::span<const Seen> changes) {
  const Vec3 normal = world_.planes.normal_class(c.number).normal;
  const auto rank = world_.points.ranks(c.number);
  std::size_t used = 0;
  Reach other;
  for (std::size_t i = 0; i < changes.size();) {
    const Seen& first = changes[i];
    if (used == room_.size()) room_.emplace_back();
    Run& run = room_[used++];
    run.change = first.change;
    run.is_merged = false;
    run.area = most_area(first.part, normal);
    find_reach(rank, first, run.reach);
    for (++i; i < changes.size() && run.reach.is_plain(); ++i) {
      if (!mean_the_same(rank, first, changes[i])) {
        find_reach(rank, changes[i], other);
        if (other != run.reach) break;
      }
      run.area += most_area(changes[i].part, normal);
    }
  }
  runs_ = std::span(room_).first(used);
}

/// Also of those that do not follow each other, as the windows of a column do not where they are
/// taken row by row. What plain rings mean does not depend on their order.
void Slots::merge_runs() {
  if (runs_.size() < 2) return;
  std::vector<Run*> order;
  order.reserve(runs_.size());
  for (Run& run : runs_) order.push_back(&run);
  std::ranges::stable_sort(order, {}, [](const Run* run) {
    const Reach& r = run->reach;
    return std::tuple(r.low, r.high, r.rim_low, r.rim_high, r.rim_start);
  });
  Run* last = nullptr;
  for (Run* run : order) {
    if (last == nullptr || run->reach != last->reach) {
      last = run;
      continue;
    }
    last->area += run->area;
    run->is_merged = true;
  }
}

/// Two changes have the same reach for certain: all their points, one by one, have the same ranks.
bool Slots::mean_the_same(std::span<const int> rank, const Seen& p, const Seen& q) {
  const Change &one = *p.change, &two = *q.change;
  if (p.is_exact_ring != q.is_exact_ring || one.is_natural != two.is_natural) return false;
  if (!one.part.empty() || !two.part.empty()) return false;
  const auto is_same = [&](int i, int j) { return rank[at(i)] == rank[at(j)]; };
  // Each edge of a rim ends where the next one begins.
  return std::ranges::equal(one.points, two.points, is_same) &&
         std::ranges::equal(one.rim, two.rim, [&](const auto& e, const auto& f) {
           return is_same(e.first, f.first);
         });
}

void Slots::find_reach(std::span<const int> rank, const Seen& seen, Reach& reach) {
  constexpr int kMost = std::numeric_limits<int>::max();
  const Change& change = *seen.change;
  reach.low = reach.rim_low = kMost;
  reach.high = reach.rim_high = reach.rim_start = -1;
  reach.is_natural = change.is_natural;
  reach.is_ring = seen.is_exact_ring;
  reach.is_rim_convex = !change.rim.empty();
  reach.hits.clear();
  int last = -1;
  for (const int p : change.points) {
    const int here = rank[at(p)];
    if (here == last) continue;
    last = here;
    reach.low = std::min(reach.low, here);
    reach.high = std::max(reach.high, here);
    if ((here & 1) != 0 && std::ranges::find(reach.hits, here) == reach.hits.end())
      reach.hits.push_back(here);
  }
  std::ranges::sort(reach.hits);
  reach.part_low = change.part.empty() ? reach.low : kMost;
  reach.part_high = change.part.empty() ? reach.high : -1;
  for (const int p : change.part) {
    reach.part_low = std::min(reach.part_low, rank[at(p)]);
    reach.part_high = std::max(reach.part_high, rank[at(p)]);
  }
  int turns = 0, first_way = 0, last_way = 0;
  for (const auto& [from, to] : change.rim) {
    const int here = rank[at(from)], there = rank[at(to)];
    reach.rim_low = std::min(reach.rim_low, here);
    reach.rim_high = std::max(reach.rim_high, here);
    const int way = (there > here) - (there < here);
    if (way == 0) continue;
    if (first_way == 0) first_way = way;
    if (last_way != 0 && way != last_way) ++turns;
    last_way = way;
  }
  if (first_way != last_way) ++turns;
  reach.is_rim_convex &= turns <= 2;
  if (!change.rim.empty()) reach.rim_start = rank[at(change.rim[0].first)];
}

/// Planes are ordered by class and rank, so those that a change reaches are a run in each class.
void Slots::touch_all(const Class& c, const Run& run) {
  if (!run.reach.is_plain()) ++unclear_changes_;
  if (run.reach.is_rim_convex) return touch_along(c, run);
  for (std::size_t i = first_at(c, run.reach.low); i < first_at(c, run.reach.high + 1); ++i)
    touch_plane(i, run);
}

/// Looks at the planes that points of the change lie on, at those that the part is met by and its
/// rim is not, and at sections that are kept. All others are idle, and stay so with less margin
/// where the rim meets them, or are of no use, and stay so until they get facets.
void Slots::touch_along(const Class& c, const Run& run) {
  const Reach& reach = run.reach;
  std::size_t first = first_at(c, reach.low), last = first_at(c, reach.high + 1);
  if (first == last) return;
  lively_.for_each(2 * first, 2 * last, [&](std::size_t number) { touch(number, run); });
  const auto touch_unhit = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i)
      if (!std::ranges::binary_search(reach.hits, (*ranks_)[i - c.first])) touch_plane(i, run);
  };
  first = first_at(c, reach.part_low + 1);
  last = first_at(c, reach.part_high);
  const std::size_t rim_first = first_at(c, reach.rim_low + 1),
                    rim_last = first_at(c, reach.rim_high);
  touch_unhit(first, std::min(rim_first, last));
  first = std::max(first, rim_first);
  for (const int rank : reach.hits) {
    const std::size_t hit = first_at(c, rank);
    const bool is_plane = hit < c.last && (*ranks_)[hit - c.first] == rank;
    if (rank > reach.rim_low && rank <= reach.rim_high) {
      margins_.take_off(2 * first, 2 * hit, run.area);
      first = is_plane ? hit + 1 : hit;
    }
    if (is_plane) touch_plane(hit, run);
  }
  margins_.take_off(2 * first, 2 * rim_last, run.area);
  touch_unhit(std::max(first, rim_last), last);
}

void Slots::touch_plane(std::size_t entry, const Run& run) {
  touch(2 * entry, run);
  touch(2 * entry + 1, run);
}

void Slots::touch(std::size_t number, const Run& run) {
  Slot& slot = slots_[number];
  if (slot.is_stale || (slot.is_idle && stays_idle(number, run))) return;
  if (slot.is_idle || !loses_loops_only(slot, run.reach)) return make_stale(number);
  if (!slot.is_to_prune) to_do_.push_back(number);
  slot.is_to_prune = true;
}

void Slots::make_stale(std::size_t number) {
  Slot& slot = slots_[number];
  if (!slot.is_to_prune) to_do_.push_back(number);
  slot.is_stale = true;
  slot.is_idle = false;
  margins_.set(number, Margins::kNone);
  lively_.erase(number);
}

/// The part of a natural cut whose rim stays on one side of the section was met by it in whole
/// loops or not at all: its wall has no other end than the rim.
bool Slots::loses_loops_only(const Slot& slot, const Reach& reach) const {
  if (!reach.is_natural || reach.rim_start < 0) return false;
  const int direction = slot.direction;
  const int limit = world_.planes.rank_of(planes_[slot.entry]) * direction;
  return (reach.rim_low * direction > limit) == (reach.rim_high * direction > limit);
}

/// An idle section stays idle if it loses whole loops only: no region gets smaller then, and no
/// more than the cap is added to the old area. Else it stays idle if the change has no point on its
/// plane and the part either is not met by it, or meets it in one piece that its cap closes with
/// one chord: then one stretch of one loop is replaced by that chord. No loop is made, none becomes
/// natural, and areas change by no more than that of the piece.
bool Slots::stays_idle(std::size_t number, const Run& run) {
  const Change& change = *run.change;
  if (change.rim.empty()) return false;
  const Reach& reach = run.reach;
  const Slot& slot = slots_[number];
  const int plane = planes_[slot.entry], rank = world_.planes.rank_of(plane);
  if (slot.is_fenced && loses_loops_only(slot, reach)) {
    if (reach.rim_start == rank) margins_.take_off(number, number + 1, run.area);
    return true;
  }
  if (std::ranges::binary_search(reach.hits, rank)) return stays_idle_beside(number, run);
  if (rank <= reach.part_low || rank >= reach.part_high) return true;
  const auto ranks = world_.points.ranks(world_.planes.class_of(plane));
  const auto chords = std::ranges::count_if(change.rim, [&](const std::pair<int, int>& edge) {
    return (ranks[at(edge.first)] < rank) != (ranks[at(edge.second)] < rank);
  });
  if (chords != 2) return false;
  margins_.take_off(number, number + 1, run.area);
  return true;
}

/// The same where points of the change lie on the plane. If the rim was a hole of one facet its
/// edges in the plane are gone, so no chord follows them; and points on the plane are on the other
/// side for the section, so it has met the part not at all, in whole loops, or in one piece. What
/// the part had in the plane is taken off the old area, or off what covers the new one.
bool Slots::stays_idle_beside(std::size_t number, const Run& run) {
  const Reach& reach = run.reach;
  const Slot& slot = slots_[number];
  if (slot.unclear_changes != unclear_changes_ || !reach.is_plain()) return false;
  const int rank = world_.planes.rank_of(planes_[slot.entry]), direction = slot.direction;
  const auto is_up = [&](int other) { return other * direction > rank * direction; };
  const bool is_met = is_up(reach.part_low) || is_up(reach.part_high);
  if (is_met && is_up(reach.rim_low) == is_up(reach.rim_high)) return false;
  if (is_met || (reach.rim_low == rank && reach.rim_high == rank))
    margins_.take_off(number, number + 1, run.area);
  return true;
}

}  // namespace oriel::detail
