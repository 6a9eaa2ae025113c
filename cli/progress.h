#pragma once

#include <chrono>
#include <cstddef>

namespace oriel::cli {

/// A line on a terminal's stderr that says how far the inputs are, how fast it goes and how long it
/// will take; nothing where stderr is no terminal. The line is wiped when the object goes.
class Progress {
 public:
  explicit Progress(std::size_t inputs);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// `input` inputs are done, `buildings` buildings of them and of the one at hand.
  void show(std::size_t input, int buildings);

 private:
  using Clock = std::chrono::steady_clock;
  std::size_t inputs_;
  bool is_shown_;
  bool has_written_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
};

}  // namespace oriel::cli
