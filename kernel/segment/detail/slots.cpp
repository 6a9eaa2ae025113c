#include "kernel/segment/detail/slots.h"

#include "kernel/model/detail/index.h"
#include "kernel/segment/detail/sweep.h"

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

/// Ascending.
std::vector<int> split_planes_of(const Boundary& body, const std::vector<int>& own_planes) {
  std::vector<int> planes;
  for (const Side side : body.sides())
    if (planes.empty() || planes.back() != side >> 1) planes.push_back(side >> 1);
  std::erase_if(
      planes, [&](int plane) { return std::ranges::find(own_planes, plane) != own_planes.end(); });
  return planes;
}

}  // namespace

Slots::Slots(const Boundary& body, const SegmentOptions& options, Side free_side,
             const std::vector<int>& own_planes, SegmentationStats& stats, std::int64_t& work)
    : body_(body),
      world_(body.world()),
      section_options_{free_side, options.tolerances.weld_m},
      stats_(stats),
      work_(work),
      planes_(split_planes_of(body, own_planes)),
      edges_(body, planes_),
      margins_(2 * planes_.size()),
      chains_(body, planes_, free_side) {
  slots_.reserve(2 * planes_.size());
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    const int k = world_.planes.class_of(planes_[i]);
    if (classes_.empty() || classes_.back().number != k) classes_.push_back({k, i, i, {}});
    ++classes_.back().last;
    classes_.back().ranks.push_back(world_.planes.rank_of(planes_[i]));
    for (const int direction : {1, -1}) {
      to_do_.push_back(slots_.size());
      slots_.push_back({i});
      slots_.back().section.plane = planes_[i];
      slots_.back().section.direction = direction;
    }
  }
}

/// Where a class has so many planes to section that this would meet the body's edges many times
/// over, a sweep tells first at which of them there is nothing to cut.
void Slots::sweep_classes() {
  constexpr std::size_t kManyTimes = 2;  // a sweep costs about as much per edge as two sections
  std::vector<std::size_t> met(at(world_.planes.class_count()), 0);
  for (const std::size_t i : to_do_)
    if (slots_[i].is_stale)
      met[at(world_.planes.class_of(planes_[slots_[i].entry]))] +=
          edges_.edges_at(slots_[i].entry).size();
  for (const Class& c : classes_)
    if (met[at(c.number)] > kManyTimes * at(body_.half_edge_count())) sweep_class(c);
  std::erase_if(to_do_, [&](std::size_t i) { return slots_[i].is_idle; });
}

void Slots::sweep_class(const Class& c) {
  const std::vector<int> planes(planes_.begin() + static_cast<std::ptrdiff_t>(c.first),
                                planes_.begin() + static_cast<std::ptrdiff_t>(c.last));
  const auto passed = sweep(body_, c.number, planes);
  work_ += 2 * body_.half_edge_count();
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (passed[i].in_front_m2) let_rest(2 * (c.first + i), *passed[i].in_front_m2);
    if (passed[i].behind_m2) let_rest(2 * (c.first + i) + 1, *passed[i].behind_m2);
  }
}

/// The section is one region of material that is not natural. Nothing can be cut there if it is
/// larger than the old area, whatever coplanar facets cover of it.
void Slots::let_rest(std::size_t number, double area_m2) {
  Slot& slot = slots_[number];
  if (!slot.is_stale) return;
  const Side looking = slot.section.looking();
  const double old = body_.area_on(looking), covered = body_.area_on(looking ^ 1);
  const double margin = area_m2 - kSweptArea_m2 - covered - old;
  if (old > 0 && margin <= 0) return;
  margins_.set(number, old > 0 ? margin : Margins::kNone);
  slot.is_idle = true;
  slot.is_clear = true;
  slot.is_stale = false;
  count_tests(slot);
}

void Slots::count_tests(const Slot& slot) {
  const Side looking = slot.section.looking();
  if (body_.area_on(looking) > 0) ++stats_.protrusion_tests;
  if (body_.area_on(looking ^ 1) > 0) ++stats_.hole_tests;
}

void Slots::changed(const std::vector<Change>& changes) {
  edges_.update();
  std::vector<Seen> all;
  all.reserve(changes.size());
  for (const Change& change : changes) {
    change.has_covered ? chains_.forget() : chains_.expect(change.new_edges);
    all.push_back(look_at(change));
  }
  for (const Class& c : classes_) apply(c, all);
  margins_.take_out_spent([&](std::size_t number) { make_stale(number); });
}

Slots::Seen Slots::look_at(const Change& change) const {
  const auto is_exact = [&](int p) { return world_.points.is_meeting(p); };
  Seen seen{&change, {}, change.is_ring && std::ranges::all_of(change.points, is_exact)};
  for (const int p : change.part.empty() ? change.points : change.part)
    seen.part.grow(world_.points.at(p));
  return seen;
}

