#pragma once

#include <array>
#include <chrono>
#include <string>
#include <vector>

namespace oriel::cli {

enum class Stage { read, solidify, segment, describe, interpret, generalise, write };

/// How long the stages took: sums over all buildings of a run, medians over runs. Times never stand
/// in data.
class Timings {
 public:
  /// Begins another run.
  void begin_run() { runs_.emplace_back(); }

  /// Calls `work()` and adds its time to a stage of the present run; returns what it returns.
  template <class Work>
  auto measure(Stage stage, Work work) {
    const Stopwatch watch(runs_.back()[static_cast<std::size_t>(stage)]);
    return work();
  }

  /// {"read_ms":…,"solidify_ms":…,…,"runs":N} with a line end.
  [[nodiscard]] std::string to_json() const;

 private:
  static constexpr std::size_t kStages = 7;
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

  std::vector<std::array<double, kStages>> runs_;
};

}  // namespace oriel::cli
