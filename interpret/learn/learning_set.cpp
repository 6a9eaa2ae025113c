#include "interpret/learn/learning_set.h"

#include "interpret/params/find_fault.h"
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

/// Of all samples together so many labellings are kept, of some 100 kB, and so many curves and
/// outcomes, of some 500 bytes; and so many settings.
constexpr std::size_t kMostLabelled = 240;
constexpr std::size_t kMostKnown = 200'000;
constexpr std::size_t kLeastKnown = 64;
constexpr std::size_t kMostSettings = 256;

/// Of each sample.
std::size_t most_known(std::size_t samples) { return std::max(kLeastKnown, kMostKnown / samples); }

}  // namespace

/// A setting that was asked for.
struct LearningSet::KnownSetting {
  std::size_t number;
  rules::PackValues values;
};

/// What is known of one sample, by the number of the setting; of curves by that of the param, too.
struct LearningSet::KnownOfSample {
  /// Labelled at a setting.
  struct Labelled {
    std::shared_ptr<const KnownSetting> setting;
    std::unique_ptr<rules::Relabelling> relabelling;
  };

  std::map<std::size_t, LabelOutcome> outcomes;
  std::map<std::pair<std::size_t, std::size_t>, ParamCurve> curves;
  /// The last was used last.
  std::vector<Labelled> labelled;
};

LearningSet::LearningSet(const RuleBase& rules, std::span<const Sample> samples,
                         Objective objective, const ForEachShare& for_each,
                         const ScoreOptions& options, IsGivenUp is_given_up)
    : pack_(rules.pack()),
      setting_(rules.values().params),
      samples_(samples),
      objective_(std::move(objective)),
      for_each_(for_each),
      is_given_up_(for_good(std::move(is_given_up))),
      turns_(pack_.params.size()),
      affected_(pack_.params.size()),
      known_(samples.size()) {
  std::vector<std::string> names;
  for (const rules::Class& c : pack_.classes)
    if (!c.is_abstract) names.push_back(c.name);
  labels_.add(names);
  for (const Sample& sample : samples) labels_.add(sample.truth);
  for (const rules::Class& c : pack_.classes) label_of_class_.push_back(labels_.find(c.name));
  for (const Sample& sample : samples) counters_.emplace_back(sample, labels_, options);
  uses_ = std::make_unique<rules::RuleUses>(pack_);
  for (std::size_t param = 0; param < pack_.params.size(); ++param) {
    affected_[param] = uses_->affected_by({&param, 1});
    const auto& range = pack_.params[param].range;
    const bool is_idle = affected_[param].rules.empty() && !affected_[param].decides_anew;
    if (is_idle || !range || range->first == range->second) continue;
    params_.push_back(param);
    turns_[param] = rules::find_turns(pack_, param);
  }
}

LearningSet::~LearningSet() = default;

std::shared_ptr<LearningSet::KnownSetting> LearningSet::known_setting(
    const Setting& setting) const {
  if (settings_.size() >= kMostSettings) settings_.clear();
  auto& known = settings_[setting];
  if (!known)
    known = std::make_shared<KnownSetting>(
        KnownSetting{next_setting_++, rules::PackValues(pack_, setting)});
  return known;
}

bool LearningSet::is_sound(const Setting& setting) const {
  return !rules::find_fault(pack_, known_setting(setting)->values);
}

void LearningSet::for_each_sample(std::span<const std::size_t> samples,
                                  const std::function<void(std::size_t)>& work) const {
  const std::size_t shares = (samples.size() + kSamplesInShare - 1) / kSamplesInShare;
  for_each_(shares, [&](std::size_t share) {
    if (is_given_up()) return;
    const std::size_t begin = share * kSamplesInShare;
    for (const std::size_t sample :
         samples.subspan(begin, std::min(kSamplesInShare, samples.size() - begin)))
      work(sample);
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
  const auto asked = known_setting(setting);
  for_each_sample(samples, [&](std::size_t sample) {
    auto& known = known_[sample].outcomes;
    if (const auto found = known.find(asked->number); found != known.end()) {
      outcomes[sample] = found->second;
      return;
    }
    const DescribedBuilding& building = samples_[sample].features;
    rules::EvaluationContext context(pack_, asked->values, building.table, building.graph);
    outcomes[sample] = outcome_of(sample, rules::Labelling(pack_, context).run());
    if (known.size() >= most_known(samples_.size())) known.clear();
    known.emplace(asked->number, outcomes[sample]);
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
  /// `relabelling` was labelled with `values`.
  CurveTracer(const LearningSet& set, std::size_t sample, std::size_t param,
              const rules::PackValues& values, rules::Relabelling& relabelling)
      : set_(set),
        sample_(sample),
        param_(param),
        values_(values),
        range_(*set.pack().params[param].range),
        relabelling_(relabelling) {}

  ParamCurve run() {
    curve_.at_value = set_.outcome_of(sample_, relabelling_.choices());
    const rules::ParamTurns& turns = set_.turns_[param_];
    const auto bounds = find_bounds(turns);
    for (std::size_t i = 0; i + 1 < bounds.size(); ++i)
      if (turns.is_gradual)
        trace_gradual(bounds[i], bounds[i + 1]);
      else
        add(bounds[i], outcome_at((bounds[i] + bounds[i + 1]) / 2));
    return std::move(curve_);
  }

 private:
  [[nodiscard]] double width() const { return range_.second - range_.first; }

  /// The ends of the range and what turns between them.
  std::vector<double> find_bounds(const rules::ParamTurns& turns) {
    auto [values, others] =
        rules::turning_points(set_.pack_, relabelling_.context(), param_, turns, -1);
    values.insert(values.end(), others.begin(), others.end());
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
    values_.set(set_.pack_, param_, value);
    const auto& choices = relabelling_.choices(set_.pack_, values_, set_.affected_[param_]);
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
  /// With the param where it was asked last.
  rules::PackValues values_;
  std::pair<double, double> range_;
  rules::Relabelling& relabelling_;
  ParamCurve curve_;
  std::vector<int> last_rules_;
  LabelOutcome last_;
};

rules::Relabelling& LearningSet::labelled(std::size_t sample,
                                          const std::shared_ptr<const KnownSetting>& at) const {
  auto& labelled = known_[sample].labelled;
  const auto found =
      std::ranges::find(labelled, at.get(), [](const auto& l) { return l.setting.get(); });
  if (found != labelled.end()) {
    std::rotate(found, found + 1, labelled.end());
    return *labelled.back().relabelling;
  }
  if (!labelled.empty() && labelled.size() >= kMostLabelled / samples_.size())
    labelled.erase(labelled.begin());
  const DescribedBuilding& building = samples_[sample].features;
  labelled.push_back({at, std::make_unique<rules::Relabelling>(pack_, at->values, *uses_,
                                                               building.table, building.graph)});
  return *labelled.back().relabelling;
}

std::vector<ParamCurve> LearningSet::curves(const Setting& setting, std::size_t param,
                                            std::span<const std::size_t> samples) const {
  std::vector<ParamCurve> curves(samples_.size());
  const std::shared_ptr<const KnownSetting> asked = known_setting(setting);
  for_each_sample(samples, [&](std::size_t sample) {
    auto& known = known_[sample].curves;
    const std::pair key(asked->number, param);
    if (const auto found = known.find(key); found != known.end()) {
      curves[sample] = found->second;
      return;
    }
    curves[sample] =
        CurveTracer(*this, sample, param, asked->values, labelled(sample, asked)).run();
    if (known.size() >= most_known(samples_.size())) known.clear();
    known.emplace(key, curves[sample]);
  });
  return curves;
}

}  // namespace oriel
