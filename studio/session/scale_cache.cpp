#include "studio/session/scale_cache.h"

#include <algorithm>
#include <utility>

namespace oriel::studio {

ScaleCache::Answer ScaleCache::get(const std::string& key, const std::function<Answer()>& make) {
  std::promise<Answer> promise;
  {
    std::unique_lock lock(mutex_);
    if (const auto known = answers_.find(key); known != answers_.end()) {
      const std::shared_future<Answer> answer = known->second;
      lock.unlock();
      return answer.get();
    }
    answers_.emplace(key, promise.get_future().share());
    keys_.push_back(key);
    if (keys_.size() > kMostScales) {
      answers_.erase(keys_.front());
      keys_.pop_front();
    }
  }
  try {
    Answer answer = make();
    if (!answer) forget(key);
    promise.set_value(answer);
    return answer;
  } catch (...) {
    promise.set_exception(std::current_exception());
    forget(key);
    throw;
  }
}

void ScaleCache::forget(const std::string& key) {
  const std::lock_guard lock(mutex_);
  answers_.erase(key);
  std::erase(keys_, key);
}

}  // namespace oriel::studio
