#include "interpret/detail/relations.h"

#include "interpret/detail/evaluator.h"

#include <algorithm>
#include <array>
#include <utility>

namespace oriel::rules {

namespace {

/// What levels a condition of a relation reads: bit 0 self, bit 1 other.
constexpr unsigned kSelf = 1, kOther = 2;

/// Goes through the pairs of a relation block by block and keeps those that fit. Conditions on one
/// of the two alone are evaluated once for every feature, and only pairs that they leave are looked
/// at.
class Narrowing {
 public:
  Narrowing(const Pack& pack, const Facts& facts, const Relation& relation)
      : facts_(facts), evaluator_(pack, facts) {
    const Expr& where = pack.code[static_cast<std::size_t>(relation.where)];
    const std::vector<ExprId> whole{relation.where};
    for (const ExprId id : where.op == Op::all_of ? where.args : whole) sort(pack, id);
  }

  Links run(const Links& from) {
    const auto selves = answers_of(of_self_, 0), others = answers_of(of_other_, 1);
    links_.starts.assign(facts_.rows + 1, 0);
    // One more than there can be: what does not fit is written there, too, and then overwritten.
    links_.others.resize(from.others.size() + 1);
    links_.certain.resize(from.others.size() + 1);
    for (const int row : facts_.row_numbers) {
      const Truth self = selves[static_cast<std::size_t>(row)];
      if (self == Truth::no) continue;
      const std::size_t end = from.begin_of(row + 1);
      for (std::size_t link = from.begin_of(row); link < end; ++link) {
        const int other = from.others[link];
        const Truth fits = std::min(self, others[static_cast<std::size_t>(other)]);
        add(row, other, std::min(fits, from.is_other(link)));
      }
    }
    flush();
    for (std::size_t row = 0; row < facts_.rows; ++row)
      links_.starts[row + 1] += links_.starts[row];
    links_.others.resize(count_);
    links_.certain.resize(has_unknown_ ? count_ : 0);
    return std::move(links_);
  }

 private:
  void sort(const Pack& pack, ExprId id) {
    const unsigned levels = pack.code[static_cast<std::size_t>(id)].levels;
    auto& list = (levels & kOther) == 0 ? of_self_ : (levels & kSelf) == 0 ? of_other_ : of_both_;
    list.push_back(id);
  }

  /// For every feature whether all of the conditions hold, which read that level only.
  std::vector<Truth> answers_of(const std::vector<ExprId>& conditions, int level) {
    std::vector<Truth> all(facts_.rows, Truth::yes);
    for (std::size_t begin = 0; begin < facts_.rows; begin += kBlock) {
      const Frame frame = block_of(facts_, begin, level);
      narrow(conditions, frame, std::span(all).subspan(begin, frame.size));
    }
    return all;
  }

  void narrow(const std::vector<ExprId>& conditions, const Frame& frame, std::span<Truth> all) {
    std::array<Truth, kBlock> block;
    const auto answers = std::span(block).first(all.size());
    for (const ExprId id : conditions) {
      evaluator_.truths(id, frame, answers);
      for (std::size_t i = 0; i < all.size(); ++i) all[i] = std::min(all[i], answers[i]);
    }
  }

  /// Pairs that do not fit are overwritten by the next, without a branch that nobody could foresee.
  void add(int self, int other, Truth truth) {
    if (size_ == kBlock) flush();
    selves_[size_] = self;
    others_[size_] = other;
    truths_[size_] = truth;
    size_ += truth != Truth::no ? 1 : 0;
  }

  void flush() {
    Frame frame;
    frame.size = size_;
    frame.rows[0] = selves_.data();
    frame.rows[1] = others_.data();
    narrow(of_both_, frame, std::span(truths_).first(size_));
    int* const others = links_.others.data();
    int* const starts = links_.starts.data() + 1;
    Truth* const certain = links_.certain.data();
    std::size_t count = count_;
    for (std::size_t i = 0; i < size_; ++i) {
      const Truth truth = truths_[i];
      const int fits = truth != Truth::no ? 1 : 0;
      has_unknown_ |= truth == Truth::unknown;
      others[count] = others_[i];
      certain[count] = truth;
      starts[selves_[i]] += fits;
      count += static_cast<std::size_t>(fits);
    }
    count_ = count;
    size_ = 0;
  }

  const Facts& facts_;
  Evaluator evaluator_;
  std::vector<ExprId> of_self_, of_other_, of_both_;
  Links links_;
  std::size_t count_ = 0;  ///< of links that fit
  bool has_unknown_ = false;
  std::size_t size_ = 0;
  std::array<int, kBlock> selves_;
  std::array<int, kBlock> others_;
  std::array<Truth, kBlock> truths_;
};

}  // namespace

Links narrowed(const Pack& pack, const Facts& facts, const Relation& relation) {
  const Links& from = facts.relations[static_cast<std::size_t>(relation.within)];
  return Narrowing(pack, facts, relation).run(from);
}

}  // namespace oriel::rules
