#include "interpret/experiment/learn/learning_set.h"

#include "interpret/experiment/relabelling.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <utility>

namespace oriel {

namespace {

/// Values closer than this share of the range to each other are one.
constexpr double kSameValue = 1e-9;
/// Where scores change with a param, flips are looked for on so many stretches, and found as
/// exactly as this share of the range.
constexpr int kGradualStretches = 16;
constexpr double kSharpFlip = 1e-4;

/// Samples that are worked on in one piece.
constexpr std::size_t kSamplesInShare = 4;

}  // namespace

/// Copies of the pack that one thread may change: one at a setting, one with a param besides.
struct LearningSet::Worker {
  explicit Worker(const rules::Pack& pack) : at(pack), varied(pack) {}

  void set(const Setting& setting) {
    for (std::size_t param = 0; param < setting.size(); ++param) {
      if (at.pack().params[param].value == setting[param]) continue;
      at.set(param, setting[param]);
      varied.set(param, setting[param]);
    }
  }

  rules::SettablePack at, varied;
};

LearningSet::LearningSet(const rules::Pack& pack, std::span<const Sample> samples,
                         Objective objective, const ForEachShare& for_each,
                         const ScoreOptions& options)
    : pack_(pack),
      samples_(samples),
      objective_(std::move(objective)),
      for_each_(for_each),
      turns_(pack.params.size()),
      affected_(pack.params.size()) {
  std::vector<std::string> names;
  for (const rules::Class& c : pack.classes)
    if (!c.is_abstract) names.push_back(c.name);
  labels_.add(names);
  for (const Sample& sample : samples) labels_.add(sample.truth);
  for (const rules::Class& c : pack.classes) label_of_class_.push_back(labels_.find(c.name));
  for (const Sample& sample : samples) counters_.emplace_back(sample, labels_, options);
  uses_ = std::make_unique<rules::RuleUses>(pack_.pack());
  for (std::size_t param = 0; param < pack.params.size(); ++param) {
    affected_[param] = uses_->affected_by({{{param, 0.0}}, {}});
    const auto& range = pack.params[param].range;
    const bool is_idle = affected_[param].rules.empty() && !affected_[param].decides_anew;
    if (is_idle || !range || range->first == range->second) continue;
    params_.push_back(param);
    turns_[param] = rules::find_turns(pack_.pack(), param);
  }
}

LearningSet::~LearningSet() = default;

Setting LearningSet::setting() const {
  Setting setting;
  for (const rules::Param& param : pack().params) setting.push_back(param.value);
  return setting;
}

bool LearningSet::is_sound(const Setting& setting) const {
  Worker worker(pack());
  worker.set(setting);
  return !worker.at.find_fault();
}

void LearningSet::for_each_sample(std::span<const std::size_t> samples, const Setting& setting,
                                  const std::function<void(std::size_t, Worker&)>& work) const {
  const std::size_t shares = (samples.size() + kSamplesInShare - 1) / kSamplesInShare;
  for_each_(shares, [&](std::size_t share) {
    std::unique_ptr<Worker> worker;
    {
      const std::scoped_lock lock(mutex_);
      if (!idle_.empty()) {
        worker = std::move(idle_.back());
        idle_.pop_back();
      }
    }
    if (!worker) worker = std::make_unique<Worker>(pack());
    worker->set(setting);
    const std::size_t begin = share * kSamplesInShare;
    for (const std::size_t sample :
         samples.subspan(begin, std::min(kSamplesInShare, samples.size() - begin)))
      work(sample, *worker);
    const std::scoped_lock lock(mutex_);
    idle_.push_back(std::move(worker));
  });
}

LabelOutcome LearningSet::outcome_of(std::size_t sample,
                                     std::span<const rules::Choice> choices) const {
  std::vector<int> labels;
  labels.reserve(choices.size());
  for (const rules::Choice& choice : choices) {
    const rules::ClassId id = rules::Relabelling::label_of(pack(), choice);
    labels.push_back(id == rules::kNoClass ? LabelSet::kNone : label_of_class_[at(id)]);
  }
  LabelOutcome outcome;
  outcome.counts.resize(labels_.size());
  counters_[sample].count(labels, outcome.counts);
  outcome.cost = objective_.cost_of(counters_[sample], labels, labels_);
  return outcome;
}

std::vector<LabelOutcome> LearningSet::outcomes(const Setting& setting,
                                                std::span<const std::size_t> samples) const {
  std::vector<LabelOutcome> outcomes(samples_.size());
  for_each_sample(samples, setting, [&](std::size_t sample, Worker& worker) {
    const DescribedBuilding& building = samples_[sample].features;
    const rules::Pack& pack = worker.at.pack();
    rules::EvaluationContext context(pack, building.table, building.graph);
    outcomes[sample] = outcome_of(sample, rules::Labelling(pack, context).run());
  });
  return outcomes;
}

double LearningSet::value(std::span<const LabelOutcome> outcomes,
                          std::span<const std::size_t> samples) const {
  LabelOutcome sum;
  sum.counts.resize(labels_.size());
  for (const std::size_t sample : samples) sum.add(outcomes[sample]);
  return value(sum);
}

/// Follows one building along the range of a param.
class CurveTracer {
 public:
  CurveTracer(const LearningSet& set, std::size_t sample, std::size_t param,
              LearningSet::Worker& worker)
      : set_(set),
        sample_(sample),
        param_(param),
        worker_(worker),
        range_(*set.pack().params[param].range),
        relabelling_(worker.at.pack(), *set.uses_, set.samples_[sample].features.table,
                     set.samples_[sample].features.graph) {}

