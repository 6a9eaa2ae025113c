#include "interpret/learn/learn_params.h"

#include "interpret/language/quantity.h"
#include "interpret/learn/learning_set.h"
#include "interpret/learn/search/param_fit.h"
#include "interpret/pack/names.h"
#include "kernel/base/index.h"
#include "kernel/base/random.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// What a small change of a param is: so much of its range or of its value, whichever is more.
constexpr double kSmallShareOfRange = 0.02;
constexpr double kSmallShareOfValue = 0.05;

/// How many true objects are found in one of two outcomes and not in the other, at least.
std::size_t objects_between(const LabelOutcome& p, const LabelOutcome& q) {
  std::size_t sum = 0;
  for (std::size_t i = 0; i < p.counts.size(); ++i) {
    const auto found = static_cast<long>(p.counts[i].true_positives);
    sum +=
        static_cast<std::size_t>(std::abs(found - static_cast<long>(q.counts[i].true_positives)));
  }
  return sum;
}

class EdgeFinder {
 public:
  EdgeFinder(const LearningSet& set, const Setting& setting)
      : set_(set), setting_(setting), all_(set.samples().size()) {
    std::iota(all_.begin(), all_.end(), std::size_t{0});
  }

  std::optional<KnifeEdge> edge_of(std::size_t param, double least_change) {
    const rules::Param& said = set_.pack().params[param];
    const auto [low, high] = *said.range;
    const double value = setting_[param];
    const double reach =
        std::max(kSmallShareOfRange * (high - low), kSmallShareOfValue * std::abs(value));
    const auto curves = set_.curves(setting_, param, all_);
    if (set_.is_given_up()) return std::nullopt;
    std::vector<const ParamCurve*> of;
    LabelOutcome here;
    for (const ParamCurve& curve : curves) {
      of.push_back(&curve);
      here.add(curve.at_value);
    }
    const double objective = set_.value(here);
    KnifeEdge edge{said.name, rules::unit_of(said.dimension), value, 0, 1, 0, 0};
    for (const CurveStretch& stretch : sum_of(of, low, high)) {
      if (stretch.from > value + reach || stretch.to < value - reach) continue;
      const double change = set_.value(stretch.sum) - objective;
      if (std::abs(change) < least_change) continue;
      const double flip = std::clamp(value, stretch.from, stretch.to);
      const double share = std::abs(flip - value) / (high - low);
      if (share < edge.distance_share) {
        edge.flip = flip;
        edge.distance_share = share;
      }
      if (std::abs(change) <= std::abs(edge.change)) continue;
      edge.change = change;
      edge.objects = objects_between(here, stretch.sum);
    }
    return edge.change == 0 ? std::nullopt : std::optional(edge);
  }

 private:
  const LearningSet& set_;
  const Setting& setting_;
  std::vector<std::size_t> all_;
};

/// The knife edges of a setting on all samples: params that change the objective by at least
/// `least_change` with a small change, the largest change first.
std::vector<KnifeEdge> knife_edges(const LearningSet& set, const Setting& setting,
                                   double least_change = 0.005) {
  std::vector<KnifeEdge> edges;
  EdgeFinder finder(set, setting);
  for (const std::size_t param : set.params())
    if (auto edge = finder.edge_of(param, least_change)) edges.push_back(std::move(*edge));
  std::ranges::sort(edges, {},
                    [](const KnifeEdge& e) { return std::tuple(-std::abs(e.change), e.param); });
  return edges;
}

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
  return join({labels.begin(), labels.end()});
}

/// From what is asked to what is reported.
class Learner {
 public:
  Learner(const RuleBase& rules, std::span<const Sample> samples, std::span<const SamplePart> parts,
          const LearnOptions& options, const ForEachShare& for_each,
          const IsGivenUp& is_given_up = nullptr)
      : parts_(parts.begin(), parts.end()),
        options_(options),
        set_(rules, samples, options.objective, for_each, {}, is_given_up),
        base_(set_.setting()),
        all_(all_samples(samples.size())) {}

  Checked<Learnt> run() {
    find_params();
    check_classes();
    check_folds();
    if (has_errors(issues_)) return {std::nullopt, std::move(issues_)};
    learnt_.objective = options_.objective.name();
    learnt_.samples = all_.size();
    learnt_.folds = parts_.size();
    const ParamFitter fitter = this->fitter();
    step();
    const ParamFit fit = fitter.fit(all_, parts_);
    for (const Setting& setting : fit.searched) learnt_.by_fold.push_back(changes_of(setting));
    std::vector<Setting> without;
    for (const SamplePart& part : parts_) {
      if (set_.is_given_up()) return {};
      step();
      without.push_back(fit_on(fitter, outside(part, all_)));
      learnt_.learnt_without.push_back(changes_of(without.back()));
    }
    judge(fitter, fit, held_out_outcomes(set_, parts_, without));
    if (set_.is_given_up()) return {};
    return {std::move(learnt_), std::move(issues_)};
  }

  Checked<std::vector<ParamValue>> fit() {
    find_params();
    if (has_errors(issues_)) return {std::nullopt, std::move(issues_)};
    return {changes_of(fit_on(fitter(), all_)), std::move(issues_)};
  }

