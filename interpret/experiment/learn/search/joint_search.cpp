#include "interpret/experiment/learn/search/joint_search.h"

#include <algorithm>
#include <nlopt.hpp>

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
  if (!question.set.is_sound(run.at)) return kRefused;
  run.objective = question.set.value(question.set.outcomes(run.at, run.samples), run.samples);
  if (run.objective > question.best.objective) question.best = run;
  return run.objective;
}

}  // namespace

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

}  // namespace oriel
