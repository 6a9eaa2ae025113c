#pragma once

#include "studio/session/request_body.h"

#include <cstddef>
#include <deque>
#include <functional>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <string>

namespace oriel::studio {

/// Buildings redrawn for scales, as they were answered, by all that they depend on. What several
/// threads ask for at once is made once. Functions may be called from any thread.
class ScaleCache {
 public:
  using Answer = std::shared_ptr<const StudioJson>;

  /// What is kept under `key`, else what `make` makes, which is kept then, unless it is null or
  /// `make` throws.
  Answer get(const std::string& key, const std::function<Answer()>& make);

 private:
  void forget(const std::string& key);

  std::mutex mutex_;
  std::map<std::string, std::shared_future<Answer>> answers_;
  /// In the order in which they were asked for first.
  std::deque<std::string> keys_;
};

/// So many are kept; then the oldest goes.
inline constexpr std::size_t kMostScales = 400;

}  // namespace oriel::studio
