#include "kernel/segment/cuts/choice.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <tuple>

namespace oriel::detail {

namespace {

/// No other one of some sorted values is the same.
bool is_alone_in(std::span<const double> values, double value, double tie) {
  const auto first = std::ranges::lower_bound(values, value * (1 - tie));
  return first + 1 == values.end() || *(first + 1) - value > tie * *(first + 1);
}

// The keys by which the passes of the orders sort one-plane candidates; nothing: not a candidate of
// the pass. Below `limit` a value is valid.

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
std::optional<double> wide_natural_key(const Region& region, double new_area, double old_area) {
  if (!region.is_natural || !region.is_material) return std::nullopt;
  return new_area / (old_area + new_area);
}

/// S and the paper's order: new / old, below 1.
std::optional<double> strict_key(double new_area, double old_area, double limit) {
  const double value = new_area / old_area;
  return value < limit ? std::optional(value) : std::nullopt;
}

}  // namespace

Chooser::Chooser(const Boundary& body, const SegmentOptions& options, PlaneSide free_side,
                 std::vector<int> own_planes, SegmentationStats& stats)
    : body_(body),
      world_(body.world()),
      options_(options),
      free_side_(free_side),
      own_planes_(std::move(own_planes)),
      stats_(stats),
      tie_(options.tolerances.tie_rel(world_.points.grid_m())),
      candidates_(body, options, free_side, own_planes_, stats),
      pockets_(body, free_side) {}

std::optional<CutChoice> Chooser::next(const std::set<CutKey>& banned) {
  banned_ = &banned;
  auto choice = options_.order == Order::natural ? natural_next() : paper_next();
  // What was still being looked for may have been better.
  return world_.work.is_used_up() ? std::nullopt : std::move(choice);
}

std::optional<CutChoice> Chooser::natural_next() {
  candidates_.refresh(true);
  if (auto choice = best_section_cut(Pass::natural)) {
    if (auto part = part_on_steps(*choice)) return part;
    return choice;
  }
  if (options_.max_order > 1)
    if (auto choice = first_of_least_order(patches(false, limit()))) return choice;
  if (auto choice = best_section_cut(Pass::wide_natural)) return choice;
  candidates_.refresh(false);
  auto choice = best_section_cut(Pass::strict);
  if (options_.max_order == 1) return choice;
  const auto holes = patches(true, choice ? choice->value : limit());
  auto rival = best_patch_cut(holes, 2, options_.max_order);
  if (rival && (!choice || is_better(*rival, *choice))) return rival;
  return choice ? std::move(choice) : corner_cut({});
}

std::optional<CutChoice> Chooser::paper_next() {
  candidates_.refresh(false);
  if (auto choice = best_section_cut(Pass::strict)) return choice;
  if (options_.max_order == 1) return std::nullopt;
  return corner_cut(patches(true, limit()));
}

/// The best cut with as few planes as possible.
std::optional<CutChoice> Chooser::first_of_least_order(std::span<const Patch> patches) {
  for (int order = 2; order <= options_.max_order; ++order)
    if (auto choice = best_patch_cut(patches, order, order)) return choice;
  return std::nullopt;
}

/// The best hole with as few planes as possible, natural or not.
std::optional<CutChoice> Chooser::corner_cut(std::span<const Patch> natural) {
  for (int order = 2; order <= options_.max_order; ++order) {
    std::vector<Patch> holes = find_corner_holes(
        body_, {order, own_planes_, options_.order == Order::paper, options_.tolerances.weld_m});
    stats_.hole_tests += holes.size();
    stats_.candidates += holes.size();
    // Of a set of planes that was imprinted all holes are there already.
    for (const Patch& patch : natural)
      if (std::ranges::none_of(holes, [&](const Patch& p) { return p.sides() == patch.sides(); }))
        holes.push_back(patch);
    if (auto choice = best_patch_cut(holes, order, order)) return choice;
  }
  return std::nullopt;
}

/// The best patch of those that a cut by one plane would take along with what is flat and they
/// stand on or before: they lie on its plane, and on one before it that looks the same way. A bay
/// comes off before the plinth that runs into it.
std::optional<CutChoice> Chooser::part_on_steps(const CutChoice& choice) {
  constexpr int kLeastOrder = 3;  // the two planes, and one that joins them
  if (choice.is_hole || options_.max_order < kLeastOrder) return std::nullopt;
  const auto has_bend = [](const Lump& lump) { return !lump.pocket.is_valid() && lump.has_bend; };
  if (std::ranges::none_of(choice.lumps, has_bend)) return std::nullopt;
  const PlaneTable& planes = world_.planes;
  const PlaneSide rear = choice.sides[0];
  const auto is_before = [&](PlaneSide side) {
    return planes.class_of(side >> 1) == planes.class_of(rear >> 1) && (side & 1) == (rear & 1) &&
           planes.offset_m(side) > planes.offset_m(rear);
  };
  if (std::ranges::none_of(body_.sides(), is_before)) return std::nullopt;
  std::vector<Patch> on_steps = patches(false, limit());
  std::erase_if(on_steps, [&](const Patch& patch) {
    const std::vector<PlaneSide> sides = patch.sides();
    return !std::ranges::binary_search(sides, rear) || std::ranges::none_of(sides, is_before);
  });
  return best_patch_cut(on_steps, kLeastOrder, options_.max_order);
}

/// Those with a larger value than `most` may be left out.
std::vector<Patch> Chooser::patches(bool is_hole, double most) {
  std::vector<Patch> found = find_patches(body_, is_hole,
                                          {own_planes_, options_.max_order, free_side_,
                                           options_.order == Order::natural && !is_hole, most});
  (is_hole ? stats_.hole_tests : stats_.protrusion_tests) += found.size();
  stats_.candidates += found.size();
  return found;
}

/// Smaller value, then hole before protrusion, larger volume of all parts, order of the planes.
bool Chooser::is_better(const CutChoice& p, const CutChoice& q) const {
  if (!is_same_value(p.value, q.value)) return p.value < q.value;
  if (p.is_hole != q.is_hole) return p.is_hole;
  if (!is_same_value(p.volume, q.volume)) return p.volume > q.volume;
  const auto order = [&](const CutChoice& c) {
    std::vector<std::tuple<double, double, double, double>> planes;
    for (const PlaneSide s : c.sides) {
      const Vec3 n = world_.planes.normal(s);
      planes.emplace_back(n.x, n.y, n.z, world_.planes.offset_m(s));
    }
    return planes;
  };
  return order(p) > order(q);
}

/// The lump in front of a candidate. What only floods can tell is flooded, of pockets of one kind
/// the first; a lump that is alone is none of a kind.
Lump Chooser::lump_at(const RegionCandidate& candidate, bool is_alone) {
  const Section& section = *candidate.section;
  const PocketId pocket = pockets_.find(section, candidate.region, is_alone);
  if (pocket.is_valid() && !is_alone) {
    const PocketKindId kind = pockets_.kind_of(pocket);
    if (!lump_of_kind_.contains(kind)) lump_of_kind_.resize(kind.index() + 1, -1);
    if (const int first = lump_of_kind_[kind]; first >= 0) {
      Lump same = lumps_[at(first)];
      same.regions = {candidate.region};
      same.new_area = section.regions[candidate.region].new_area;
      same.pocket = pocket;
      return same;
    }
    lump_of_kind_[kind] = static_cast<int>(lumps_.size());
  }
  Lump lump = !pocket.is_valid() ? flood(candidate) : lump_of(pocket, candidate);
  lump.is_alone = is_alone;
  lump.pocket = pocket;
  return lump;
}

Lump Chooser::lump_of(PocketId pocket, const RegionCandidate& candidate) {
  const Section& section = *candidate.section;
  const Region& region = section.regions[candidate.region];
  const auto flooded = pockets_.flooded(pocket, section, region);
  if (!flooded) return flood(candidate);
  Lump lump;
  lump.regions.push_back(candidate.region);
  lump.new_area = region.new_area;
  lump.volume = flooded->volume;
  lump.has_bend = flooded->has_bend;
  return lump;
}

Lump Chooser::flood(const RegionCandidate& candidate) {
  if (candidate.section != flooded_) {
    finder_.emplace(body_, *candidate.section);
    world_.work.add(std::ssize(candidate.section->crossings));
  }
  flooded_ = candidate.section;
  Lump lump = finder_->find(candidate.region);
  world_.work.add(finder_->steps());
  return lump;
}

std::optional<double> Chooser::key_of(Pass pass, const Region& region, double new_area,
                                      double old_area) const {
  const double limit = 1 - options_.tolerances.value_rel;
  switch (pass) {
    case Pass::natural:
      return natural_key(region, new_area, old_area, limit);
    case Pass::wide_natural:
      return wide_natural_key(region, new_area, old_area);
    case Pass::strict:
      break;
  }
  return strict_key(new_area, old_area, limit);
}

/// Gives a candidate its lump, and the key of that as a whole. False if it is no feature, or none
/// of the pass.
bool Chooser::check(RegionCandidate& candidate, Pass pass, bool is_alone) {
  const Section& section = *candidate.section;
  const Region& region = section.regions[candidate.region];
  Lump found = lump_at(candidate, is_alone);
  candidate.lump = static_cast<int>(lumps_.size());
  lumps_.push_back(std::move(found));
  const Lump& lump = lumps_.back();
  // Of what is smaller than points may be off their planes, the volume may have any sign.
  const double least_m = 2 * options_.tolerances.plane_offset_m;
  if (!lump.is_finite || !lump.is_sound || lump.volume <= 0 || lump.new_area < least_m * least_m ||
      (!region.is_material && !lump.has_bend))
    return false;
  for (const RegionId r : lump.regions) {
    const auto value = key_of(pass, section.regions[r], lump.new_area, section.old_area(region));
    if (!value) return false;
    candidate.key = *value;
  }
  if (pass == Pass::wide_natural && is_larger_half(lump, section)) return false;
  // A lump in front of several regions is one candidate, that of the first region that is one.
  const auto first = std::ranges::find_if(
      lump.regions, [&](RegionId r) { return section.regions[r].is_candidate; });
  return *first == candidate.region;
}

/// What hangs on a body through a neck and is no smaller than what it leaves is no part of it: a
/// block, whose wall comes down to the ground between two pieces of a plinth, does not end on it.
bool Chooser::is_larger_half(const Lump& lump, const Section& section) const {
  const bool has_neck =
      std::ranges::any_of(lump.regions, [&](RegionId r) { return section.regions[r].has_neck; });
  return has_neck && 2 * lump.volume > (1 - tie_) * body_.volume();
}

template <class Visit>
void Chooser::for_each_candidate(const Section& section, Pass pass, Visit visit) const {
  for (const RegionId r : section.regions.ids()) {
    const Region& region = section.regions[r];
    const double old = region.is_candidate ? section.old_area(region) : 0;
    if (old <= 0 || is_banned(section, region)) continue;
    if (const auto key = key_of(pass, region, region.new_area, old)) visit(r, *key);
  }
}

/// Infinite if it has no candidate. Known of a section that is the same as when it was last asked
/// for.
double Chooser::least_key(std::size_t number, Pass pass) {
  auto& leasts = leasts_[static_cast<std::size_t>(pass)];
  if (leasts.empty()) leasts.resize(candidates_.size());
  Least& least = leasts[number];
  const CutCandidate& side = candidates_[number];
  if (least.version == side.version && banned_->empty()) return least.key;
  least = {banned_->empty() ? side.version : -1, std::numeric_limits<double>::infinity()};
  for_each_candidate(*side.section, pass,
                     [&](RegionId, double key) { least.key = std::min(least.key, key); });
  return least.key;
}

/// Adds the candidates with no larger key; a section that has others waits on with the least of
/// them.
void Chooser::take_candidates(std::vector<RegionCandidate>& candidates, Pass pass, double most) {
  const auto before = std::ssize(candidates);
  while (!waiting_.empty() && waiting_.front().first <= most) {
    const auto [least, number] = waiting_.front();
    std::ranges::pop_heap(waiting_, std::greater{});
    const Section& section = *candidates_[number].section;
    double next = std::numeric_limits<double>::infinity();
    for_each_candidate(section, pass, [&](RegionId region, double key) {
      if (key > most)
        next = std::min(next, key);
      else if (key >= least)
        candidates.push_back({number, &section, region, -1, key});
    });
    if (next < std::numeric_limits<double>::infinity()) {
      waiting_.back().first = next;
      std::ranges::push_heap(waiting_, std::greater{});
    } else {
      waiting_.pop_back();
    }
  }
  const auto place = [](const RegionCandidate& c) { return std::pair(c.number, c.region); };
  const auto added = candidates.begin() + before;
  std::ranges::sort(added, candidates.end(), {}, place);
  std::ranges::inplace_merge(candidates.begin(), added, candidates.end(), {}, place);
}

/// Floods from the candidates that lead until none of the leaders is unchecked; those that are no
/// features are dropped.
void Chooser::check_leaders(std::vector<RegionCandidate>& candidates, Pass pass) {
  const double group = 1 + std::max(tie_, options_.tolerances.value_rel);
  while ((!candidates.empty() || !waiting_.empty()) && !world_.work.is_used_up()) {
    double least = waiting_.empty() ? candidates[0].key : waiting_.front().first;
    for (const RegionCandidate& c : candidates) least = std::min(least, c.key);
    take_candidates(candidates, pass, least * group);
    const auto leads = [&](const RegionCandidate& c) {
      return c.lump < 0 && c.key <= least * group;
    };
    std::vector<double> keys;
    for (const RegionCandidate& c : candidates)
      if (leads(c)) keys.push_back(c.key);
    if (keys.empty()) return;
    std::ranges::sort(keys);
    // Candidates of one section stand together, so one finder at a time does.
    flooded_ = nullptr;
    std::erase_if(candidates, [&](RegionCandidate& c) {
      return leads(c) && !check(c, pass, is_alone_in(keys, c.key, tie_));
    });
  }
}

/// Only sections with a leader are asked for their candidates: most do not change from cut to cut.
void Chooser::wait_for_sections(Pass pass) {
  waiting_.clear();
  for (std::size_t number = 0; number < candidates_.size(); ++number) {
    if (!candidates_[number].has_regions()) continue;
    const double key = least_key(number, pass);
    if (key < std::numeric_limits<double>::infinity()) waiting_.emplace_back(key, number);
  }
  std::ranges::make_heap(waiting_, std::greater{});
}

std::optional<CutChoice> Chooser::best_section_cut(Pass pass) {
  std::vector<RegionCandidate> candidates;
  lumps_.clear();
  lump_of_kind_.assign(pockets_.kind_count(), -1);
  wait_for_sections(pass);
  check_leaders(candidates, pass);
  std::optional<CutChoice> best;
  boost::container::small_vector<std::pair<std::size_t, bool>, 8>
      done;  // sections, and which kind of their regions
  double least = std::numeric_limits<double>::infinity();
  for (const RegionCandidate& c : candidates) least = std::min(least, c.key);
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const bool is_material = candidates[i].section->regions[candidates[i].region].is_material;
    const std::pair kind(candidates[i].number, is_material);
    if (!is_same_value(candidates[i].key, least) || std::ranges::find(done, kind) != done.end())
      continue;
    done.push_back(kind);
    CutChoice choice = choice_of(candidates, i);
    if (!best || is_better(choice, *best)) best = std::move(choice);
  }
  return best;
}

