#include "kernel/segment/detail/choice.h"

#include "kernel/segment/detail/sweep.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

namespace oriel::detail {

namespace {

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// Values closer than this are the same number computed twice.
constexpr double kSame = 1e-9;  // tolerance of doubles, no tolerance of the model

bool is_same_value(double p, double q) { return std::abs(p - q) <= kSame * std::max(p, q); }

// The keys by which the passes of the orders sort one-plane candidates; nothing: not a candidate of
// the pass.

/// N1: natural pockets by new / (old + new), which is always below 1, natural protrusions by new /
/// old below 1.
std::optional<double> natural_key(const Region& region, double new_area, double old_area,
                                  double limit) {
  if (!region.is_natural) return std::nullopt;
  if (!region.is_material) return new_area / (old_area + new_area);
  const double value = new_area / old_area;
  return value < limit ? std::optional(value) : std::nullopt;
}

/// N3: natural protrusions with more new area than old, by new / (old + new).
std::optional<double> wide_natural_key(const Region& region, double new_area, double old_area,
                                       double) {
  if (!region.is_natural || !region.is_material) return std::nullopt;
  return new_area / (old_area + new_area);
}

/// S and the paper's order: new / old, below 1.
std::optional<double> strict_key(const Region&, double new_area, double old_area, double limit) {
  const double value = new_area / old_area;
  return value < limit ? std::optional(value) : std::nullopt;
}

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

Chooser::Chooser(const Boundary& body, const SegmentOptions& options, Side free_side,
                 std::vector<int> own_planes, SegmentationStats& stats, std::int64_t& work)
    : body_(body),
      world_(body.world()),
      options_(options),
      free_side_(free_side),
      own_planes_(std::move(own_planes)),
      stats_(stats),
      work_(work),
      planes_(split_planes_of(body, own_planes_)),
      edges_(body, planes_) {
  slots_.reserve(2 * planes_.size());
  for (std::size_t i = 0; i < planes_.size(); ++i)
    for (const int direction : {1, -1}) {
      to_do_.push_back(slots_.size());
      slots_.push_back({i});
      slots_.back().section.plane = planes_[i];
      slots_.back().section.direction = direction;
    }
  sweep_classes();
}

/// Where a class has so many planes that sectioning at each would meet the body's edges many times
/// over, a sweep tells first at which of them there is nothing to cut.
void Chooser::sweep_classes() {
  constexpr std::size_t kManyTimes = 2;  // a sweep costs about as much per edge as two sections
  for (std::size_t first = 0; first < planes_.size();) {
    const int k = world_.planes.class_of(planes_[first]);
    std::size_t last = first, met = 0;
    for (; last < planes_.size() && world_.planes.class_of(planes_[last]) == k; ++last)
      met += edges_.edges_at(last).size();
    if (2 * met > kManyTimes * static_cast<std::size_t>(body_.half_edge_count()))
      sweep_class(k, first, last);
    first = last;
  }
  std::erase_if(to_do_, [&](std::size_t i) { return slots_[i].is_idle; });
}

void Chooser::sweep_class(int normal_class, std::size_t first, std::size_t last) {
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
void Chooser::let_rest(Slot& slot, double area_m2) {
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

void Chooser::count_tests(const Slot& slot) {
  const Side looking = slot.section.looking();
  if (body_.area_on(looking) > 0) ++stats_.protrusion_tests;
  if (body_.area_on(looking ^ 1) > 0) ++stats_.hole_tests;
}

void Chooser::changed(std::vector<Change> changes) {
  edges_.update();
  for (Change& change : changes) {
    for (auto* points : {&change.points, &change.part}) {
      std::ranges::sort(*points);
      points->erase(std::unique(points->begin(), points->end()), points->end());
    }
    apply(change);
  }
}

/// Planes are ordered by class and rank, so those that a change reaches are a run in each class.
void Chooser::apply(const Change& change) {
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

void Chooser::touch(std::size_t number, const Change& change, const Reach& reach, const Box& part) {
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
bool Chooser::loses_loops_only(const Slot& slot, const Change& change, const Reach& reach) const {
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
bool Chooser::stays_idle(Slot& slot, const Change& change, const Reach& reach,
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
bool Chooser::judge(Slot& slot, const Section& section) const {
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

void Chooser::refresh() {
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

/// Takes the loops that have gone from a section. False if it is to be made anew.
bool Chooser::prune(Slot& slot) {
  work_ += std::ssize(slot.section.crossings);
  if (!prune_section(body_, slot.section, {free_side_, options_.tolerances.weld_m})) return false;
  slot.is_idle = !judge(slot, slot.section);
  if (slot.is_idle) slot.section.regions.clear();
  return true;
}

void Chooser::refresh(Slot& slot) {
  slot.is_idle = false;
  slot.section.regions.clear();
  const Side looking = slot.section.looking();
  if (body_.area_on(looking) <= 0 && body_.area_on(looking ^ 1) <= 0) return;
  const auto edges = edges_.edges_at(slot.entry);
  fresh_.plane = slot.section.plane;
  fresh_.direction = slot.section.direction;
  section_at(body_, fresh_, edges, {free_side_, options_.tolerances.weld_m});
  work_ += std::ssize(edges);
  count_tests(slot);
  for (const Region& region : fresh_.regions)
    if (region.is_candidate && fresh_.old_area(region) > region.new_area) ++stats_.candidates;
  slot.is_idle = !judge(slot, fresh_);
  if (!slot.is_idle) std::swap(slot.section, fresh_);
}

std::optional<Choice> Chooser::next(const std::set<CutKey>& banned) {
  banned_ = &banned;
  refresh();
  return options_.order == Order::natural ? natural_next() : paper_next();
}

std::optional<Choice> Chooser::natural_next() {
  if (auto choice = best_section_cut(natural_key, {})) return choice;
  if (options_.max_order > 1)
    if (auto choice = first_of_least_order(patches(false))) return choice;
  if (auto choice = best_section_cut(wide_natural_key, {})) return choice;
  if (options_.max_order == 1) return best_section_cut(strict_key, {});
  if (auto choice = best_section_cut(strict_key, patches(true))) return choice;
  return corner_cut({});
}

std::optional<Choice> Chooser::paper_next() {
  if (auto choice = best_section_cut(strict_key, {})) return choice;
  if (options_.max_order == 1) return std::nullopt;
  return corner_cut(patches(true));
}

/// The best cut with as few planes as possible.
std::optional<Choice> Chooser::first_of_least_order(const std::vector<Patch>& patches) {
  for (int order = 2; order <= options_.max_order; ++order)
    if (auto choice = best_patch_cut(patches, order, order)) return choice;
  return std::nullopt;
}

/// The best hole with as few planes as possible, natural or not.
std::optional<Choice> Chooser::corner_cut(const std::vector<Patch>& natural) {
  for (int order = 2; order <= options_.max_order; ++order) {
    std::vector<Patch> holes =
        find_corner_holes(body_,
                          {order, own_planes_, options_.order == Order::paper,
                           options_.tolerances.weld_m, options_.budget},
                          work_);
    stats_.hole_tests += holes.size();
    stats_.candidates += holes.size();
    // Of a set of planes that was imprinted all holes are there already.
    for (const Patch& patch : natural)
      if (std::ranges::none_of(holes, [&](const Patch& p) { return p.sides() == patch.sides(); }))
        holes.push_back(patch);
    if (auto choice = best_patch_cut(std::move(holes), order, order)) return choice;
  }
  return std::nullopt;
}

std::vector<Patch> Chooser::patches(bool is_hole) {
  std::vector<Patch> found =
      find_patches(body_, is_hole, {own_planes_, options_.max_order, free_side_}, work_);
  (is_hole ? stats_.hole_tests : stats_.protrusion_tests) += found.size();
  stats_.candidates += found.size();
  return found;
}

/// Smaller value, then hole before protrusion, larger volume of all parts, order of the planes.
bool Chooser::is_better(const Choice& p, const Choice& q) const {
  if (!is_same_value(p.value, q.value)) return p.value < q.value;
  if (p.is_hole != q.is_hole) return p.is_hole;
  if (!is_same_value(p.volume, q.volume)) return p.volume > q.volume;
  const auto order = [&](const Choice& c) {
    std::vector<std::tuple<double, double, double, double>> planes;
    for (const Side s : c.sides) {
      const Vec3 n = world_.planes.normal(s);
      planes.emplace_back(n.x, n.y, n.z, world_.planes.offset_m(s));
    }
    return planes;
  };
  return order(p) > order(q);
}

/// Floods from the candidate and gives it the key of its whole lump. False if it is no feature, or
/// none of the pass.
bool Chooser::check(Candidate& candidate, Key key, LumpFinder& finder) {
  const Section& section = candidate.slot->section;
  const Region& region = section.regions[at(candidate.region)];
  candidate.lump = static_cast<int>(lumps_.size());
  lumps_.push_back(finder.find(candidate.region));
  const Lump& lump = lumps_.back();
  if (!lump.is_finite || !lump.is_sound || lump.volume <= 0 ||
      (!region.is_material && !lump.has_bend))
    return false;
  for (const int r : lump.regions) {
    const auto value =
        key(section.regions[at(r)], lump.new_area, section.old_area(region), limit());
    if (!value) return false;
    candidate.key = *value;
  }
  // A lump in front of several regions is one candidate, that of the first region that is one.
  const auto first = std::ranges::find_if(
      lump.regions, [&](int r) { return section.regions[at(r)].is_candidate; });
  return *first == candidate.region;
}

/// Floods from the candidates that lead until none of the leaders is unchecked; those that are no
/// features are dropped.
void Chooser::check_leaders(std::vector<Candidate>& candidates, Key key) {
  const double group = 1 + std::max(kSame, options_.tolerances.value_rel);
  while (!candidates.empty()) {
    double least = candidates[0].key;
    for (const Candidate& c : candidates) least = std::min(least, c.key);
    bool is_settled = true;
    // Candidates of one slot stand together, so one finder at a time does.
    const Slot* found_in = nullptr;
    std::optional<LumpFinder> finder;
    std::erase_if(candidates, [&](Candidate& c) {
      if (c.lump >= 0 || c.key > least * group) return false;
      is_settled = false;
      if (c.slot != found_in) finder.emplace(body_, c.slot->section);
      found_in = c.slot;
      return !check(c, key, *finder);
    });
    if (is_settled) return;
  }
}

std::optional<Choice> Chooser::best_section_cut(Key key, const std::vector<Patch>& rivals) {
  std::vector<Candidate> candidates;
  lumps_.clear();
  for (const std::size_t i : promising_) {
    Slot& slot = slots_[i];
    for (int r = 0; r < std::ssize(slot.section.regions); ++r) {
      const Region& region = slot.section.regions[at(r)];
      const double old = region.is_candidate ? slot.section.old_area(region) : 0;
      if (old <= 0 || is_banned(slot.section, region)) continue;
      if (const auto value = key(region, region.new_area, old, limit()))
        candidates.push_back({&slot, r, -1, *value});
    }
  }
  check_leaders(candidates, key);
  std::optional<Choice> best;
  std::map<std::pair<const Slot*, bool>, bool> is_done;
  double least = std::numeric_limits<double>::infinity();
  for (const Candidate& c : candidates) least = std::min(least, c.key);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const bool is_material =
        candidates[i].slot->section.regions[at(candidates[i].region)].is_material;
    if (!is_same_value(candidates[i].key, least) || is_done[{candidates[i].slot, is_material}])
      continue;
    is_done[{candidates[i].slot, is_material}] = true;
    Choice choice = choice_of(candidates, i);
    if (!best || is_better(choice, *best)) best = std::move(choice);
  }
  if (auto rival = best_patch_cut(rivals, 2, options_.max_order);
      rival && (!best || is_better(*rival, *best)))
    return rival;
  return best;
}

/// The leader with all lumps of the same plane and kind whose value is the same within value_rel.
Choice Chooser::choice_of(const std::vector<Candidate>& candidates, std::size_t leader) const {
  const Candidate& first = candidates[leader];
  const Section& section = first.slot->section;
  const Region& region = section.regions[at(first.region)];
  Choice choice;
  choice.is_hole = !region.is_material;
  choice.is_natural = true;
  choice.value = first.key;
  choice.old_area = section.old_area(region);
  choice.quality = lump_of(first).new_area / choice.old_area;
  choice.sides = {section.split_side(region)};
  choice.section = &section;
  for (const Candidate& c : candidates) {
    if (c.slot != first.slot || c.lump < 0 ||
        c.key > first.key * (1 + std::max(kSame, options_.tolerances.value_rel)))
      continue;
    if (section.regions[at(c.region)].is_material != region.is_material) continue;
    choice.lumps.push_back(lump_of(c));
    choice.lumps.back().value = c.key;
    choice.volume += lump_of(c).volume;
    for (const int r : lump_of(c).regions) choice.is_natural &= section.regions[at(r)].is_natural;
  }
  return choice;
}

std::optional<Choice> Chooser::best_patch_cut(std::vector<Patch> patches, int min_order,
                                              int max_order) {
  std::erase_if(patches, [&](const Patch& p) {
    const int order = static_cast<int>(p.sides().size());
    return order < min_order || order > max_order || p.new_area / p.old_area >= limit() ||
           is_banned(p);
  });
  std::optional<Choice> best;
  for (std::size_t i = 0; i < patches.size(); ++i) {
    Choice choice = choice_of(patches, i);
    if (!best || is_better(choice, *best)) best = std::move(choice);
  }
  return best;
}

Choice Chooser::choice_of(const std::vector<Patch>& patches, std::size_t leader) const {
  const Patch& first = patches[leader];
  Choice choice;
  choice.is_hole = first.is_hole;
  choice.is_natural = true;
  choice.imprinted = first.imprinted;
  choice.old_area = first.old_area;
  choice.value = choice.quality = first.new_area / first.old_area;
  choice.sides = first.sides();
  for (const Patch& p : patches) {
    const double value = p.new_area / p.old_area;
    if (p.is_hole != first.is_hole || p.sides() != choice.sides) continue;
    if (value < choice.value * (1 - kSame) ||
        value > choice.value * (1 + std::max(kSame, options_.tolerances.value_rel)))
      continue;
    choice.patches.push_back(p);
    choice.volume += p.volume;
    choice.is_natural &= p.is_natural;
  }
  return choice;
}

}  // namespace oriel::detail
