#pragma once

#include "interpret/learn/label_counter.h"
#include "interpret/learn/sample.h"
#include "interpret/pack/rule_base.h"
#include "interpret/relabelling/variant.h"
#include "interpret/score/score.h"
#include "kernel/base/issue.h"
#include "kernel/base/parallel.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace oriel {

/// How well variants of a pack label samples, each by itself.
class VariantCounts {
 public:
  VariantCounts(std::size_t variants, std::span<const Sample> samples, LabelSet labels,
                bool keeps_labels);

  /// The labels of the pack and of the truths, sorted.
  [[nodiscard]] const LabelSet& labels() const { return labels_; }
  [[nodiscard]] std::size_t variants() const { return variants_; }
  [[nodiscard]] std::size_t samples() const { return object_begin_.size() - 1; }

  /// By label of labels(): what score() says of the sample.
  [[nodiscard]] std::span<const ClassCounts> counts(std::size_t variant, std::size_t sample) const {
    return std::span(counts_).subspan(cell(variant, sample) * labels_.size(), labels_.size());
  }
  /// The same of some samples together, such as a fold; labels without any count are left out, so
  /// that they are those of score().
  [[nodiscard]] std::map<std::string, ClassScore> total(std::size_t variant,
                                                        std::span<const std::size_t> samples) const;
  /// Of all samples.
  [[nodiscard]] std::map<std::string, ClassScore> total(std::size_t variant) const;

  /// Whether the object of Sample::truth was found with its label.
  [[nodiscard]] bool is_found(std::size_t variant, std::size_t sample, std::size_t object) const {
    return found_[variant * objects() + object_begin_[sample] + object];
  }

  /// The label of a feature: a position in labels(), or LabelSet::kNone. Only if labels were kept.
  [[nodiscard]] int label(std::size_t variant, std::size_t sample, std::size_t row) const {
    return label_of_row_[variant * row_begin_.back() + row_begin_[sample] + row];
  }

 private:
  friend class VariantCounter;
  [[nodiscard]] std::size_t cell(std::size_t variant, std::size_t sample) const {
    return variant * samples() + sample;
  }
  [[nodiscard]] std::size_t objects() const { return object_begin_.back(); }

  std::size_t variants_;
  LabelSet labels_;
  /// Where the objects and the rows of each sample begin among those of all; one more at the end.
  std::vector<std::size_t> object_begin_{0}, row_begin_{0};
  /// By variant, sample and label.
  std::vector<ClassCounts> counts_;
  /// By variant, sample and object, as bytes, so that threads may write side by side.
  std::vector<std::uint8_t> found_;
  /// By variant, sample and row; empty unless they are kept.
  std::vector<std::int16_t> label_of_row_;
};

/// The mean F1 of the classes that the truth has, as Score::macro_f1().
double macro_f1(const std::map<std::string, ClassScore>& classes);

/// Labels every sample with every variant of the pack, as interpret() would with a pack of its own,
/// and compares the labels with the truth, as score() would, in a fraction of the time: each sample
/// is labelled with the pack as it is, and then only rules are asked again that a variant touches.
///
/// The same at any number of threads of `for_each`. R206, R212 with the name of the variant in
/// Place::file for params that are unknown, beyond their range, or with which the pack would be
/// refused; then there is no value.
Checked<VariantCounts> count_variants(const RuleBase& rules, std::span<const Variant> variants,
                                      std::span<const Sample> samples,
                                      const ScoreOptions& options = {},
                                      const ForEachShare& for_each = for_each_in_turn,
                                      bool keeps_labels = false);

}  // namespace oriel
