#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <mutex>
#include <string>
#include <utility>

namespace oriel::studio {

/// Requests of one kind of which only the newest is still of use. Functions may be called from any
/// thread.
class NewestWins {
 public:
  /// Begins a request for `what`: those before it that asked for something else are given up. The
  /// answer says whether this one is, by now; it may be asked as long as this exists.
  [[nodiscard]] std::function<bool()> begin(std::string what) {
    const std::lock_guard lock(mutex_);
    if (what != what_) ++newest_;
    what_ = std::move(what);
    return [this, number = newest_.load()] { return newest_ != number; };
  }

  /// Gives up all that have begun.
  void give_up_all() {
    const std::lock_guard lock(mutex_);
    ++newest_;
    what_.clear();
  }

 private:
  std::mutex mutex_;
  std::string what_;
  std::atomic<std::uint64_t> newest_ = 0;
};

}  // namespace oriel::studio
