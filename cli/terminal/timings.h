#pragma once

#include "oriel/stage.h"

#include <array>

namespace oriel::cli {

/// By Stage.
inline constexpr std::array kStageNames{"read",      "solidify",   "segment", "describe",
                                        "interpret", "generalise", "write"};

/// How long the stages took: sums over what was done. Times never stand in data.
class Timings {
 public:
  /// Calls `work()` and adds its time to a stage; returns what it returns.
  template <class Work>
  auto measure(Stage stage, Work work) {
    return oriel::measure(observer(), stage, work);
  }

  void add(const Timings& more) {
    for (std::size_t s = 0; s < ms_.size(); ++s) ms_[s] += more.ms_[s];
  }
  void add(Stage stage, double ms) { ms_[static_cast<std::size_t>(stage)] += ms; }

  /// Adds what the library reports; this must outlive it.
  [[nodiscard]] StageObserver observer() {
    return [this](Stage stage, double ms) { add(stage, ms); };
  }

  [[nodiscard]] double ms(Stage stage) const { return ms_[static_cast<std::size_t>(stage)]; }

 private:
  std::array<double, kStageNames.size()> ms_{};
};

}  // namespace oriel::cli
