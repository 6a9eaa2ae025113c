#pragma once

#include "interpret/evaluate/evaluation_context.h"
#include "interpret/pack/pack.h"

#include <algorithm>
#include <array>
#include <limits>
#include <span>
#include <vector>

namespace oriel::rules {

/// Features are evaluated so many at a time, so that what is in between stays in the cache.
inline constexpr std::size_t kBlock = 512;
/// What stands between two operators, for one block.
using NumberBlock = std::array<double, kBlock>;
using TruthBlock = std::array<Truth, kBlock>;

/// For whom an expression is evaluated: `size` slots (at most kBlock), each with one feature for
/// every level the expression reads.
struct Frame {
  std::array<const int*, kMostLevels> rows{};
  std::size_t size = 0;
  /// The features of every level that is read follow each other.
  bool is_run = false;
  /// Where an entry is Truth::no the answer is not needed and may be anything; null: all are
  /// needed.
  const Truth* needed = nullptr;
};

/// The features from `begin` on, so many as a block takes, on the given level.
inline Frame block_of(const EvaluationContext& context, std::size_t begin, int level = 0) {
  Frame frame;
  frame.size = std::min(kBlock, context.rows - begin);
  frame.rows[static_cast<std::size_t>(level)] = context.row_numbers.data() + begin;
  frame.is_run = true;
  return frame;
}

/// What a facet of that inclination is.
HostKind kind_of_facet(const Hosts& hosts, double inclination_deg);

/// The inclinations of a kind of facet.
HostRange range_of(const Hosts& hosts, HostKind kind);

/// Evaluates expressions of a pack over the features of a building. Numbers that are unknown are
/// NaN.
class Evaluator {
 public:
  Evaluator(const Pack& pack, const EvaluationContext& context)
      : pack_(&pack), context_(&context) {}

  /// To be called when memberships have changed: forgets what was evaluated for all features.
  void forget() { kept_.clear(); }

  void numbers(ExprId id, const Frame& frame, std::span<double> out);
  void truths(ExprId id, const Frame& frame, std::span<Truth> out);
  /// Lowers `all` to the answers, where they are less.
  void narrow(ExprId id, const Frame& frame, std::span<Truth> all);
  /// The conditions of which an expression is the conjunction; none if it is something else.
  [[nodiscard]] std::span<const ExprId> parts(ExprId id) const {
    const Expr& expr = at(id);
    return expr.op == Op::all_of ? std::span(expr.args) : std::span<const ExprId>();
  }

  /// How the others of a quantifier answer; filled by tally().
  struct Tally {
    int yes;
    int unknown;
    int no;

    [[nodiscard]] int total() const { return yes + unknown + no; }
  };
  /// A slot is settled, and its further others are not asked, with so many answers of a kind;
  /// where an unknown answer would count, only if none of them can be unknown.
  struct Enough {
    int yes = std::numeric_limits<int>::max();
    int no = std::numeric_limits<int>::max();
    bool minds_unknown = false;
    /// Answers that are no need not be counted, but for `all`.
    bool ignores_no = false;

    [[nodiscard]] bool settles(const Tally& t) const { return t.yes >= yes || t.no >= no; }
  };
  /// The answers for each slot of `frame`; of slots that are settled some of them.
  void tally(ExprId id, const Frame& frame, std::span<Tally> out, Enough enough);
  /// All of them.
  void tally(ExprId id, const Frame& frame, std::span<Tally> out) { tally(id, frame, out, {}); }

 private:
  [[nodiscard]] const Expr& at(ExprId id) const {
    return pack_->code[static_cast<std::size_t>(id)];
  }

  /// The value of an expression that is the same for all features; `id` is its own.
  [[nodiscard]] double constant(const Expr& expr, ExprId id) const;
  void gather(const Expr& expr, const Frame& frame, std::span<double> out) const;
  bool distance(const Expr& expr, const Frame& frame, std::span<double> out) const;
  std::span<const double> operand(ExprId id, const Frame& frame, NumberBlock& block);
  void apply_all(const Expr& expr, const Frame& frame, std::span<double> out);
  /// No slot is counted beyond `limit` where no answer can be unknown.
  void count(ExprId id, const Frame& frame, std::span<double> out, int limit);
  void aggregate(ExprId id, const Frame& frame, std::span<double> out);

  void flag(const Expr& expr, const Frame& frame, std::span<Truth> out) const;
  void compare(const Expr& expr, const Frame& frame, std::span<Truth> out);
  void in_range(const Expr& expr, const Frame& frame, std::span<Truth> out);
  void in_list(const Expr& expr, const Frame& frame, std::span<Truth> out);
  void similar(const Expr& expr, const Frame& frame, std::span<Truth> out);
  void combine(const Expr& expr, const Frame& frame, std::span<Truth> out);
  [[nodiscard]] const std::vector<Truth>* known_column(const Expr& expr) const;
  void quantify(ExprId id, const Frame& frame, std::span<Truth> out);

  /// The answers of an expression of one level for all features, kept until forget().
  struct Kept {
    ExprId of;
    std::vector<Truth> answers;
    bool has_unknown;
  };
  const Kept& column(ExprId id, int level);

  /// True if it is certain that the expression is unknown for no feature.
  [[nodiscard]] bool is_always_known(ExprId id) const;
  [[nodiscard]] double most(ExprId id) const;
  [[nodiscard]] double most_in(std::size_t column) const;

  struct Pairs;
  class AskedOthers;
  class PairTests;
  template <std::size_t kTests>
  class AtOnce;
  class Rounds;
  struct Values;
  void flush(const Expr& expr, Pairs& pairs, Values& values);

  const Pack* pack_;
  const EvaluationContext* context_;
  std::vector<Kept> kept_;
  /// By column, NaN until it is asked for.
  mutable std::vector<double> most_in_;
};

}  // namespace oriel::rules
