#pragma once

#include "cli/terminal/progress.h"

#include <chrono>
#include <cstddef>
#include <string>

namespace oriel::cli {

/// Says on stderr how far a run of several steps is: as a bar with the time that the step at hand
/// will still take, or a JSON object a line. The line of a bar is wiped when the object goes.
class StepProgress {
 public:
  explicit StepProgress(ProgressStyle style) : style_(style) {}
  ~StepProgress();
  StepProgress(const StepProgress&) = delete;
  StepProgress& operator=(const StepProgress&) = delete;

  /// `done` of `all` pieces of the step `what` are done. Says so, unless it was said a moment ago.
  void show(const std::string& what, std::size_t done, std::size_t all);

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] std::string bar(double seconds_left, std::size_t done, std::size_t all) const;

  ProgressStyle style_;
  std::string what_;
  bool has_bar_ = false;
  Clock::time_point start_ = Clock::now();  ///< of the step
  Clock::time_point last_{};
};

}  // namespace oriel::cli
