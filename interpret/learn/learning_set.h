#pragma once

#include "interpret/explain/turning_points.h"
#include "interpret/learn/label_counter.h"
#include "interpret/learn/objective.h"
#include "interpret/learn/sample.h"
#include "interpret/learn/search/param_curve.h"
#include "interpret/pack/pack.h"
#include "interpret/pack/rule_base.h"
#include "interpret/relabelling/relabelling.h"
#include "interpret/relabelling/rule_uses.h"
#include "interpret/score/score.h"
#include "kernel/base/parallel.h"

#include <cstddef>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <vector>

namespace oriel {

/// The values of all params of a pack, in its order.
using Setting = std::vector<double>;

/// Samples on which a pack is measured at many settings of its params. What a sample comes to at a
/// setting is known once it was found: folds, and folds within folds, begin at the same settings.
/// One thread at a time may ask. Once it is given up nothing more is measured: outcomes stay empty.
class LearningSet {
 public:
  LearningSet(const RuleBase& rules, std::span<const Sample> samples, Objective objective,
              const ForEachShare& for_each, const ScoreOptions& options = {},
              IsGivenUp is_given_up = nullptr);
  ~LearningSet();
  LearningSet(const LearningSet&) = delete;
  LearningSet& operator=(const LearningSet&) = delete;

  [[nodiscard]] const rules::Pack& pack() const { return pack_; }
  [[nodiscard]] std::span<const Sample> samples() const { return samples_; }
  [[nodiscard]] const LabelSet& labels() const { return labels_; }
  [[nodiscard]] const Objective& objective() const { return objective_; }
  /// The params that have a range and that a label can depend on, ascending.
  [[nodiscard]] const std::vector<std::size_t>& params() const { return params_; }
  /// The pack's own values.
  [[nodiscard]] const Setting& setting() const { return setting_; }

  [[nodiscard]] bool is_given_up() const { return is_given_up_(); }
  /// False if the pack would be refused with these values.
  [[nodiscard]] bool is_sound(const Setting& setting) const;

  /// The outcome of each of these samples at a setting; others stay empty.
  [[nodiscard]] std::vector<LabelOutcome> outcomes(const Setting& setting,
                                                   std::span<const std::size_t> samples) const;
  /// Their curves over one of params(), the others at the setting; others stay empty.
  [[nodiscard]] std::vector<ParamCurve> curves(const Setting& setting, std::size_t param,
                                               std::span<const std::size_t> samples) const;

  [[nodiscard]] double value(const LabelOutcome& sum) const {
    return objective_.value(sum.counts, sum.cost, labels_);
  }
  /// The objective of these samples together, of their outcomes.
  [[nodiscard]] double value(std::span<const LabelOutcome> outcomes,
                             std::span<const std::size_t> samples) const;

 private:
  struct KnownSetting;
  struct KnownOfSample;
  friend class CurveTracer;

  [[nodiscard]] LabelOutcome outcome_of(std::size_t sample,
                                        std::span<const rules::Choice> choices) const;
  [[nodiscard]] std::shared_ptr<KnownSetting> known_setting(const Setting& setting) const;
  void for_each_sample(std::span<const std::size_t> samples,
                       const std::function<void(std::size_t)>& work) const;
  [[nodiscard]] rules::Relabelling& labelled(std::size_t sample,
                                             const std::shared_ptr<const KnownSetting>& at) const;

  /// With the expressions that turning points need.
  rules::Pack pack_;
  Setting setting_;
  std::span<const Sample> samples_;
  Objective objective_;
  const ForEachShare& for_each_;
  IsGivenUp is_given_up_;
  LabelSet labels_;
  std::vector<int> label_of_class_;
  std::vector<std::size_t> params_;
  /// By param: what turns with it, if it is one of params_, and which rules it affects.
  std::vector<rules::ParamTurns> turns_;
  std::vector<rules::RuleUses::Affected> affected_;
  std::unique_ptr<rules::RuleUses> uses_;
  /// By sample; one thread at a time works on one of them.
  mutable std::vector<LabelCounter> counters_;
  mutable std::vector<KnownOfSample> known_;
  /// Settings that were asked for, and the next number of one.
  mutable std::map<Setting, std::shared_ptr<KnownSetting>> settings_;
  mutable std::size_t next_setting_ = 0;
};

}  // namespace oriel
