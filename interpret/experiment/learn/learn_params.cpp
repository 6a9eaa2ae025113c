#include "interpret/experiment/learn/learn_params.h"

#include "interpret/experiment/learn/joint_search.h"
#include "interpret/experiment/learn/learning_set.h"
#include "interpret/experiment/learn/param_search.h"
#include "interpret/language/quantity.h"
#include "interpret/language/suggest.h"
#include "interpret/pack/names.h"
#include "kernel/base/counted.h"
#include "kernel/base/index.h"
#include "kernel/base/random.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// Rounds of the search through all params.
constexpr int kMostRoundsOfSearch = 6;
/// Measurements of the joint search, and the most params that it moves.
constexpr int kMostJointMeasurements = 200;
constexpr std::size_t kMostJointParams = 8;
/// Of a restart: the share of the params that are moved elsewhere.
constexpr double kMovedAtRestart = 0.3;
/// A better objective than by this is better.
constexpr double kBetter = 1e-9;

/// `place` is what is wrong: a param, the objective, a fold.
Issue fault_of_learning(Severity severity, Code code, const std::string& place,
                        std::string sentence) {
  Issue issue;
  issue.place.file = place;
  issue.severity = severity;
  issue.code = code;
  issue.sentence = std::move(sentence);
  return issue;
}

/// The labels of the truth that count.
std::set<std::string> expected_labels(std::span<const Sample> samples,
                                      std::span<const std::size_t> numbers) {
  const ScoreOptions options;
  std::set<std::string> labels;
  for (const std::size_t number : numbers)
    for (const ExpectedObject& object : samples[number].truth)
      if (!is_left_out(object) &&
          std::ranges::find(options.not_scored, object.label) == options.not_scored.end())
        labels.insert(object.label);
  return labels;
}

std::string list_of_labels(const std::set<std::string>& labels) {
  return rules::join({labels.begin(), labels.end()});
}

std::vector<std::size_t> numbers_below(std::size_t count) {
  std::vector<std::size_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), std::size_t{0});
  return numbers;
}

std::vector<std::size_t> without_part(std::size_t count, const std::vector<std::size_t>& part) {
  std::vector<std::size_t> rest = numbers_below(count);
  std::erase_if(rest, [&](std::size_t n) { return std::ranges::find(part, n) != part.end(); });
  return rest;
}

/// The searches on all samples and outside each fold, from start to report.
class Learner {
 public:
  Learner(const RuleBase& rules, std::span<const Sample> samples,
          std::span<const std::vector<std::size_t>> parts, const LearnOptions& options,
          const ForEachShare& for_each)
      : parts_(parts),
        options_(options),
        set_(rules.pack(), samples, options.objective, for_each),
        base_(set_.setting()) {}

  Checked<Learnt> run() {
    find_faults();
    if (has_errors(issues_)) return {std::nullopt, std::move(issues_)};
    steps_ = (2 + static_cast<std::size_t>(std::max(0, options_.restarts))) + 3;
    learnt_.objective = options_.objective.name();
    learnt_.samples = set_.samples().size();
    learnt_.folds = parts_.size();
    std::vector<SearchRun> runs = search(free_);
    report_folds(runs);
    step();
    const std::vector<std::size_t> agreed = agreed_params(runs);
    std::vector<SearchRun> again =
        agreed.empty() ? std::vector<SearchRun>{} : search_again(runs, agreed);
    step();
    judge(again, runs);
    step();
    return {std::move(learnt_), std::move(issues_)};
  }

 private:
  void step() {
    if (options_.step) options_.step(std::min(done_, steps_), steps_);
    ++done_;
  }

