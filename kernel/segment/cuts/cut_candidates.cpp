#include "kernel/segment/cuts/cut_candidates.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace oriel::detail {

namespace {

/// Ascending.
std::vector<int> split_planes_of(const Boundary& body, std::span<const int> own_planes) {
  std::vector<int> planes;
  for (const PlaneSide side : body.sides())
    if (planes.empty() || planes.back() != side >> 1) planes.push_back(side >> 1);
  std::erase_if(
      planes, [&](int plane) { return std::ranges::find(own_planes, plane) != own_planes.end(); });
  return planes;
}

/// Ranks from `low` up to `high`.
struct RankRange {
  int low = std::numeric_limits<int>::max(), high = -1;
  void grow(int rank) {
    low = std::min(low, rank);
    high = std::max(high, rank);
  }
  [[nodiscard]] bool is_empty() const { return high < low; }
};

/// Nothing can be cut: no region follows edges, and none has less new area than old.
bool is_without_cuts(const Section& section) {
  if (!section.crossings.empty() && section.loops.empty()) return false;
  return std::ranges::all_of(section.regions, [&](const Region& region) {
    const double old = section.old_area(region);
    return old <= 0 || (!region.is_natural && region.new_area > old);
  });
}

}  // namespace

CutCandidates::CutCandidates(const Boundary& body, const SegmentOptions& options,
                             PlaneSide free_side, std::span<const int> own_planes,
                             SegmentationStats& stats)
    : body_(body),
      world_(body.world()),
      section_options_{free_side, options.tolerances.weld_m, options.order == Order::natural},
      stats_(stats),
      planes_(split_planes_of(body, own_planes)),
      edges_(body, planes_),
      chains_(body, planes_, free_side, section_options_.are_necks_free),
      candidates_(2 * planes_.size()) {
  classes_.reserve(std::min(planes_.size(), at(world_.planes.class_count())));
  for (std::size_t i = 0; i < planes_.size(); ++i) {
    const int k = world_.planes.class_of(planes_[i]);
    if (classes_.empty() || classes_.back().number != k) classes_.push_back({k, i, i});
    ++classes_.back().last;
    candidates_[2 * i].entry = candidates_[2 * i + 1].entry = i;
    candidates_[2 * i + 1].direction = -1;
  }
}

void CutCandidates::invalidate(std::span<const RestChange> changes) {
  edges_.update();
  for (const RestChange& change : changes)
    change.has_covered ? chains_.forget() : chains_.expect(change.new_edges);
  for (std::size_t k = 0; k < classes_.size(); ++k) {
    const PlanesOfClass& c = classes_[k];
    const auto in_class = std::span(candidates_).subspan(2 * c.first, 2 * (c.last - c.first));
    const auto is_stale = [](const CutCandidate& one) {
      return one.state == CutCandidate::State::stale;
    };
    if (std::ranges::all_of(in_class, is_stale)) continue;
    for (const RestChange& change : changes) invalidate(k, change);
  }
}

/// A change concerns the planes between its points. The part of a natural cut whose rim is on one
/// side of a section was met by it in whole loops or not at all, as its wall has no other end than
/// the rim: then nothing but loops is lost.
void CutCandidates::invalidate(std::size_t k, const RestChange& change) {
  const PlanesOfClass& c = classes_[k];
  const auto ranks = world_.points.ranks(c.number);
  RankRange touched, rim;
  for (const PointId p : change.points) touched.grow(ranks[p]);
  for (const auto& [from, to] : change.rim) rim.grow(ranks[from]);
  const PlaneRanks& planes = edges_.ranks_of_class(k);
  const std::size_t last = 2 * (c.first + planes.before(touched.high + 1));
  for (std::size_t i = 2 * (c.first + planes.before(touched.low)); i < last; ++i) {
    CutCandidate& one = candidates_[i];
    if (one.state == CutCandidate::State::stale) continue;
    const int rank = planes[one.entry - c.first] * one.direction;
    const auto is_beyond = [&](int other) { return other * one.direction > rank; };
    const bool loses_loops_only =
        change.is_natural && !rim.is_empty() && is_beyond(rim.low) == is_beyond(rim.high);
    one.state = loses_loops_only && one.state != CutCandidate::State::cached
                    ? CutCandidate::State::shrunk
                    : CutCandidate::State::stale;
  }
}

void CutCandidates::refresh(bool natural_only) {
  if (natural_only) chains_.refresh();
  for (std::size_t i = 0; i < candidates_.size() && !world_.work.is_used_up(); ++i) {
    CutCandidate& one = candidates_[i];
    if (one.state == CutCandidate::State::cached || one.state == CutCandidate::State::active)
      continue;
    ++one.version;
    if (one.state == CutCandidate::State::shrunk && prune(one)) continue;
    if (one.section != nullptr) one.section->regions.clear();
    if (natural_only && !chains_.may_be_natural(i))
      one.state = CutCandidate::State::stale;
    else
      make_section(one);
  }
}

/// Takes the loops that have gone from a section. False if it is to be made anew.
bool CutCandidates::prune(CutCandidate& candidate) {
  Section& section = section_of(candidate);
  world_.work.add(std::ssize(section.crossings));
  if (!prune_section(body_, section, section_options_)) return false;
  candidate.state = CutCandidate::State::active;
  if (is_without_cuts(section)) {
    section.regions.clear();
    candidate.state = CutCandidate::State::cached;
  }
  return true;
}

void CutCandidates::make_section(CutCandidate& candidate) {
  candidate.state = CutCandidate::State::cached;
  const int plane = planes_[candidate.entry];
  if (!body_.on_plane(plane).has_area()) return;
  const auto edges = edges_.edges_at(candidate.entry, candidate.direction);
  fresh_.plane = plane;
  fresh_.direction = candidate.direction;
  section_at(body_, fresh_, edges, section_options_);
  world_.work.add(std::ssize(edges));
  if (fresh_.old_areas[1] > 0) ++stats_.protrusion_tests;
  if (fresh_.old_areas[0] > 0) ++stats_.hole_tests;
  for (const Region& region : fresh_.regions)
    if (region.is_candidate && fresh_.old_area(region) > region.new_area) ++stats_.candidates;
  if (is_without_cuts(fresh_)) return;
  candidate.state = CutCandidate::State::active;
  std::swap(section_of(candidate), fresh_);
}

/// The one that a candidate keeps, or begins to.
Section& CutCandidates::section_of(CutCandidate& candidate) {
  if (candidate.section == nullptr)
    candidate.section = &sections_.emplace_back(planes_[candidate.entry], candidate.direction);
  return *candidate.section;
}

}  // namespace oriel::detail
