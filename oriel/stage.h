#pragma once

#include <chrono>
#include <functional>

namespace oriel {

/// The stages that a building passes, and those before and after.
enum class Stage { read, solidify, segment, describe, interpret, generalise, write };

/// Is called after each stage with the milliseconds that it took. Results do not depend on it. A
/// call works on one thread; whoever shares an observer between threads guards it.
using StageObserver = std::function<void(Stage stage, double ms)>;

/// Reports to an observer, if there is one, for how long it existed.
class Stopwatch {
 public:
  /// The observer must outlive it.
  Stopwatch(const StageObserver& observer, Stage stage) : observer_(observer), stage_(stage) {}
  ~Stopwatch() {
    const std::chrono::duration<double, std::milli> took =
        std::chrono::steady_clock::now() - start_;
    if (observer_) observer_(stage_, took.count());
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  const StageObserver& observer_;
  Stage stage_;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

/// Calls `work()`, reports its time and returns what it returns.
template <class Work>
auto measure(const StageObserver& observer, Stage stage, Work work) {
  const Stopwatch watch(observer, stage);
  return work();
}

}  // namespace oriel
