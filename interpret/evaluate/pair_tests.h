#pragma once

#include "interpret/evaluate/evaluator.h"

#include <array>
#include <optional>
#include <span>

namespace oriel::rules {

/// The conditions on both features of a quantifier that ask whether an attribute of the other one,
/// or how far it is from a number of self, lies in a range that self alone decides: what relates
/// features is nearly always said so. What they ask of selves is evaluated once for a block; then
/// they are asked pair by pair, without anything that stands between two operators.
class Evaluator::PairTests {
 public:
  /// Reads the conditions of `quantifier` for the slots of `frame`, whose level is that of self.
  PairTests(Evaluator& evaluator, const Expr& quantifier, const Frame& frame);
  PairTests(const PairTests&) = delete;
  PairTests& operator=(const PairTests&) = delete;

  static constexpr std::size_t kMost = 4;
  [[nodiscard]] std::size_t size() const { return size_; }
  /// The conditions that are no such tests.
  [[nodiscard]] std::span<const ExprId> left() const { return std::span(left_).first(left_size_); }

  /// What a test asks of one self: whether numbers[other] less this number lies in low .. high.
  struct Range {
    const double* numbers;
    double number, low, high;
  };
  /// The tests of one self.
  template <std::size_t kSize>
  struct OfSelf {
    std::array<Range, kSize> ranges;
    /// What a pair answers that passes all of them: unknown where a bound is missing.
    Truth best;

    [[nodiscard]] Truth answer(int other) const {
      Truth least = best;
      for (std::size_t i = 0; i < kSize; ++i) {
        const Range& range = ranges[i];
        const double value = range.numbers[other] - range.number;
        if ((value >= range.low) & (value <= range.high)) continue;
        if (value == value) return Truth::no;
        least = Truth::unknown;
      }
      return least;
    }
  };
  /// `kSize` is size().
  template <std::size_t kSize>
  [[nodiscard]] OfSelf<kSize> of(std::size_t slot) const {
    OfSelf<kSize> all;
    all.best = is_bound_missing_ ? best_[slot] : Truth::yes;
    for (std::size_t i = 0; i < kSize; ++i) {
      const Test& test = tests_[i];
      all.ranges[i] = {test.numbers, test.of_selves[slot], test.low[slot], test.high[slot]};
    }
    return all;
  }

 private:
  static constexpr std::size_t kMostLeft = 16;

  /// An attribute of the other feature, less a number of self or nothing.
  struct Measure {
    const double* numbers = nullptr;
    ExprId number_of_self = kNoExpr;
    bool is_absolute = false;
    /// It is self's number less the other's.
    bool is_reversed = false;
  };
  struct Test {
    const double* numbers;
    /// By slot: the number of self, in the column where it stands or in `block`.
    const double* of_selves;
    NumberBlock block;
    NumberBlock low, high;
  };

  bool read(ExprId id);
  bool read_comparison(Op op, ExprId value, ExprId bound);
  bool read_range(ExprId value, ExprId low, ExprId high);
  [[nodiscard]] std::optional<Measure> measure_of(ExprId id) const;
  [[nodiscard]] std::optional<Measure> difference_of(const Expr& expr) const;
  [[nodiscard]] bool is_of_self(ExprId id) const;
  Test& add(const Measure& measure);
  void mirror(Test& test) const;
  void let_pass_missing(Test& test);

  Evaluator& evaluator_;
  const Frame& frame_;
  const int level_;
  std::array<Test, kMost> tests_;
  std::size_t size_ = 0;
  std::array<ExprId, kMostLeft> left_;
  std::size_t left_size_ = 0;
  bool is_bound_missing_ = false;
  TruthBlock best_;
};

}  // namespace oriel::rules
