#pragma once

#include "interpret/evaluate/comparisons.h"
#include "interpret/evaluate/evaluator.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <cstdint>
#include <vector>

namespace oriel::rules {

/// Whom a quantifier asks: the others to which its relation leads, and how they answer its filter,
/// which is evaluated once for every feature.
class Evaluator::AskedOthers {
 public:
  AskedOthers(Evaluator& evaluator, const Expr& quantifier)
      : links_(evaluator.context_->relations[oriel::at(quantifier.index)]) {
    may_be_unknown_ = !links_.are_all_certain();
    if (quantifier.filter != kNoExpr) {
      filter_ = look_up(evaluator, quantifier.filter, quantifier.level + 1);
    }
    if (may_be_unknown_) seen_.resize(links_.lists->lists(), Seen::nothing);
  }

  [[nodiscard]] const Links& links() const { return links_; }
  [[nodiscard]] const Truth* filter() const { return filter_; }
  [[nodiscard]] Truth filtered(int other) const {
    return filter_ == nullptr ? Truth::yes : filter_[oriel::at(other)];
  }

  /// Whether it is unknown of an other of the row that it is one, or how it answers the filter.
  /// Rows that share a list share the answer.
  [[nodiscard]] bool has_unknown(int row) { return may_be_unknown_ && look_for_unknown(row); }

 private:
  enum class Seen : std::uint8_t { nothing, known, unknown };

  /// The answers of all features, where they stand already.
  const Truth* look_up(Evaluator& evaluator, ExprId filter, int level) {
    if (const auto* known = evaluator.known_column(evaluator.at(filter))) {
      may_be_unknown_ = may_be_unknown_ || rules::has_unknown(*known);
      return known->data();
    }
    const Kept& answers = evaluator.column(filter, level);
    may_be_unknown_ = may_be_unknown_ || answers.has_unknown;
    return answers.answers.data();
  }

  bool look_for_unknown(int row) {
    const auto [begin, end] = links_.range_of(row);
    if (begin == end) return false;
    Seen& seen = seen_[oriel::at(links_.lists->list_of[oriel::at(row)])];
    if (seen == Seen::nothing) seen = looks_unknown(row) ? Seen::unknown : Seen::known;
    return seen == Seen::unknown;
  }

  [[nodiscard]] bool looks_unknown(int row) const {
    const auto [begin, end] = links_.range_of(row);
    bool is_unknown = false;
    for (std::size_t link = begin; link < end; ++link) {
      const Truth answer = std::min(links_.is_other(row, link), filtered(links_.other(link)));
      is_unknown |= answer == Truth::unknown;
    }
    return is_unknown;
  }

  const Links& links_;
  const Truth* filter_ = nullptr;
  bool may_be_unknown_ = false;
  /// By list, what is known of it.
  std::vector<Seen> seen_;
};

}  // namespace oriel::rules
