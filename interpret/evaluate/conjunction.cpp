#include "interpret/evaluate/conjunction.h"

#include <algorithm>
#include <cstring>
#include <limits>

namespace oriel::rules {

namespace {

/// Counted in few bits, so that many fit into a register.
std::size_t count_open(std::span<const Truth> truths) {
  static_assert(kBlock <= std::numeric_limits<std::uint16_t>::max());
  std::uint16_t open = 0;
  for (const Truth truth : truths)
    open = static_cast<std::uint16_t>(open + static_cast<std::uint16_t>(truth != Truth::no));
  return open;
}

/// Writes down which are open; returns how many. Most are not, and those are passed over eight at a
/// time.
std::size_t find_open(std::span<const Truth> truths, std::array<std::uint16_t, kBlock>& open) {
  static_assert(static_cast<int>(Truth::no) == 0);
  constexpr std::size_t kTogether = sizeof(std::uint64_t);
  std::size_t size = 0;
  for (std::size_t begin = 0; begin < truths.size(); begin += kTogether) {
    const std::size_t end = std::min(begin + kTogether, truths.size());
    std::uint64_t eight = 1;
    if (end == begin + kTogether) std::memcpy(&eight, &truths[begin], kTogether);
    if (eight == 0) continue;
    for (std::size_t i = begin; i < end; ++i) {
      open[size] = static_cast<std::uint16_t>(i);
      size += truths[i] != Truth::no ? 1U : 0U;
    }
  }
  return size;
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
  if (as != As::itself) {
    ask_turned(evaluator, id, as);
  } else if (const auto parts = evaluator.parts(id); !parts.empty()) {
    for (const ExprId part : parts)
      if (is_open()) ask(evaluator, part);
    return;
  } else {
    evaluator.narrow(id, frame_, truths_);
  }
  open_ = count_open(truths_);
  if (2 * open_ <= truths_.size()) move_together();
}

void Conjunction::ask_turned(Evaluator& evaluator, ExprId id, As as) {
  std::array<Truth, kBlock> block;
  const auto answers = std::span(block).first(truths_.size());
  evaluator.truths(id, frame_, answers);
  const auto fold = [&](auto count) {
    for (std::size_t i = 0; i < answers.size(); ++i)
      truths_[i] = std::min(truths_[i], count(answers[i]));
  };
  if (as == As::opposite)
    fold([](Truth t) { return negated(t); });
  else
    fold([](Truth t) { return truth_of(t != Truth::yes); });
}

void Conjunction::move_together() {
  std::array<std::uint16_t, kBlock> kept;
  const std::size_t size = find_open(truths_, kept);
  for (std::size_t k = 0; k < size; ++k) {
    slots_[k] = is_moved_ ? slots_[kept[k]] : kept[k];
    moved_[k] = truths_[kept[k]];
  }
  for (std::size_t level = 0; level < frame_.rows.size(); ++level) {
    const int* rows = frame_.rows[level];
    if (rows == nullptr) continue;
    for (std::size_t k = 0; k < size; ++k) rows_[level][k] = rows[kept[k]];
    frame_.rows[level] = rows_[level].data();
  }
  is_moved_ = true;
  truths_ = std::span(moved_).first(size);
  frame_.size = size;
  frame_.is_run = false;
  frame_.needed = truths_.data();
}

/// What is left out has been settled with no.
void Conjunction::finish() {
  if (!is_moved_) return;
  std::ranges::fill(out_, Truth::no);
  for (std::size_t i = 0; i < truths_.size(); ++i) out_[slots_[i]] = truths_[i];
}

}  // namespace oriel::rules
