#include "interpret/evaluate/arithmetic.h"
#include "interpret/evaluate/asked_others.h"
#include "interpret/evaluate/comparisons.h"
#include "interpret/evaluate/conjunction.h"
#include "interpret/evaluate/pair_tests.h"
#include "interpret/evaluate/pairs.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <limits>
#include <type_traits>
#include <vector>

namespace oriel::rules {

namespace {

void add(Evaluator::Tally& tally, Truth answer) {
  tally.yes += answer == Truth::yes ? 1 : 0;
  tally.unknown += answer == Truth::unknown ? 1 : 0;
  tally.no += answer == Truth::no ? 1 : 0;
}

/// How a pair answers a quantifier. Where it is unknown whether the other is one at all, the answer
/// is that of `is one and …`; of `all` it is that of `is none or …`.
Truth answer_of(Op op, Truth is_other, Truth answer) {
  return op == Op::all ? std::max(negated(is_other), answer) : std::min(is_other, answer);
}

/// Calls `run` with the number of tests as a constant.
auto with_size(std::size_t size, auto run) {
  switch (size) {
    case 0:
      return run(std::integral_constant<std::size_t, 0>());
    case 1:
      return run(std::integral_constant<std::size_t, 1>());
    case 2:
      return run(std::integral_constant<std::size_t, 2>());
    case 3:
      return run(std::integral_constant<std::size_t, 3>());
    default:
      return run(std::integral_constant<std::size_t, 4>());
  }
}

/// How many others of a slot are asked at first: some more than could be enough.
std::size_t first_share(Evaluator::Enough enough) {
  constexpr int kAll = std::numeric_limits<int>::max() / 4;
  const int least = std::min(enough.yes, enough.no);
  return static_cast<std::size_t>(least > kAll ? kAll : least + 2);
}

}  // namespace

const Evaluator::Kept& Evaluator::column(ExprId id, int level) {
  const auto kept = std::ranges::find(kept_, id, &Kept::of);
  if (kept != kept_.end()) return *kept;
  std::vector<Truth> computed(context_->rows);
  for (std::size_t begin = 0; begin < context_->rows; begin += kBlock) {
    const Frame frame = block_of(*context_, begin, level);
    truths(id, frame, std::span(computed).subspan(begin, frame.size));
  }
  const bool is_any_unknown = has_unknown(computed);
  return kept_.emplace_back(Kept{id, std::move(computed), is_any_unknown});
}

/// Pairs are answered one by one, each at once: for conditions that are tests, all of them.
template <std::size_t kTests>
class Evaluator::AtOnce {
 public:
  AtOnce(const Expr& expr, AskedOthers& asked, const PairTests& tests, Enough enough)
      : op_(expr.op), asked_(asked), tests_(tests), enough_(enough) {}

  void run(const int* rows, const Truth* needed, std::span<Tally> out) {
    const bool can_be_plain = enough_.ignores_no && op_ != Op::all;
    for (std::size_t slot = 0; slot < out.size(); ++slot) {
      if (needed != nullptr && needed[slot] == Truth::no) {
        out[slot] = {0, 0, 0};
        continue;
      }
      const int row = rows[slot];
      const auto range = asked_.links().range_of(row);
      if (range.begin == range.end)
        out[slot] = {0, 0, 0};
      else if (can_be_plain && !asked_.has_unknown(row))
        out[slot] = plain_answers(row, range, tests_.template of<kTests>(slot));
      else
        out[slot] = answers(row, range, tests_.template of<kTests>(slot));
    }
  }

 private:
  using OfSelf = PairTests::OfSelf<kTests>;

  /// Where nothing is unknown before the tests, and what is no need not be counted.
  [[nodiscard]] Tally plain_answers(int row, Links::Range range, const OfSelf& tests) const {
    const int* const others = asked_.links().lists->others.data();
    Tally tally{0, 0, 0};
    for (std::size_t link = range.begin; link < range.end; ++link) {
      const int other = others[link];
      if (other == row || asked_.filtered(other) == Truth::no) continue;
      const Truth answer = tests.answer(other);
      if (answer == Truth::no) continue;
      tally.unknown += answer == Truth::unknown ? 1 : 0;
      tally.yes += answer == Truth::yes ? 1 : 0;
      if (tally.yes >= enough_.yes) break;
    }
    return tally;
  }