/// The leader with all lumps of the same plane and kind whose value is the same within value_rel.
CutChoice Chooser::choice_of(std::span<const RegionCandidate> candidates,
                             std::size_t leader) const {
  const RegionCandidate& first = candidates[leader];
  const Section& section = *first.section;
  const Region& region = section.regions[first.region];
  CutChoice choice;
  choice.is_hole = !region.is_material;
  choice.is_natural = true;
  choice.value = first.key;
  choice.old_area = section.old_area(region);
  choice.quality = lump_of(first).new_area / choice.old_area;
  choice.sides = {section.split_side(region)};
  choice.section = &section;
  choice.pockets = &pockets_;
  for (const RegionCandidate& c : candidates) {
    if (c.section != first.section || c.lump < 0 ||
        c.key > first.key * (1 + std::max(tie_, options_.tolerances.value_rel)))
      continue;
    if (section.regions[c.region].is_material != region.is_material) continue;
    choice.lumps.push_back(lump_of(c));
    choice.lumps.back().value = c.key;
    choice.volume += lump_of(c).volume;
    for (const RegionId r : lump_of(c).regions) {
      choice.is_natural &= section.regions[r].is_natural;
      choice.has_neck |= section.regions[r].has_neck;
    }
  }
  return choice;
}

std::optional<CutChoice> Chooser::best_patch_cut(std::span<const Patch> patches, int min_order,
                                                 int max_order) {
  std::vector<const Patch*> fit;
  for (const Patch& p : patches) {
    const auto order = std::ranges::count(p.caps, false, &CutCap::is_taken);
    if (order >= min_order && order <= max_order && !(p.new_area / p.old_area >= limit()) &&
        !is_banned(p))
      fit.push_back(&p);
  }
  std::optional<CutChoice> best;
  for (const Patch* leader : fit) {
    CutChoice choice = choice_of(fit, *leader);
    if (!best || is_better(choice, *best)) best = std::move(choice);
  }
  return best;
}

CutChoice Chooser::choice_of(std::span<const Patch* const> patches, const Patch& first) const {
  CutChoice choice;
  choice.is_hole = first.is_hole;
  choice.is_natural = true;
  choice.imprinted = first.imprinted;
  choice.old_area = first.old_area;
  choice.value = choice.quality = first.new_area / first.old_area;
  choice.sides = first.sides();
  for (const Patch* patch : patches) {
    const Patch& p = *patch;
    const double value = p.new_area / p.old_area;
    if (p.is_hole != first.is_hole) continue;
    if (value < choice.value * (1 - tie_) ||
        value > choice.value * (1 + std::max(tie_, options_.tolerances.value_rel)) ||
        p.sides() != choice.sides)
      continue;
    choice.patches.push_back(p);
    choice.volume += p.volume;
    choice.is_natural &= p.is_natural;
  }
  return choice;
}

}  // namespace oriel::detail
