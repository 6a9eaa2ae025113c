#pragma once

#include "interpret/evaluate/evaluator.h"

#include <array>
#include <cstdint>
#include <span>

namespace oriel::rules {

/// Conditions that are asked one after the other, each only of the slots that those before left
/// open. As soon as half of the slots are settled, the others are moved together, so that what a
/// condition costs goes by how many it is asked of.
class Conjunction {
 public:
  /// How an answer counts: as it is, its opposite, or as no where it is yes.
  enum class As { itself, opposite, veto };

  /// `out`, one for each slot of `frame`: yes at first, no where the answer is not needed.
  Conjunction(const Frame& frame, std::span<Truth> out);
  Conjunction(const Conjunction&) = delete;
  Conjunction& operator=(const Conjunction&) = delete;

  /// True if a slot is not settled.
  [[nodiscard]] bool is_open() const { return open_ > 0; }
  /// A conjunction is asked part by part.
  void ask(Evaluator& evaluator, ExprId id, As as = As::itself);

  /// The slots that are left, with `needed` where they are open.
  [[nodiscard]] const Frame& frame() const { return frame_; }
  /// By slot of frame(): what the conditions left, and the slot of the first frame.
  [[nodiscard]] std::span<Truth> truths() { return truths_; }
  [[nodiscard]] std::size_t slot(std::size_t i) const { return is_moved_ ? slots_[i] : i; }

  /// Completes `out`, which holds nothing before; to be called once, if at all.
  void finish();

 private:
  void ask_turned(Evaluator& evaluator, ExprId id, As as);
  void move_together();

  Frame frame_;
  std::span<Truth> out_;
  /// `out` itself until slots are moved.
  std::span<Truth> truths_;
  std::size_t open_ = 0;
  bool is_moved_ = false;
  std::array<std::uint16_t, kBlock> slots_;
  std::array<Truth, kBlock> moved_;
  std::array<std::array<int, kBlock>, kMostLevels> rows_;
};

}  // namespace oriel::rules
