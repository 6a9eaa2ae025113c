#pragma once

#include "oriel/options.h"

#include <array>
#include <chrono>
#include <string>
#include <vector>

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
    const Stopwatch watch(ms_[static_cast<std::size_t>(stage)]);
    return work();
  }

  void add(const Timings& more);
  void add(Stage stage, double ms) { ms_[static_cast<std::size_t>(stage)] += ms; }

  /// Adds what the library reports; this must outlive it.
  [[nodiscard]] StageObserver observer() {
    return [this](Stage stage, double ms) { add(stage, ms); };
  }

  [[nodiscard]] double ms(Stage stage) const { return ms_[static_cast<std::size_t>(stage)]; }

 private:
  using Clock = std::chrono::steady_clock;

  class Stopwatch {
   public:
    explicit Stopwatch(double& sum_ms) : sum_ms_(sum_ms), start_(Clock::now()) {}
    ~Stopwatch() {
      sum_ms_ += std::chrono::duration<double, std::milli>(Clock::now() - start_).count();
    }
    Stopwatch(const Stopwatch&) = delete;
    Stopwatch& operator=(const Stopwatch&) = delete;

   private:
    double& sum_ms_;
    Clock::time_point start_;
  };

  std::array<double, 7> ms_{};
};

/// The medians of the stages over several runs:
/// {"read_ms":…,"solidify_ms":…,…,"runs":N} with a line end.
std::string to_json(const std::vector<Timings>& runs);

}  // namespace oriel::cli