  [[nodiscard]] Tally answers(int row, Links::Range range, const OfSelf& tests) {
    const bool minds = enough_.minds_unknown && asked_.has_unknown(row);
    Tally tally{0, 0, 0};
    for (std::size_t link = range.begin; link < range.end; ++link) {
      if (!minds && enough_.settles(tally)) break;
      const int other = asked_.links().other(link);
      if (other == row) continue;
      Truth answer = asked_.filtered(other);
      if (answer != Truth::no) answer = std::min(answer, tests.answer(other));
      add(tally, answer_of(op_, asked_.links().is_other(row, link), answer));
    }
    return tally;
  }

  const Op op_;
  AskedOthers& asked_;
  const PairTests& tests_;
  const Enough enough_;
};

/// Pairs are asked in rounds, of each slot that is still open some of its others, then twice as
/// many: so a block holds pairs of many slots, and few pairs are asked that nobody needs.
class Evaluator::Rounds {
 public:
  Rounds(Evaluator& evaluator, const Expr& expr, AskedOthers& asked, const PairTests& tests,
         const Frame& frame, std::span<Tally> out, Enough enough)
      : evaluator_(evaluator),
        expr_(expr),
        links_(asked.links()),
        tests_(tests),
        rows_(frame.rows[oriel::at(expr.level)]),
        out_(out),
        enough_(enough),
        filter_(asked.filter()) {
    for (std::size_t slot = 0; slot < out.size(); ++slot) {
      out[slot] = {0, 0, 0};
      if (frame.needed != nullptr && frame.needed[slot] == Truth::no) continue;
      left_of_[slot] = links_.range_of(rows_[slot]);
      has_unknown_[slot] = asked.has_unknown(rows_[slot]);
      open_[open_count_++] = static_cast<std::uint16_t>(slot);
    }
  }

  void run() {
    for (std::size_t share = first_share(enough_); open_count_ > 0; share *= 2) {
      std::size_t left = 0;
      for (std::size_t i = 0; i < open_count_; ++i) {
        const std::size_t slot = open_[i];
        const bool is_plain =
            enough_.ignores_no && expr_.op != Op::all && !has_unknown_[slot] && tests_.size() == 0;
        const bool is_open = is_plain ? ask_plain(slot, share) : ask(slot, share);
        if (is_open) open_[left++] = open_[i];
      }
      if (pairs_.size > 0) flush();
      open_count_ = 0;
      for (std::size_t i = 0; i < left; ++i)
        if (!is_settled(open_[i])) open_[open_count_++] = open_[i];
    }
  }

 private:
  [[nodiscard]] bool is_settled(std::size_t slot) const {
    return !(enough_.minds_unknown && has_unknown_[slot]) && enough_.settles(out_[slot]);
  }

  /// Asks up to `share` others of a slot; true if some are left.
  bool ask(std::size_t slot, std::size_t share) {
    return with_size(tests_.size(),
                     [&](auto size) { return ask(slot, share, tests_.template of<size>(slot)); });
  }

  template <class OfSelf>
  bool ask(std::size_t slot, std::size_t share, const OfSelf& tests) {
    auto& [link, end] = left_of_[slot];
    for (; link < end && share > 0 && !is_settled(slot); ++link) {
      const int other = links_.other(link);
      if (other == rows_[slot]) continue;
      const Truth is_other = links_.is_other(rows_[slot], link);
      Truth answer = filter_ == nullptr ? Truth::yes : filter_[oriel::at(other)];
      if (answer != Truth::no) answer = std::min(answer, tests.answer(other));
      if (answer == Truth::no) {
        add(out_[slot], answer_of(expr_.op, is_other, answer));
        continue;
      }
      if (pairs_.size == kBlock) flush();
      pairs_.add(slot, rows_[slot], other, is_other, answer);
      --share;
    }
    return link < end;
  }

