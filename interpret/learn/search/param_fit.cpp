#include "interpret/learn/search/param_fit.h"

#include "kernel/base/random.h"

#include <algorithm>
#include <map>
#include <nlopt.hpp>
#include <span>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// How far from where the run stands params are moved, as a share of their ranges.
constexpr double kNeighbourhood = 0.3;
/// Where a pack would be refused: worse than anything.
constexpr double kRefused = -1e6;

/// What the search asks, and the best that it was told.
struct JointQuestion {
  const LearningSet& set;
  SearchRun& run;
  std::span<const std::size_t> params;
  SearchRun best;
};

double answer(const std::vector<double>& values, std::vector<double>& /*gradient*/, void* data) {
  auto& question = *static_cast<JointQuestion*>(data);
  SearchRun run = question.run;
  for (std::size_t i = 0; i < values.size(); ++i) run.at[question.params[i]] = values[i];
  if (question.set.is_given_up() || !question.set.is_sound(run.at)) return kRefused;
  run.objective = question.set.value(question.set.outcomes(run.at, run.samples), run.samples);
  if (run.objective > question.best.objective) question.best = run;
  return run.objective;
}

/// Moves several params of a run together, where moving one after the other leads no further: a
/// controlled random search (NLopt's GN_CRS2_LM) in the neighbourhood of where the run stands, with
/// so many measurements at most. The run changes only if its objective grows. The same seed gives
/// the same result; one thread at a time may search.
void search_jointly(const LearningSet& set, SearchRun& run, std::span<const std::size_t> params,
                    int most_measurements, std::uint64_t seed) {
  if (params.size() < 2 || run.samples.empty()) return;
  std::vector<double> low, high, at;
  for (const std::size_t param : params) {
    const auto [from, to] = *set.pack().params[param].range;
    const double reach = kNeighbourhood * (to - from);
    at.push_back(run.at[param]);
    low.push_back(std::max(from, at.back() - reach));
    high.push_back(std::min(to, at.back() + reach));
  }
  JointQuestion question{set, run, params, run};
  nlopt::srand(static_cast<unsigned long>(seed));
  nlopt::opt search(nlopt::GN_CRS2_LM, static_cast<unsigned>(params.size()));
  search.set_lower_bounds(low);
  search.set_upper_bounds(high);
  search.set_max_objective(answer, &question);
  search.set_maxeval(most_measurements);
  double best = 0;
  try {
    search.optimize(at, best);
  } catch (const nlopt::roundoff_limited&) {
    // What it found so far counts.
  }
  run = std::move(question.best);
}

/// Rounds of the search through all params.
constexpr int kMostRoundsOfSearch = 6;
/// Measurements of the joint search, and the most params that it moves.
constexpr int kMostJointMeasurements = 200;
constexpr std::size_t kMostJointParams = 8;
/// Of a restart: the share of the params that are moved elsewhere.
constexpr double kMovedAtRestart = 0.3;

int direction(double from, double to) { return to > from ? 1 : to < from ? -1 : 0; }

std::vector<Setting> settings_of_parts(std::span<const SearchRun> runs) {
  std::vector<Setting> settings;
  for (const SearchRun& run : runs.subspan(1)) settings.push_back(run.at);
  return settings;
}

}  // namespace

ParamFit ParamFitter::fit(const SamplePart& samples, const std::vector<SamplePart>& parts) const {
  const Runs runs = search(samples, parts);
  ParamFit fit{runs[0].at, "", settings_of_parts(runs), {}};
  const bool is_changed = fit.at != base_;
  const std::vector<std::size_t> agreed = agreed_params(fit);
  if (agreed.empty()) {
    fit.at = base_;
    fit.reason = is_changed ? "the folds do not agree which params to change"
                            : "no change of a param gains more than its penalty";
    return fit;
  }
  const Runs again = search_again(runs, parts, agreed);
  fit.at = again[0].at;
  fit.agreed = settings_of_parts(again);
  fit.reason =
      fit.at == base_ ? "no change of a param gains more than its penalty" : fault_of(fit, parts);
  if (!fit.reason.empty()) fit.at = base_;
  return fit;
}

ParamFitter::Runs ParamFitter::fresh_runs(const ParamSearch& search, const SamplePart& samples,
                                          const std::vector<SamplePart>& parts) const {
  Runs runs(parts.size() + 1);
  runs[0].samples = samples;
  for (std::size_t i = 0; i < parts.size(); ++i) runs[i + 1].samples = outside(parts[i], samples);
  for (SearchRun& run : runs) {
    run.at = base_;
    search.measure(run);
  }
  return runs;
}

/// They begin at the pack's values.
ParamFitter::Runs ParamFitter::search(const SamplePart& samples,
                                      const std::vector<SamplePart>& parts) const {
  const ParamSearch search(set_, base_, penalty_, free_);
  Runs best = fresh_runs(search, samples, parts);
  search.climb(best, kMostRoundsOfSearch);
  for (SearchRun& run : best) search.go_back(run);
  for (int restart = 0; restart < restarts_; ++restart) begin_again(search, restart, best);
  for (SearchRun& run : best) refine(search, run);
  return best;
}

