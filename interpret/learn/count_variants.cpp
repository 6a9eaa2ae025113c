#include "interpret/learn/count_variants.h"

#include "interpret/pack/pack.h"
#include "interpret/relabelling/relabelling.h"
#include "interpret/relabelling/rule_uses.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace oriel {

namespace {

using rules::Ablation;
using rules::RuleUses;

/// Samples that are counted in one piece with one copy of the pack: so many, unless there are few.
constexpr std::size_t kMostInShare = 16;
constexpr std::size_t kLeastShares = 16;

LabelSet labels_of(const RuleBase& rules, std::span<const Sample> samples) {
  LabelSet labels;
  labels.add(rules.labels());
  for (const Sample& sample : samples) labels.add(sample.truth);
  return labels;
}

/// The rules with the params of each variant; what is wrong with one is at its name.
std::vector<RuleBase> set_each(const RuleBase& rules, std::span<const Variant> variants,
                               std::vector<Issue>& issues) {
  std::vector<RuleBase> all;
  for (const Variant& variant : variants) {
    auto set = with_params(rules, std::span(variant.params));
    if (set.value) all.push_back(std::move(*set.value));
    for (Issue& issue : set.issues) {
      issue.place.file = variant.name;
      issues.push_back(std::move(issue));
    }
  }
  return all;
}

}  // namespace

VariantCounts::VariantCounts(std::size_t variants, std::span<const Sample> samples, LabelSet labels,
                             bool keeps_labels)
    : variants_(variants), labels_(std::move(labels)) {
  for (const Sample& sample : samples) {
    object_begin_.push_back(object_begin_.back() + sample.truth.size());
    row_begin_.push_back(row_begin_.back() + sample.features.table.rows());
  }
  counts_.resize(variants * samples.size() * labels_.size());
  found_.resize(variants * objects());
  if (keeps_labels) label_of_row_.resize(variants * row_begin_.back(), LabelSet::kNone);
}

std::map<std::string, ClassScore> VariantCounts::total(std::size_t variant,
                                                       std::span<const std::size_t> samples) const {
  std::map<std::string, ClassScore> classes;
  for (std::size_t label = 0; label < labels_.size(); ++label) {
    ClassScore sum;
    for (const std::size_t sample : samples) sum += counts(variant, sample)[label].score();
    if (sum.true_positives + sum.false_positives + sum.false_negatives > 0)
      classes[labels_.names()[label]] = sum;
  }
  return classes;
}

std::map<std::string, ClassScore> VariantCounts::total(std::size_t variant) const {
  std::vector<std::size_t> all(samples());
  std::iota(all.begin(), all.end(), std::size_t{0});
  return total(variant, all);
}

double macro_f1(const std::map<std::string, ClassScore>& classes) {
  Score score;
  score.classes = classes;
  return score.macro_f1();
}

/// Fills counts, a share of the samples at a time.
class VariantCounter {
 public:
  /// `set` are the rules with the params of each variant.
  VariantCounter(const RuleBase& rules, std::vector<RuleBase> set,
                 std::span<const Variant> variants, std::span<const Sample> samples,
                 const ScoreOptions& options, bool keeps_labels)
      : pack_(rules.pack()),
        variants_(variants),
        rules_(rules),
        set_(std::move(set)),
        samples_(samples),
        options_(options),
        uses_(pack_),
        counts_(variants.size(), samples, labels_of(rules, samples), keeps_labels) {
    for (std::size_t variant = 0; variant < variants.size(); ++variant) {
      std::vector<std::size_t> changed;
      for (std::size_t param = 0; param < pack_.params.size(); ++param)
        if (set_[variant].values().params[param] != rules.values().params[param])
          changed.push_back(param);
      affected_.push_back(uses_.affected_by(changed, variants[variant].without));
    }
    for (const rules::Class& c : pack_.classes)
      label_of_class_.push_back(counts_.labels_.find(c.name));
  }

  VariantCounts run(const ForEachShare& for_each) {
    const std::size_t share =
        std::clamp<std::size_t>(samples_.size() / kLeastShares, 1, kMostInShare);
    for_each((samples_.size() + share - 1) / share, [&](std::size_t number) {
      Ablation pack(pack_);
      const std::size_t end = std::min(samples_.size(), (number + 1) * share);
      for (std::size_t sample = number * share; sample < end; ++sample) count(sample, pack);
    });
    return std::move(counts_);
  }

 private:
  void count(std::size_t number, Ablation& ablation) {
    const Sample& sample = samples_[number];
    rules::Relabelling relabelling(pack_, rules_.values(), uses_, sample.features.table,
                                   sample.features.graph);
    LabelCounter counter(sample, counts_.labels_, options_);
    for (std::size_t variant = 0; variant < variants_.size(); ++variant) {
      const rules::Pack& pack = ablation.without(variants_[variant].without);
      count(variant, number, relabelling.choices(pack, set_[variant].values(), affected_[variant]),
            counter);
    }
  }

  void count(std::size_t variant, std::size_t sample, std::span<const rules::Choice> choices,
             LabelCounter& counter) {
    std::vector<int> labels;
    labels.reserve(choices.size());
    for (const rules::Choice& choice : choices) {
      const rules::ClassId id = rules::Relabelling::label_of(pack_, choice);
      labels.push_back(id == rules::kNoClass ? LabelSet::kNone : label_of_class_[at(id)]);
    }
    const std::size_t classes = counts_.labels_.size();
    counter.count(
        labels,
        std::span(counts_.counts_).subspan(counts_.cell(variant, sample) * classes, classes));
    const MatchedLabels& matched = counter.last();
    std::uint8_t* found =
        counts_.found_.data() + variant * counts_.objects() + counts_.object_begin_[sample];
    for (std::size_t object = 0; object < matched.row_of.size(); ++object)
      found[object] = matched.is_hit(object) ? 1 : 0;
    if (counts_.label_of_row_.empty()) return;
    std::ranges::copy(labels, counts_.label_of_row_.begin() +
                                  static_cast<std::ptrdiff_t>(variant * counts_.row_begin_.back() +
                                                              counts_.row_begin_[sample]));
  }

  const rules::Pack& pack_;
  std::span<const Variant> variants_;
  const RuleBase& rules_;
  std::vector<RuleBase> set_;
  std::span<const Sample> samples_;
  const ScoreOptions& options_;
  RuleUses uses_;
  VariantCounts counts_;
  std::vector<RuleUses::Affected> affected_;
  std::vector<int> label_of_class_;
};

Checked<VariantCounts> count_variants(const RuleBase& rules, std::span<const Variant> variants,
                                      std::span<const Sample> samples, const ScoreOptions& options,
                                      const ForEachShare& for_each, bool keeps_labels) {
  std::vector<Issue> issues;
  auto set = set_each(rules, variants, issues);
  if (has_errors(issues)) return {std::nullopt, std::move(issues)};
  VariantCounter counter(rules, std::move(set), variants, samples, options, keeps_labels);
  return {counter.run(for_each), {}};
}

}  // namespace oriel