  void find_faults() {
    const rules::Pack& pack = set_.pack();
    for (const std::string& name : options_.params) {
      const int param = rules::index_of(pack.params, name);
      const auto names = rules::names_of(pack.params);
      if (param < 0) {
        issues_.push_back(fault_of_learning(
            Severity::error, Code::R206, name,
            fmt::format("unknown param '{}'{}", name, rules::did_you_mean(name, names))));
      } else if (std::ranges::find(set_.params(), at(param)) == set_.params().end()) {
        issues_.push_back(
            fault_of_learning(Severity::error, Code::R206, name,
                              fmt::format("the param '{}' cannot be learnt: {}", name,
                                          pack.params[at(param)].range ? "no label depends on it"
                                                                       : "it has no range")));
      } else {
        free_.push_back(at(param));
      }
    }
    if (options_.params.empty()) free_ = set_.params();
    std::ranges::sort(free_);
    free_.erase(std::unique(free_.begin(), free_.end()), free_.end());
    check_classes();
    check_folds();
  }

  void check_classes() {
    const auto all = expected_labels(set_.samples(), numbers_below(set_.samples().size()));
    if (const std::string& label = options_.objective.label();
        !label.empty() && !all.contains(label))
      issues_.push_back(
          fault_of_learning(Severity::error, Code::R283, options_.objective.name(),
                            fmt::format("the truth has no {}, whose F1 is the objective; it has {}",
                                        label, all.empty() ? "nothing" : list_of_labels(all))));
    else if (all.empty())
      issues_.push_back(fault_of_learning(Severity::error, Code::R283, options_.objective.name(),
                                          "the truth has no object to learn from"));
  }

  void check_folds() {
    const std::size_t count = set_.samples().size();
    if (parts_.size() < 2 && count > 0 && (parts_.empty() || parts_[0].size() >= count))
      issues_.push_back(
          fault_of_learning(Severity::error, Code::R282, "folds",
                            fmt::format("nothing is left to learn from: there {} {}",
                                        agreeing(count, "is", "are"), counted(count, "building"))));
    const auto all = expected_labels(set_.samples(), numbers_below(count));
    const bool are_single =
        std::ranges::all_of(parts_, [](const auto& p) { return p.size() == 1; });
    for (std::size_t i = 0; i < parts_.size() && !are_single; ++i) {
      std::set<std::string> lacking = all;
      for (const std::string& label : expected_labels(set_.samples(), parts_[i]))
        lacking.erase(label);
      if (!lacking.empty())
        issues_.push_back(fault_of_learning(
            Severity::warning, Code::R285, fmt::format("fold {}", i + 1),
            fmt::format("it has no {}, which other folds have", list_of_labels(lacking))));
    }
  }

  /// One on all samples, and one for each fold, which begin at the pack's values.
  [[nodiscard]] std::vector<SearchRun> fresh_runs(const ParamSearch& search) const {
    std::vector<SearchRun> runs(parts_.size() + 1);
    runs[0].samples = numbers_below(set_.samples().size());
    for (std::size_t i = 0; i < parts_.size(); ++i)
      runs[i + 1].samples = without_part(set_.samples().size(), parts_[i]);
    for (SearchRun& run : runs) {
      run.at = base_;
      search.measure(run);
    }
    return runs;
  }

  std::vector<SearchRun> search(const std::vector<std::size_t>& free) {
    const ParamSearch search(set_, base_, options_.penalty, free);
    step();
    std::vector<SearchRun> best = fresh_runs(search);
    search.climb(best, kMostRoundsOfSearch);
    for (SearchRun& run : best) search.go_back(run);
    for (int restart = 0; restart < options_.restarts; ++restart) {
      step();
      begin_again(search, free, restart, best);
    }
    step();
    for (SearchRun& run : best) refine(search, free, run);
    return best;
  }

