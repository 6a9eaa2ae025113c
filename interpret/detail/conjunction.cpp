#include "interpret/detail/conjunction.h"

#include <algorithm>
#include <numeric>

namespace oriel::rules {

namespace {

std::size_t count_open(std::span<const Truth> truths) {
  return truths.size() - static_cast<std::size_t>(std::ranges::count(truths, Truth::no));
}

Truth counted(Truth answer, Conjunction::As as) {
  if (as == Conjunction::As::itself) return answer;
  if (as == Conjunction::As::opposite) return negated(answer);
  return truth_of(answer != Truth::yes);
}

}  // namespace

Conjunction::Conjunction(const Frame& frame, std::span<Truth> out)
    : frame_(frame), out_(out), truths_(out), open_(out.size()) {
  std::ranges::fill(out, Truth::yes);
  if (frame.needed != nullptr) {
    for (std::size_t i = 0; i < out.size(); ++i) out[i] = truth_of(frame.needed[i] != Truth::no);
    open_ = count_open(out);
  }
  frame_.needed = truths_.data();
  if (2 * open_ <= out.size()) move_together();
}

void Conjunction::ask(Evaluator& evaluator, ExprId id, As as) {
  std::array<Truth, kBlock> block;
  const auto answers = std::span(block).first(truths_.size());
  evaluator.truths(id, frame_, answers);
  const auto fold = [&](auto count) {
    for (std::size_t i = 0; i < answers.size(); ++i)
      truths_[i] = std::min(truths_[i], count(answers[i]));
  };
  switch (as) {
    case As::itself:
      fold([](Truth t) { return t; });
      break;
    case As::opposite:
      fold([](Truth t) { return counted(t, As::opposite); });
      break;
    case As::veto:
      fold([](Truth t) { return counted(t, As::veto); });
      break;
  }
  open_ = count_open(truths_);
  if (2 * open_ <= truths_.size()) move_together();
}

/// What is left out has been settled with no, which `out` holds until finish() fills in the rest.
void Conjunction::move_together() {
  if (!is_moved_) std::iota(slots_.begin(), slots_.begin() + truths_.size(), std::uint16_t{0});
  std::size_t size = 0;
  std::array<std::uint16_t, kBlock> kept;
  for (std::size_t i = 0; i < truths_.size(); ++i) {
    kept[size] = static_cast<std::uint16_t>(i);
    size += truths_[i] != Truth::no ? 1U : 0U;
  }
  for (std::size_t k = 0; k < size; ++k) {
    slots_[k] = slots_[kept[k]];
    moved_[k] = truths_[kept[k]];
  }
  for (std::size_t level = 0; level < frame_.rows.size(); ++level) {
    const int* rows = frame_.rows[level];
    if (rows == nullptr) continue;
    for (std::size_t k = 0; k < size; ++k) rows_[level][k] = rows[kept[k]];
    frame_.rows[level] = rows_[level].data();
  }
  if (!is_moved_) std::ranges::fill(out_, Truth::no);
  is_moved_ = true;
  truths_ = std::span(moved_).first(size);
  frame_.size = size;
  frame_.is_run = false;
  frame_.needed = truths_.data();
}

void Conjunction::finish() {
  if (!is_moved_) return;
  for (std::size_t i = 0; i < truths_.size(); ++i) out_[slots_[i]] = truths_[i];
}

}  // namespace oriel::rules
