#include "kernel/segment/cuts/slots.h"

#include "kernel/base/index.h"
#include "kernel/segment/sections/gap.h"
#include "kernel/segment/sections/sweep.h"

#include <algorithm>
#include <utility>

namespace oriel::detail {

namespace {

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
      lively_(2 * planes_.size()),
      chains_(body, planes_, free_side),
      promising_(2 * planes_.size()) {
  slots_.resize(2 * planes_.size());
  to_do_.reserve(slots_.size());
  classes_.reserve(std::min(planes_.size(), at(world_.planes.class_count())));
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    const int k = world_.planes.class_of(planes_[i]);
    if (classes_.empty() || classes_.back().number != k) classes_.push_back({k, i, i});
    ++classes_.back().last;
    for (const std::size_t number : {2 * i, 2 * i + 1}) {
      to_do_.push_back(number);
      slots_[number].entry = i;
      slots_[number].direction = number % 2 == 0 ? 1 : -1;
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
          edges_.edges_at(slots_[i].entry, slots_[i].direction).size();
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
    if (passed[i].in_front_m2) swept(2 * (c.first + i), *passed[i].in_front_m2);
    if (passed[i].behind_m2) swept(2 * (c.first + i) + 1, *passed[i].behind_m2);
  }
}

/// The section is one region of material that is not natural. Nothing can be cut there if it is
/// larger than the old area, whatever coplanar facets cover of it.
void Slots::swept(std::size_t number, double area_m2) {
  if (!slots_[number].is_stale) return;
  const Side side = looking(slots_[number]);
  const auto areas = body_.on_plane(side >> 1).areas;
  const double old = areas[at(side & 1)], covered = areas[at((side & 1) ^ 1)];
  let_rest(number, old > 0 ? area_m2 - kSweptArea_m2 - covered - old : Margins::kNone);
}

/// The section that was made of one end of a gap tells of the other.
void Slots::look_across_gap(std::size_t number) {
  const std::size_t entry = slots_[number].entry;
  const bool is_in_front = fresh_.direction > 0;
  if (is_in_front ? entry + 1 == planes_.size() : entry == 0) return;
  const std::size_t next = is_in_front ? entry + 1 : entry - 1;
  const std::size_t other = 2 * next + (is_in_front ? 1 : 0);
  if (!slots_[other].is_stale ||
      world_.planes.class_of(planes_[next]) != world_.planes.class_of(planes_[entry]) ||
      !body_.on_plane(planes_[next]).has_area())
    return;
  work_ += std::ssize(fresh_.crossings);
  let_rest(other, margin_across_gap(body_, fresh_, planes_[next]));
}

/// Nothing can be cut as long as no more than the margin is lost.
void Slots::let_rest(std::size_t number, double margin_m2) {
  if (margin_m2 <= 0) return;
  Slot& slot = slots_[number];
  margins_.set(number, margin_m2);
  slot.is_to_prune = false;
  clear_regions(slot);  // those that it had before it was touched
  promising_.erase(number);
  slot.is_idle = true;
  slot.unclear_changes = unclear_changes_;
  slot.is_stale = false;
  const Side side = looking(slot);
  const auto areas = body_.on_plane(side >> 1).areas;
  count_tests({areas[at((side & 1) ^ 1)], areas[at(side & 1)]});
}

void Slots::count_tests(const std::array<double, 2>& old_areas) {
  if (old_areas[1] > 0) ++stats_.protrusion_tests;
  if (old_areas[0] > 0) ++stats_.hole_tests;
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
  slot.unclear_changes = unclear_changes_;
  margins_.set(number, is_idle ? least : Margins::kNone);
  is_idle ? lively_.erase(number) : lively_.insert(number);
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
    if (!slot.is_idle && (slot.is_stale || !prune(i))) refresh(i);
    slot.is_stale = slot.is_to_prune = false;
    ++slot.looks;
    slot.has_regions() ? promising_.insert(i) : promising_.erase(i);
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
  put_off_.reserve(put_off_.size() + to_do_.size());
  std::erase_if(to_do_, [&](std::size_t i) {
    Slot& slot = slots_[i];
    if (!slot.is_stale || chains_.may_be_natural(i)) return false;
    clear_regions(slot);
    slot.is_to_prune = false;
    ++slot.looks;
    promising_.erase(i);
    put_off_.push_back(i);
    return true;
  });
}

/// Takes the loops that have gone from a section. False if it is to be made anew.
bool Slots::prune(std::size_t number) {
  Section& section = section_of(slots_[number]);
  work_ += std::ssize(section.crossings);
  if (!prune_section(body_, section, section_options_)) return false;
  if (!judge(number, section)) section.regions.clear();
  return true;
}

void Slots::refresh(std::size_t number) {
  Slot& slot = slots_[number];
  slot.is_idle = false;
  lively_.erase(number);
  clear_regions(slot);
  if (!body_.on_plane(planes_[slot.entry]).has_area()) return;
  const auto edges = edges_.edges_at(slot.entry, slot.direction);
  fresh_.plane = planes_[slot.entry];
  fresh_.direction = slot.direction;
  const bool do_all_cross = section_at(body_, fresh_, edges, section_options_);
  work_ += std::ssize(edges);
  count_tests(fresh_.old_areas);
  for (const Region& region : fresh_.regions)
    if (region.is_candidate && fresh_.old_area(region) > region.new_area) ++stats_.candidates;
  if (do_all_cross) look_across_gap(number);
  if (judge(number, fresh_)) std::swap(section_of(slot), fresh_);
}

/// That a slot keeps, or begins to.
Section& Slots::section_of(Slot& slot) {
  if (slot.section == nullptr)
    slot.section = &sections_.emplace_back(planes_[slot.entry], slot.direction);
  return *slot.section;
}

}  // namespace oriel::detail