 private:
  void step() {
    if (options_.step) options_.step(done_++, parts_.size() + 1);
  }

  void find_params() {
    const rules::Pack& pack = set_.pack();
    for (const std::string& name : options_.params) {
      const int param = rules::index_of(pack.params, name);
      const auto names = rules::names_of(pack.params);
      if (param < 0) {
        issues_.push_back(fault_of_learning(
            Severity::error, Code::R206, name,
            fmt::format("unknown param '{}'{}", name, did_you_mean(name, names))));
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
  }

  void check_classes() {
    const auto all = expected_labels(set_.samples(), all_);
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
    const auto all = expected_labels(set_.samples(), all_);
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

  [[nodiscard]] ParamFitter fitter() const {
    return {set_, free_, options_.penalty, options_.restarts, options_.seed};
  }

  /// By folds of these samples alone.
  [[nodiscard]] Setting fit_on(const ParamFitter& fitter, const SamplePart& samples) const {
    if (samples.size() < 2) return base_;
    auto parts = folds_of(samples.size(), std::min(kInnerFolds, samples.size()), options_.seed);
    for (SamplePart& part : parts)
      for (std::size_t& number : part) number = samples[number];
    return fitter.fit(samples, parts).at;
  }

  [[nodiscard]] std::vector<ParamValue> changes_of(const Setting& setting) const {
    std::vector<ParamValue> changes;
    for (std::size_t param = 0; param < base_.size(); ++param)
      if (setting[param] != base_[param])
        changes.push_back({set_.pack().params[param].name, setting[param]});
    return changes;
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
                                               const SamplePart& samples) const {
    Random random(options_.seed);
    std::vector<double> gains;
    SamplePart drawn(samples.size());
    for (std::size_t i = 0; i < options_.bootstrap; ++i) {
      for (std::size_t& one : drawn) one = samples[random.next() % samples.size()];
      gains.push_back(set_.value(after, drawn) - set_.value(before, drawn));
    }
    return middle_of(std::move(gains));
  }

  /// `held_out` is what the parts come to, each with what was learnt without it.
  void judge(const ParamFitter& fitter, const ParamFit& fit,
             std::span<const LabelOutcome> held_out) {
    const SamplePart held = samples_of_parts(parts_);
    const auto before = set_.outcomes(base_, all_);
    learnt_.before = learnt_.after = set_.value(before, all_);
    learnt_.held_out_before = learnt_.held_out_after = set_.value(before, held);
    learnt_.held_out_classes_before = learnt_.held_out_classes_after = classes_of(before, held);
    learnt_.reason = fit.reason;
    const double value = set_.value(held_out, held);
    if (fit.reason.empty() && value <= learnt_.held_out_before + kLeastGain)
      learnt_.reason = fmt::format(
          "learnt anew without each fold it is not better there: {} is {:.4f}, {:.4f} with the "
          "pack as it is",
          learnt_.objective, value, learnt_.held_out_before);
    const bool is_better = learnt_.reason.empty();
    if (is_better) {
      learnt_.held_out_after = value;
      learnt_.held_out_gain = interval_of(before, held_out, held);
      learnt_.held_out_classes_after = classes_of(held_out, held);
      report_params(fitter, fit);
    }
    learnt_.knife_edges = knife_edges(set_, is_better ? fit.at : base_);
  }

  void report_params(const ParamFitter& fitter, const ParamFit& fit) {
    const auto after = set_.outcomes(fit.at, all_);
    learnt_.after = set_.value(after, all_);
    for (std::size_t param = 0; param < fit.at.size(); ++param) {
      if (fit.at[param] == base_[param]) continue;
      LearntParam& learnt = learnt_.params.emplace_back();
      learnt.value = {set_.pack().params[param].name, fit.at[param]};
      learnt.before = base_[param];
      learnt.folds = fitter.count_like(fit.agreed, param, fit.at[param]);
      Setting without = fit.at;
      without[param] = base_[param];
      const auto back = set_.outcomes(without, all_);
      learnt.gain = learnt_.after - set_.value(back, all_);
      learnt.interval = interval_of(back, after, all_);
    }
  }

  std::vector<SamplePart> parts_;
  const LearnOptions& options_;
  LearningSet set_;
  Setting base_;
  SamplePart all_;
  std::vector<std::size_t> free_;
  std::vector<Issue> issues_;
  Learnt learnt_;
  std::size_t done_ = 0;
};

}  // namespace

Checked<Learnt> learn_params(const RuleBase& rules, std::span<const Sample> samples,
                             std::span<const SamplePart> parts, const LearnOptions& options,
                             const ForEachShare& for_each, const IsGivenUp& is_given_up) {
  return Learner(rules, samples, parts, options, for_each, is_given_up).run();
}

Checked<std::vector<ParamValue>> fit_params(const RuleBase& rules, std::span<const Sample> samples,
                                            const LearnOptions& options,
                                            const ForEachShare& for_each) {
  return Learner(rules, samples, {}, options, for_each).fit();
}

}  // namespace oriel