/// From the best so far with some params moved at random, the same ones in each run.
void ParamFitter::begin_again(const ParamSearch& search, int restart, Runs& best) const {
  Random random(seed_, static_cast<std::uint64_t>(restart) + 1);
  std::map<std::size_t, double> moved;
  for (const std::size_t param : free_) {
    const auto [low, high] = *set_.pack().params[param].range;
    const bool is_moved = random.chance(kMovedAtRestart);
    const double value = low + (high - low) * random.unit();
    if (is_moved) moved[param] = value;
  }
  Runs runs = best;
  for (SearchRun& run : runs) {
    for (const auto& [param, value] : moved) {
      Setting at = run.at;
      at[param] = value;
      if (set_.is_sound(at)) run.at = std::move(at);
    }
    search.measure(run);
  }
  search.climb(runs, kMostRoundsOfSearch);
  for (std::size_t i = 0; i < runs.size(); ++i) {
    search.go_back(runs[i]);
    if (search.score_of(runs[i]) > search.score_of(best[i]) + kLeastGain) best[i] = runs[i];
  }
}

/// The params that were changed are moved together; then each on its own once more.
void ParamFitter::refine(const ParamSearch& search, SearchRun& run) const {
  std::vector<std::size_t> changed;
  for (const std::size_t param : free_)
    if (run.at[param] != base_[param] && changed.size() < kMostJointParams)
      changed.push_back(param);
  SearchRun refined = run;
  search_jointly(set_, refined, changed, kMostJointMeasurements, seed_);
  if (refined.objective <= run.objective + kLeastGain) return;
  search.climb({&refined, 1}, 1);
  search.go_back(refined);
  if (search.score_of(refined) > search.score_of(run) + kLeastGain) run = std::move(refined);
}

std::size_t ParamFitter::count_like(const std::vector<Setting>& settings, std::size_t param,
                                    double value) const {
  const int way = direction(base_[param], value);
  return static_cast<std::size_t>(std::ranges::count_if(settings, [&](const Setting& setting) {
    return direction(base_[param], setting[param]) == way;
  }));
}

/// Those that were changed on all samples, and the same way in half of the parts.
std::vector<std::size_t> ParamFitter::agreed_params(const ParamFit& fit) const {
  std::vector<std::size_t> agreed;
  for (std::size_t param = 0; param < base_.size(); ++param)
    if (fit.at[param] != base_[param] &&
        2 * count_like(fit.searched, param, fit.at[param]) >= fit.searched.size())
      agreed.push_back(param);
  return agreed;
}

/// Each run goes on from where it stands with the agreed params alone.
ParamFitter::Runs ParamFitter::search_again(const Runs& runs, const std::vector<SamplePart>& parts,
                                            const std::vector<std::size_t>& agreed) const {
  const ParamSearch search(set_, base_, penalty_, agreed);
  Runs again = fresh_runs(search, runs[0].samples, parts);
  for (std::size_t i = 0; i < again.size(); ++i) {
    SearchRun moved = again[i];
    for (const std::size_t param : agreed) moved.at[param] = runs[i].at[param];
    if (!set_.is_sound(moved.at)) continue;
    search.measure(moved);
    if (search.score_of(moved) > search.score_of(again[i])) again[i] = std::move(moved);
  }
  search.climb(again, kMostRoundsOfSearch);
  for (SearchRun& run : again) search.go_back(run);
  return again;
}

/// Why it is not better on the parts, or nothing.
std::string ParamFitter::fault_of(const ParamFit& fit, const std::vector<SamplePart>& parts) const {
  const SamplePart held = samples_of_parts(parts);
  const double before = set_.value(set_.outcomes(base_, held), held);
  const double after = set_.value(held_out_outcomes(set_, parts, fit.agreed), held);
  if (after > before + kLeastGain) return {};
  return fmt::format(
      "what was learnt is not better on held-out folds: {} is {:.4f} there, {:.4f} with the pack "
      "as it is",
      set_.objective().name(), after, before);
}

std::vector<LabelOutcome> held_out_outcomes(const LearningSet& set,
                                            const std::vector<SamplePart>& parts,
                                            const std::vector<Setting>& settings) {
  std::vector<LabelOutcome> all(set.samples().size());
  for (std::size_t i = 0; i < parts.size(); ++i) {
    auto outcomes = set.outcomes(settings[i], parts[i]);
    for (const std::size_t sample : parts[i]) all[sample] = std::move(outcomes[sample]);
  }
  return all;
}

SamplePart samples_of_parts(const std::vector<SamplePart>& parts) {
  SamplePart all;
  for (const SamplePart& part : parts) all.insert(all.end(), part.begin(), part.end());
  std::ranges::sort(all);
  return all;
}

}  // namespace oriel
