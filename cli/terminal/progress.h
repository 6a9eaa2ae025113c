#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace oriel::cli {

/// How a run says on stderr how far it is: a line that is drawn over and over, a JSON object a line
/// for machines, or not at all.
enum class ProgressStyle { bar, json, none };

/// What `name` (bar, json, none) says; empty: a bar on a terminal, if stdout is no pipe; else
/// nothing. With --log-json there is no bar, and without level info nothing.
ProgressStyle progress_style_of(const std::string& name);

/// "[######..................]", the part that is done; all of it where there is nothing to do.
std::string bar_text(std::uint64_t done, std::uint64_t all);
/// "40 s", "2:05 min", "1:07 h".
std::string time_text(double seconds);

/// Counts of a run so far.
struct ProgressCounts {
  std::uint64_t bytes = 0;  ///< read, of all inputs
  int buildings = 0;
  int set_aside = 0;
};

/// Says how far the inputs are, how fast it goes and how long it will take. The line of a bar is
/// wiped when the object goes. Times stand on stderr only.
class Progress {
 public:
  /// `before`: buildings that an earlier run has done, which say nothing of the rate. What is left
  /// is known if all `inputs` are regular files.
  Progress(ProgressStyle style, const std::vector<std::string>& inputs, int before);
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  [[nodiscard]] ProgressStyle style() const { return style_; }

  /// Says so, unless it was said a moment ago.
  void show(const ProgressCounts& counts);

  /// All is done: the clock stands still.
  void finish(const ProgressCounts& counts);
  [[nodiscard]] double seconds() const;
  [[nodiscard]] double buildings_per_s() const;
  [[nodiscard]] double mb_per_s() const;

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] std::optional<double> seconds_left() const;
  [[nodiscard]] std::string bar() const;
  [[nodiscard]] std::string json() const;
  void wipe();

  ProgressStyle style_;
  int before_;
  std::uint64_t all_bytes_ = 0;  ///< 0: not known
  ProgressCounts counts_;
  bool has_bar_ = false;
  Clock::time_point start_ = Clock::now();
  Clock::time_point last_ = start_;
  std::optional<Clock::time_point> end_;
};

}  // namespace oriel::cli