void Slots::apply(const Class& c, std::span<const Seen> changes) {
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
  return std::ranges::equal(one.points, two.points, is_same) &&
         std::ranges::equal(one.rim, two.rim, [&](const auto& e, const auto& f) {
           return is_same(e.first, f.first) && is_same(e.second, f.second);
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
  if (!run.reach.is_plain())
    for (Slot& slot : slots_) slot.is_clear = false;
  if (run.reach.is_rim_convex) return touch_along(c, run);
  for (std::size_t i = c.from(run.reach.low); i < c.from(run.reach.high + 1); ++i)
    touch_plane(i, run);
}

/// Looks at the planes that points of the change lie on, at those that the part is met by and its
/// rim is not, and at sections that are kept. All others are idle, and stay so with less margin
/// where the rim meets them, or are of no use, and stay so until they get facets.
void Slots::touch_along(const Class& c, const Run& run) {
  const Reach& reach = run.reach;
  std::size_t first = c.from(reach.low), last = c.from(reach.high + 1);
  if (first == last) return;
  for (auto i = lively_.lower_bound(2 * first); i != lively_.end() && *i < 2 * last;)
    touch(*i++, run);
  const auto touch_unhit = [&](std::size_t from, std::size_t to) {
    for (std::size_t i = from; i < to; ++i)
      if (!std::ranges::binary_search(reach.hits, c.ranks[i - c.first])) touch_plane(i, run);
  };
  first = c.from(reach.part_low + 1);
  last = c.from(reach.part_high);
  const std::size_t rim_first = c.from(reach.rim_low + 1), rim_last = c.from(reach.rim_high);
  touch_unhit(first, std::min(rim_first, last));
  first = std::max(first, rim_first);
  for (const int rank : reach.hits) {
    const std::size_t hit = c.from(rank);
    const bool is_plane = hit < c.last && c.ranks[hit - c.first] == rank;
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
  const int direction = slot.section.direction;
  const int limit = world_.planes.rank_of(slot.section.plane) * direction;
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
  if (!slot.is_clear || !reach.is_plain()) return false;
  const int rank = world_.planes.rank_of(planes_[slot.entry]), direction = slot.section.direction;
  const auto is_up = [&](int other) { return other * direction > rank * direction; };
  const bool is_met = is_up(reach.part_low) || is_up(reach.part_high);
  if (is_met && is_up(reach.rim_low) == is_up(reach.rim_high)) return false;
  if (is_met || (reach.rim_low == rank && reach.rim_high == rank))
    margins_.take_off(number, number + 1, run.area);
  return true;
}

/// False if there is nothing to cut: no region is natural or smaller than the old area.
bool Slots::judge(std::size_t number, const Section& section) {
  Slot& slot = slots_[number];
  double least = Margins::kNone;
  bool is_idle = section.crossings.empty() || !section.loops.empty();
  slot.is_fenced = true;
  for (const Region& region : section.regions) {
    const double old = section.old_area(region);
    if (old <= 0) continue;
    slot.is_fenced &= !region.has_natural_outline;
    least = std::min(least, region.new_area - old);
    is_idle &= !region.is_natural && least > 0;
  }
  slot.is_idle = is_idle;
  slot.is_clear = true;
  margins_.set(number, is_idle ? least : Margins::kNone);
  if (is_idle)
    lively_.erase(number);
  else
    lively_.insert(number);
  return !is_idle;
}

void Slots::refresh(bool natural_only) {
  if (natural_only) {
    find_natural();
    put_off();
  } else {
    to_do_.insert(to_do_.end(), put_off_.begin(), put_off_.end());
    put_off_.clear();
    constexpr std::size_t kFew = 16;  // slots that no sweep is worth while for
    if (to_do_.size() > kFew) sweep_classes();
  }
  for (const std::size_t i : to_do_) {
    Slot& slot = slots_[i];
    if (slot.is_stale || !prune(i)) refresh(i);
    slot.is_stale = slot.is_to_prune = false;
    if (slot.section.regions.empty())
      promising_.erase(i);
    else
      promising_.insert(i);
  }
  to_do_.clear();
}

void Slots::find_natural() {
  if (!chains_.refresh()) return;
  work_ += body_.half_edge_count();
  std::erase_if(put_off_, [&](std::size_t i) {
    if (chains_.may_be_natural(i)) to_do_.push_back(i);
    return chains_.may_be_natural(i);
  });
}

void Slots::put_off() {
  std::erase_if(to_do_, [&](std::size_t i) {
    Slot& slot = slots_[i];
    if (!slot.is_stale || chains_.may_be_natural(i)) return false;
    slot.section.regions.clear();
    slot.is_to_prune = false;
    promising_.erase(i);
    put_off_.push_back(i);
    return true;
  });
}

/// Takes the loops that have gone from a section. False if it is to be made anew.
bool Slots::prune(std::size_t number) {
  Slot& slot = slots_[number];
  work_ += std::ssize(slot.section.crossings);
  if (!prune_section(body_, slot.section, section_options_)) return false;
  if (!judge(number, slot.section)) slot.section.regions.clear();
  return true;
}

void Slots::refresh(std::size_t number) {
  Slot& slot = slots_[number];
  slot.is_idle = false;
  lively_.erase(number);
  slot.section.regions.clear();
  const Side looking = slot.section.looking();
  if (body_.area_on(looking) <= 0 && body_.area_on(looking ^ 1) <= 0) return;
  const auto edges = edges_.edges_at(slot.entry);
  fresh_.plane = slot.section.plane;
  fresh_.direction = slot.section.direction;
  section_at(body_, fresh_, edges, section_options_);
  work_ += std::ssize(edges);
  count_tests(slot);
  for (const Region& region : fresh_.regions)
    if (region.is_candidate && fresh_.old_area(region) > region.new_area) ++stats_.candidates;
  if (judge(number, fresh_)) std::swap(slot.section, fresh_);
}

}  // namespace oriel::detail