  ParamCurve run() {
    curve_.at_value = set_.outcome_of(sample_, relabelling_.choices());
    const rules::ParamTurns& turns = set_.turns_[param_];
    const auto bounds = find_bounds(turns);
    for (std::size_t i = 0; i + 1 < bounds.size(); ++i)
      if (turns.is_gradual)
        trace_gradual(bounds[i], bounds[i + 1]);
      else
        add(bounds[i], outcome_at((bounds[i] + bounds[i + 1]) / 2));
    worker_.varied.set(param_, worker_.at.pack().params[param_].value);
    return std::move(curve_);
  }

 private:
  [[nodiscard]] double width() const { return range_.second - range_.first; }

  /// The ends of the range and what turns between them.
  std::vector<double> find_bounds(const rules::ParamTurns& turns) {
    std::vector<double> values =
        rules::turning_values(worker_.varied.pack(), relabelling_.context(), param_, turns);
    values.push_back(range_.first);
    values.push_back(range_.second);
    if (turns.is_gradual)
      for (int i = 1; i < kGradualStretches; ++i)
        values.push_back(range_.first + width() * i / kGradualStretches);
    std::ranges::sort(values);
    std::vector<double> bounds;
    for (const double value : values)
      if (bounds.empty() || value - bounds.back() > kSameValue * width()) bounds.push_back(value);
    return bounds;
  }

  const LabelOutcome& outcome_at(double value) {
    worker_.varied.set(param_, value);
    const auto& choices = relabelling_.choices(worker_.varied.pack(), set_.affected_[param_]);
    std::vector<int> rules;
    rules.reserve(choices.size());
    for (const rules::Choice& choice : choices) rules.push_back(choice.rule);
    if (rules != last_rules_ || last_rules_.empty()) {
      last_ = set_.outcome_of(sample_, choices);
      last_rules_ = std::move(rules);
    }
    return last_;
  }

  void add(double from, const LabelOutcome& outcome) {
    if (curve_.pieces.empty() || curve_.pieces.back().outcome != outcome)
      curve_.pieces.push_back({from, outcome});
  }

  /// Between places where something turns scores change steadily: labels flip where they meet.
  void trace_gradual(double from, double to) {
    const double inside = std::min(kSharpFlip * width(), (to - from) / 4);
    const LabelOutcome first = outcome_at(from + inside), last = outcome_at(to - inside);
    add(from, first);
    halve(from + inside, first, to - inside, last);
  }

  void halve(double low, const LabelOutcome& at_low, double high, const LabelOutcome& at_high) {
    if (at_low == at_high) return;
    if (high - low <= kSharpFlip * width()) return add((low + high) / 2, at_high);
    const double middle = (low + high) / 2;
    const LabelOutcome at_middle = outcome_at(middle);
    halve(low, at_low, middle, at_middle);
    halve(middle, at_middle, high, at_high);
  }

  const LearningSet& set_;
  std::size_t sample_;
  std::size_t param_;
  LearningSet::Worker& worker_;
  std::pair<double, double> range_;
  rules::Relabelling relabelling_;
  ParamCurve curve_;
  std::vector<int> last_rules_;
  LabelOutcome last_;
};

std::vector<ParamCurve> LearningSet::curves(const Setting& setting, std::size_t param,
                                            std::span<const std::size_t> samples) const {
  std::vector<ParamCurve> curves(samples_.size());
  for_each_sample(samples, setting, [&](std::size_t sample, Worker& worker) {
    curves[sample] = CurveTracer(*this, sample, param, worker).run();
  });
  return curves;
}

}  // namespace oriel
