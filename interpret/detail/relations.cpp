#include "interpret/detail/relations.h"

#include "interpret/detail/evaluator.h"

#include <algorithm>
#include <array>
#include <utility>

namespace oriel::rules {

namespace {

/// Goes through the pairs of a relation block by block and keeps those that fit.
class Narrowing {
 public:
  Narrowing(const Pack& pack, const Facts& facts, const Relation& relation)
      : evaluator_(pack, facts), where_(relation.where), rows_(facts.rows) {}

  Links run(const Links& from) {
    links_.starts.assign(rows_ + 1, 0);
    for (int row = 0; row < static_cast<int>(rows_); ++row) {
      for (std::size_t link = from.begin_of(row); link < from.begin_of(row + 1); ++link)
        add(row, from.others[link], from.is_other(link));
    }
    flush();
    for (std::size_t row = 0; row < rows_; ++row) links_.starts[row + 1] += links_.starts[row];
    if (std::ranges::find(links_.certain, Truth::unknown) == links_.certain.end())
      links_.certain.clear();
    return std::move(links_);
  }

 private:
  void add(int self, int other, Truth is_other) {
    if (size_ == kBlock) flush();
    selves_[size_] = self;
    others_[size_] = other;
    known_[size_++] = is_other;
  }

  void flush() {
    Frame frame;
    frame.size = size_;
    frame.rows[0] = selves_.data();
    frame.rows[1] = others_.data();
    std::array<Truth, kBlock> answers;
    evaluator_.truths(where_, frame, std::span(answers).first(size_));
    for (std::size_t i = 0; i < size_; ++i) {
      const Truth truth = std::min(known_[i], answers[i]);
      if (truth == Truth::no) continue;
      ++links_.starts[static_cast<std::size_t>(selves_[i]) + 1];
      links_.others.push_back(others_[i]);
      links_.certain.push_back(truth);
    }
    size_ = 0;
  }

  Evaluator evaluator_;
  ExprId where_;
  std::size_t rows_;
  Links links_;
  std::size_t size_ = 0;
  std::array<int, kBlock> selves_;
  std::array<int, kBlock> others_;
  std::array<Truth, kBlock> known_;
};

}  // namespace

Links narrowed(const Pack& pack, const Facts& facts, const Relation& relation) {
  const Links& from = facts.relations[static_cast<std::size_t>(relation.within)];
  return Narrowing(pack, facts, relation).run(from);
}

}  // namespace oriel::rules