  /// The same where nothing is unknown before the conditions on both, and what is no need not be
  /// counted: the pairs that do not fit are passed over.
  bool ask_plain(std::size_t slot, std::size_t share) {
    auto& [link, end] = left_of_[slot];
    const int self = rows_[slot];
    const int* const others = links_.lists->others.data();
    while (link < end && share > 0) {
      if (pairs_.size == kBlock) flush();
      const std::size_t until = std::min({end, link + share, link + kBlock - pairs_.size});
      const std::size_t before = pairs_.size;
      if (filter_ == nullptr)
        for (; link < until; ++link) pairs_.add_if(others[link] != self, slot, self, others[link]);
      else
        for (; link < until; ++link)
          pairs_.add_if((others[link] != self) & (filter_[oriel::at(others[link])] == Truth::yes),
                        slot, self, others[link]);
      share -= pairs_.size - before;
    }
    return link < end;
  }

  void flush() {
    const auto joined = std::span(joined_).first(pairs_.size);
    Conjunction held(pairs_.frame(expr_.level), joined);
    for (const ExprId id : tests_.left())
      if (held.is_open()) held.ask(evaluator_, id);
    held.finish();
    for (std::size_t i = 0; i < joined.size(); ++i)
      add(out_[pairs_.slots[i]],
          answer_of(expr_.op, pairs_.is_other[i], std::min(pairs_.filtered[i], joined[i])));
    pairs_.size = 0;
  }

  Evaluator& evaluator_;
  const Expr& expr_;
  const Links& links_;
  const PairTests& tests_;
  const int* rows_;
  std::span<Tally> out_;
  Enough enough_;
  const Truth* filter_;
  Pairs pairs_;
  TruthBlock joined_;
  /// Of each slot the links that are left, and whether an other may be one or not.
  std::array<Links::Range, kBlock> left_of_;
  std::array<bool, kBlock> has_unknown_;
  std::array<std::uint16_t, kBlock> open_;
  std::size_t open_count_ = 0;
};

void Evaluator::tally(ExprId id, const Frame& frame, std::span<Tally> out, Enough enough) {
  const Expr& expr = at(id);
  AskedOthers asked(*this, expr);
  const PairTests tests(*this, expr, frame);
  if (!tests.left().empty()) return Rounds(*this, expr, asked, tests, frame, out, enough).run();
  with_size(tests.size(), [&](auto size) {
    AtOnce<size>(expr, asked, tests, enough)
        .run(frame.rows[oriel::at(expr.level)], frame.needed, out);
  });
}

/// exists: one yes settles it, else one unknown leaves it open. all is the mirror image, and holds
/// where there is no other.
void Evaluator::quantify(ExprId id, const Frame& frame, std::span<Truth> out) {
  const Op op = at(id).op;
  Enough enough;
  (op == Op::all ? enough.no : enough.yes) = 1;
  enough.ignores_no = true;
  std::array<Tally, kBlock> tallies;
  tally(id, frame, std::span(tallies).first(out.size()), enough);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const Tally& t = tallies[i];
    const Truth open = t.unknown > 0 ? Truth::unknown : Truth::no;
    const Truth exists = t.yes > 0 ? Truth::yes : open;
    const Truth all = t.no > 0 ? Truth::no : negated(open);
    out[i] = op == Op::all ? all : op == Op::none ? negated(exists) : exists;
  }
}

/// One unknown answer makes the count unknown, so all must be asked where there may be one.
void Evaluator::count(ExprId id, const Frame& frame, std::span<double> out, int limit) {
  Enough enough;
  enough.ignores_no = true;
  const ExprId join = at(id).join;
  if (limit < enough.yes && (join == kNoExpr || is_always_known(join))) {
    enough.yes = limit;
    enough.minds_unknown = true;
  }
  std::array<Tally, kBlock> tallies;
  tally(id, frame, std::span(tallies).first(out.size()), enough);
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = tallies[i].unknown > 0 ? kUnknown : tallies[i].yes;
}

}  // namespace oriel::rules
