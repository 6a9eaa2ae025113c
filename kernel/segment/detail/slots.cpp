#include "kernel/segment/detail/slots.h"

#include "kernel/model/detail/index.h"
#include "kernel/segment/detail/sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
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

std::vector<int> split_planes_of(const Boundary& body, const std::vector<int>& own_planes) {
  std::vector<int> planes;
  for (const int f : body.living_facets()) planes.push_back(body.facet(f).side >> 1);
  std::ranges::sort(planes);
  planes.erase(std::unique(planes.begin(), planes.end()), planes.end());
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
      chains_(body, planes_, free_side) {
  slots_.reserve(2 * planes_.size());
  for (std::size_t i = 0; i < planes_.size(); ++i)
    for (const int direction : {1, -1}) {
      to_do_.push_back(slots_.size());
      slots_.push_back({i});
      slots_.back().section.plane = planes_[i];
      slots_.back().section.direction = direction;
    }
}

/// Where a class has so many planes to section that this would meet the body's edges many times
/// over, a sweep tells first at which of them there is nothing to cut.
void Slots::sweep_classes() {
  constexpr std::size_t kManyTimes = 2;  // a sweep costs about as much per edge as two sections
  for (std::size_t first = 0; first < planes_.size();) {
    const int k = world_.planes.class_of(planes_[first]);
    std::size_t last = first, met = 0;
    for (; last < planes_.size() && world_.planes.class_of(planes_[last]) == k; ++last)
      for (const std::size_t slot : {2 * last, 2 * last + 1})
        if (slots_[slot].is_stale) met += edges_.edges_at(last).size();
    if (met > kManyTimes * static_cast<std::size_t>(body_.half_edge_count()))
      sweep_class(k, first, last);
    first = last;
  }
  std::erase_if(to_do_, [&](std::size_t i) { return slots_[i].is_idle; });
}

void Slots::sweep_class(int normal_class, std::size_t first, std::size_t last) {
  const std::vector<int> planes(planes_.begin() + static_cast<std::ptrdiff_t>(first),
                                planes_.begin() + static_cast<std::ptrdiff_t>(last));
  const auto passed = sweep(body_, normal_class, planes);
  work_ += 2 * body_.half_edge_count();
  for (std::size_t i = 0; i < planes.size(); ++i) {
    if (passed[i].in_front_m2) let_rest(slots_[2 * (first + i)], *passed[i].in_front_m2);
    if (passed[i].behind_m2) let_rest(slots_[2 * (first + i) + 1], *passed[i].behind_m2);
  }
}

/// The section is one region of material that is not natural. Nothing can be cut there if it is
/// larger than the old area, whatever coplanar facets cover of it.
void Slots::let_rest(Slot& slot, double area_m2) {
  if (!slot.is_stale) return;
  const Side looking = slot.section.looking();
  const double old = body_.area_on(looking), covered = body_.area_on(looking ^ 1);
  const double margin = area_m2 - kSweptArea_m2 - covered - old;
  if (old > 0 && margin <= 0) return;
  slot.margins.fill(std::numeric_limits<double>::infinity());
  if (old > 0) slot.margins[0] = margin;
  slot.is_idle = true;
  slot.is_stale = false;
  count_tests(slot);
}

void Slots::count_tests(const Slot& slot) {
  const Side looking = slot.section.looking();
  if (body_.area_on(looking) > 0) ++stats_.protrusion_tests;
  if (body_.area_on(looking ^ 1) > 0) ++stats_.hole_tests;
}

void Slots::changed(std::vector<Change> changes) {
  edges_.update();
  for (Change& change : changes) {
    change.has_covered ? chains_.forget() : chains_.expect(change.new_edges);
    for (auto* points : {&change.points, &change.part}) {
      std::ranges::sort(*points);
      points->erase(std::unique(points->begin(), points->end()), points->end());
    }
    apply(change);
  }
}

/// Planes are ordered by class and rank, so those that a change reaches are a run in each class.
void Slots::apply(const Change& change) {
  Box part;
  for (const int p : change.part) part.grow(world_.points.at(p));
  const auto place = [&](int plane) {
    return std::pair(world_.planes.class_of(plane), world_.planes.rank_of(plane));
  };
  for (int k = 0; k < world_.planes.class_count(); ++k) {
    const auto rank = world_.points.ranks(k);
    Reach reach{k, std::numeric_limits<int>::max(), -1, std::numeric_limits<int>::max(), -1};
    for (const int p : change.points) {
      reach.low = std::min(reach.low, rank[at(p)]);
      reach.high = std::max(reach.high, rank[at(p)]);
    }
    for (const int p : change.part) {
      reach.part_low = std::min(reach.part_low, rank[at(p)]);
      reach.part_high = std::max(reach.part_high, rank[at(p)]);
    }
    const auto first = std::ranges::lower_bound(planes_, std::pair(k, reach.low), {}, place);
    const auto last = std::ranges::upper_bound(planes_, std::pair(k, reach.high), {}, place);
    for (auto plane = first; plane < last; ++plane)
      for (std::size_t flip = 0; flip < 2; ++flip)
        touch(2 * static_cast<std::size_t>(plane - planes_.begin()) + flip, change, reach, part);
  }
}

void Slots::touch(std::size_t number, const Change& change, const Reach& reach, const Box& part) {
  Slot& slot = slots_[number];
  if (slot.is_stale || (slot.is_idle && stays_idle(slot, change, reach, part))) return;
  if (!slot.is_to_prune) to_do_.push_back(number);
  if (!slot.is_idle && loses_loops_only(slot, change, reach))
    slot.is_to_prune = true;
  else
    slot.is_stale = true;
  slot.is_idle = false;
}

/// The part of a natural cut whose rim stays on one side of the section was met by it in whole
/// loops or not at all: its wall has no other end than the rim.
bool Slots::loses_loops_only(const Slot& slot, const Change& change, const Reach& reach) const {
  if (!change.is_natural || change.rim.empty()) return false;
  const auto ranks = world_.points.ranks(reach.normal_class);
  const int direction = slot.section.direction;
  const int limit = world_.planes.rank_of(slot.section.plane) * direction;
  const bool is_up = ranks[at(change.rim[0].first)] * direction > limit;
  return std::ranges::all_of(change.rim, [&](const std::pair<int, int>& edge) {
    return (ranks[at(edge.first)] * direction > limit) == is_up;
  });
}

/// An idle section stays idle if it loses whole loops only: no region gets smaller then, and no
/// more than the cap is added to the old area. Else it stays idle if the change has no point on its
/// plane and the part either is not met by it, or meets it in one piece that its cap closes with
/// one chord: then one stretch of one loop is replaced by that chord. No loop is made, none becomes
/// natural, and areas change by no more than that of the piece.
bool Slots::stays_idle(Slot& slot, const Change& change, const Reach& reach,
                       const Box& part) const {
  if (change.rim.empty()) return false;
  const int plane = planes_[slot.entry], rank = world_.planes.rank_of(plane);
  const auto ranks = world_.points.ranks(reach.normal_class);
  const double area = most_area(part, world_.planes.plane(plane).normal);
  if (slot.is_fenced && loses_loops_only(slot, change, reach)) {
    if (ranks[at(change.rim[0].first)] == rank)
      for (double& margin : slot.margins) margin -= area;
    return slot.margins[0] > 0 && slot.margins[1] > 0;
  }
  for (const int p : change.points)
    if (ranks[at(p)] == rank) return false;
  if (rank <= reach.part_low || rank >= reach.part_high) return true;
  const auto chords = std::ranges::count_if(change.rim, [&](const std::pair<int, int>& edge) {
    return (ranks[at(edge.first)] < rank) != (ranks[at(edge.second)] < rank);
  });
  if (chords != 2) return false;
  for (double& margin : slot.margins) margin -= area;
  return slot.margins[0] > 0 && slot.margins[1] > 0;
}

/// False if there is nothing to cut: no region is natural or smaller than the old area.
bool Slots::judge(Slot& slot, const Section& section) const {
  slot.margins.fill(std::numeric_limits<double>::infinity());
  bool is_idle = section.crossings.empty() || !section.loops.empty();
  slot.is_fenced = true;
  for (const Region& region : section.regions) {
    const double old = section.old_area(region);
    if (old <= 0) continue;
    slot.is_fenced &= !region.has_natural_outline;
    double& margin = slot.margins[region.is_material ? 0 : 1];
    margin = std::min(margin, region.new_area - old);
    is_idle &= !region.is_natural && margin > 0;
  }
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
    if (slot.is_stale || !prune(slot)) refresh(slot);
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
bool Slots::prune(Slot& slot) {
  work_ += std::ssize(slot.section.crossings);
  if (!prune_section(body_, slot.section, section_options_)) return false;
  slot.is_idle = !judge(slot, slot.section);
  if (slot.is_idle) slot.section.regions.clear();
  return true;
}

void Slots::refresh(Slot& slot) {
  slot.is_idle = false;
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
  slot.is_idle = !judge(slot, fresh_);
  if (!slot.is_idle) std::swap(slot.section, fresh_);
}

}  // namespace oriel::detail