  /// From the best so far with some params moved at random, the same ones in each run.
  void begin_again(const ParamSearch& search, const std::vector<std::size_t>& free, int restart,
                   std::vector<SearchRun>& best) const {
    Random random(options_.seed, static_cast<std::uint64_t>(restart) + 1);
    std::map<std::size_t, double> moved;
    for (const std::size_t param : free) {
      const auto [low, high] = *set_.pack().params[param].range;
      const bool is_moved = random.chance(kMovedAtRestart);
      const double value = low + (high - low) * random.unit();
      if (is_moved) moved[param] = value;
    }
    std::vector<SearchRun> runs = best;
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
      if (search.score_of(runs[i]) > search.score_of(best[i]) + kBetter) best[i] = runs[i];
    }
  }

  /// The params that were changed are moved together; then each to the middle of its plateau.
  void refine(const ParamSearch& search, const std::vector<std::size_t>& free,
              SearchRun& run) const {
    std::vector<std::size_t> changed;
    for (const std::size_t param : free)
      if (run.at[param] != base_[param] && changed.size() < kMostJointParams)
        changed.push_back(param);
    SearchRun refined = run;
    search_jointly(set_, refined, changed, kMostJointMeasurements, options_.seed);
    if (refined.objective <= run.objective + kBetter) return;
    search.climb({&refined, 1}, 1);
    search.go_back(refined);
    if (search.score_of(refined) > search.score_of(run) + kBetter) run = std::move(refined);
  }

  [[nodiscard]] static int direction(double from, double to) {
    return to > from ? 1 : to < from ? -1 : 0;
  }
  [[nodiscard]] std::size_t folds_like(std::span<const SearchRun> runs, std::size_t param,
                                       double value) const {
    const int way = direction(base_[param], value);
    return static_cast<std::size_t>(std::ranges::count_if(
        runs.subspan(1),
        [&](const SearchRun& run) { return direction(base_[param], run.at[param]) == way; }));
  }

  void report_folds(std::span<const SearchRun> runs) {
    for (const SearchRun& run : runs.subspan(1)) {
      auto& changed = learnt_.by_fold.emplace_back();
      for (std::size_t param = 0; param < base_.size(); ++param)
        if (run.at[param] != base_[param])
          changed.push_back({set_.pack().params[param].name, run.at[param]});
    }
  }

  /// Those that were changed on all samples, and the same way in half of the folds.
  [[nodiscard]] std::vector<std::size_t> agreed_params(std::span<const SearchRun> runs) const {
    std::vector<std::size_t> agreed;
    for (std::size_t param = 0; param < base_.size(); ++param)
      if (runs[0].at[param] != base_[param] &&
          2 * folds_like(runs, param, runs[0].at[param]) >= parts_.size())
        agreed.push_back(param);
    return agreed;
  }

  /// Each run goes on from where it stands with the agreed params alone.
  [[nodiscard]] std::vector<SearchRun> search_again(std::span<const SearchRun> runs,
                                                    const std::vector<std::size_t>& agreed) const {
    const ParamSearch search(set_, base_, options_.penalty, agreed);
    std::vector<SearchRun> again = fresh_runs(search);
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

  /// The outcomes of all samples, each with what was learnt without it.
  [[nodiscard]] std::vector<LabelOutcome> held_out(std::span<const SearchRun> runs) const {
    std::vector<LabelOutcome> all(set_.samples().size());
    for (std::size_t i = 0; i < parts_.size(); ++i) {
      auto outcomes = set_.outcomes(runs[i + 1].at, parts_[i]);
      for (const std::size_t sample : parts_[i]) all[sample] = std::move(outcomes[sample]);
    }
    return all;
  }

  [[nodiscard]] std::vector<std::size_t> all_held_out() const {
    std::vector<std::size_t> all;
    for (const auto& part : parts_) all.insert(all.end(), part.begin(), part.end());
    std::ranges::sort(all);
    return all;
  }

  [[nodiscard]] std::map<std::string, ClassScore> classes_of(
      std::span<const LabelOutcome> outcomes, std::span<const std::size_t> samples) const {
    LabelOutcome sum;
    sum.counts.resize(set_.labels().size());
    for (const std::size_t sample : samples) sum.add(outcomes[sample]);
    std::map<std::string, ClassScore> classes;
    for (std::size_t i = 0; i < sum.counts.size(); ++i)
      if (!sum.counts[i].is_nothing()) classes[set_.labels().names()[i]] = sum.counts[i].score();
    return classes;
  }

  /// Where 95 % of the bootstrap samples have the difference of the objective.
  [[nodiscard]] ConfidenceInterval interval_of(std::span<const LabelOutcome> before,
                                               std::span<const LabelOutcome> after,
                                               const std::vector<std::size_t>& samples) const {
    Random random(options_.seed);
    std::vector<double> gains;
    std::vector<std::size_t> drawn(samples.size());
    for (std::size_t i = 0; i < options_.bootstrap; ++i) {
      for (std::size_t& one : drawn) one = samples[random.next() % samples.size()];
      gains.push_back(set_.value(after, drawn) - set_.value(before, drawn));
    }
    if (gains.empty()) return {std::nan(""), std::nan("")};
    std::ranges::sort(gains);
    const auto at_share = [&](double share) {
      return gains[static_cast<std::size_t>(share * static_cast<double>(gains.size() - 1) + 0.5)];
    };
    return {at_share(0.025), at_share(0.975)};
  }

  void judge(std::span<const SearchRun> again, std::span<const SearchRun> first) {
    const std::vector<std::size_t> all = numbers_below(set_.samples().size());
    const std::vector<std::size_t> held = all_held_out();
    const auto before = set_.outcomes(base_, all);
    learnt_.before = learnt_.after = set_.value(before, all);
    learnt_.held_out_before = learnt_.held_out_after = set_.value(before, held);
    learnt_.held_out_classes_before = learnt_.held_out_classes_after = classes_of(before, held);
    Setting at = base_;
    if (again.empty() || again[0].at == base_) {
      learnt_.reason = again.empty() && first[0].at != base_
                           ? "the folds do not agree which params to change"
                           : "no change of a param gains more than its penalty";
    } else {
      const auto after = held_out(again);
      const double value = set_.value(after, held);
      if (value > learnt_.held_out_before + kBetter) {
        at = again[0].at;
        learnt_.held_out_after = value;
        learnt_.held_out_gain = interval_of(before, after, held);
        learnt_.held_out_classes_after = classes_of(after, held);
        report_params(again, all);
      } else {
        learnt_.reason = fmt::format(
            "what was learnt is not better on held-out folds: {} is {:.4f} there, {:.4f} with the "
            "pack as it is",
            learnt_.objective, value, learnt_.held_out_before);
      }
    }
    learnt_.knife_edges = knife_edges(set_, at);
  }

  void report_params(std::span<const SearchRun> runs, const std::vector<std::size_t>& all) {
    const Setting& setting = runs[0].at;
    const auto after = set_.outcomes(setting, all);
    learnt_.after = set_.value(after, all);
    for (std::size_t param = 0; param < setting.size(); ++param) {
      if (setting[param] == base_[param]) continue;
      LearntParam& learnt = learnt_.params.emplace_back();
      learnt.value = {set_.pack().params[param].name, setting[param]};
      learnt.before = base_[param];
      learnt.folds = folds_like(runs, param, setting[param]);
      Setting without = setting;
      without[param] = base_[param];
      const auto back = set_.outcomes(without, all);
      learnt.gain = learnt_.after - set_.value(back, all);
      learnt.interval = interval_of(back, after, all);
    }
  }

  std::span<const std::vector<std::size_t>> parts_;
  const LearnOptions& options_;
  LearningSet set_;
  Setting base_;
  std::vector<std::size_t> free_;
  std::vector<Issue> issues_;
  Learnt learnt_;
  std::size_t done_ = 0, steps_ = 0;
};

}  // namespace

Checked<Learnt> learn_params(const RuleBase& rules, std::span<const Sample> samples,
                             std::span<const std::vector<std::size_t>> parts,
                             const LearnOptions& options, const ForEachShare& for_each) {
  return Learner(rules, samples, parts, options, for_each).run();
}

std::vector<std::vector<std::size_t>> folds_of(std::size_t samples, std::size_t folds,
                                               std::uint64_t seed) {
  std::vector<std::size_t> all = numbers_below(samples);
  std::vector<std::vector<std::size_t>> parts;
  if (folds == 0) {
    for (const std::size_t sample : all) parts.push_back({sample});
    return parts;
  }
  Random(seed).shuffle(all);
  parts.resize(std::min(folds, samples));
  for (std::size_t i = 0; i < all.size(); ++i) parts[i % parts.size()].push_back(all[i]);
  for (auto& part : parts) std::ranges::sort(part);
  return parts;
}

}  // namespace oriel
