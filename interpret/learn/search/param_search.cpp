#include "interpret/learn/search/param_search.h"

#include "interpret/learn/search/plateau.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>

namespace oriel {

namespace {

/// Stretches that are narrower than this share of the range are no place to stand on.
constexpr double kNarrowestPlateau = 0.005;
/// So many of the best plateaus are tried where the pack would be refused with the first.
constexpr std::size_t kMostTried = 20;

std::vector<std::size_t> all_samples_of(std::span<const SearchRun* const> runs) {
  std::set<std::size_t> all;
  for (const SearchRun* run : runs) all.insert(run->samples.begin(), run->samples.end());
  return {all.begin(), all.end()};
}

double distance_to(const Plateau& plateau, double value) {
  if (value < plateau.from) return plateau.from - value;
  return std::max(0.0, value - plateau.to);
}

}  // namespace

std::size_t ParamSearch::changes_of(const Setting& setting) const {
  std::size_t changes = 0;
  for (std::size_t param = 0; param < setting.size(); ++param)
    changes += setting[param] == base_[param] ? 0 : 1;
  return changes;
}

double ParamSearch::score_of(const SearchRun& run) const {
  return run.objective - penalty_ * static_cast<double>(changes_of(run.at));
}

void ParamSearch::measure(SearchRun& run) const {
  run.objective = set_.value(set_.outcomes(run.at, run.samples), run.samples);
}

void ParamSearch::climb(std::span<SearchRun> runs, int most_rounds) const {
  for (int round = 0; round < most_rounds; ++round) {
    bool has_moved = false;
    for (const std::size_t param : free_) has_moved = move_all(runs, param) || has_moved;
    if (!has_moved) return;
  }
}

/// True if one of the runs was moved.
bool ParamSearch::move_all(std::span<SearchRun> runs, std::size_t param) const {
  std::vector<SearchRun*> open;
  for (SearchRun& run : runs) open.push_back(&run);
  bool has_moved = false;
  while (!open.empty()) {
    const Setting at = open.front()->at;
    const auto others = std::stable_partition(open.begin(), open.end(),
                                              [&](const SearchRun* run) { return run->at == at; });
    const std::vector<SearchRun*> together(open.begin(), others);
    open.erase(open.begin(), others);
    const std::vector<const SearchRun*> of(together.begin(), together.end());
    const auto curves = set_.curves(at, param, all_samples_of(of));
    for (SearchRun* run : together) has_moved = move(*run, param, curves) || has_moved;
  }
  return has_moved;
}

/// To the best plateau, of equal ones the nearest to the base.
bool ParamSearch::move(SearchRun& run, std::size_t param,
                       std::span<const ParamCurve> curves) const {
  if (set_.is_given_up()) return false;
  const auto [low, high] = *set_.pack().params[param].range;
  std::vector<const ParamCurve*> own;
  LabelOutcome here;
  for (const std::size_t sample : run.samples) {
    own.push_back(&curves[sample]);
    here.add(curves[sample].at_value);
  }
  if (own.empty()) return false;
  run.objective = set_.value(here);
  auto plateaus =
      plateaus_of(sum_of(own, low, high), [&](const LabelOutcome& sum) { return set_.value(sum); });
  const double least = kNarrowestPlateau * (high - low);
  std::erase_if(plateaus, [&](const Plateau& p) { return p.to - p.from < least; });
  const double base = base_[param];
  const auto gain_of = [&](const Plateau& p) {
    const bool was_changed = run.at[param] != base, is_changed = value_within(p, base) != base;
    return p.value - run.objective + (was_changed ? penalty_ : 0) - (is_changed ? penalty_ : 0);
  };
  std::ranges::sort(plateaus, {}, [&](const Plateau& p) {
    return std::tuple(-gain_of(p), distance_to(p, base), p.from);
  });
  for (std::size_t i = 0; i < std::min(kMostTried, plateaus.size()); ++i) {
    if (gain_of(plateaus[i]) <= kLeastGain) return false;
    SearchRun moved = run;
    moved.at[param] = value_within(plateaus[i], base);
    if (!set_.is_sound(moved.at)) continue;
    moved.objective = plateaus[i].value;
    run = std::move(moved);
    return true;
  }
  return false;
}

/// The one that costs least goes first.
void ParamSearch::go_back(SearchRun& run) const {
  while (true) {
    std::vector<SearchRun> tries;
    for (const std::size_t param : free_) {
      if (run.at[param] == base_[param]) continue;
      SearchRun back = run;
      back.at[param] = base_[param];
      if (!set_.is_sound(back.at)) continue;
      measure(back);
      tries.push_back(std::move(back));
    }
    const auto best = std::ranges::max_element(tries, {}, &SearchRun::objective);
    if (best == tries.end() || best->objective < run.objective - penalty_) return;
    run = std::move(*best);
  }
}

}  // namespace oriel
