#pragma once

#include "studio/session/learning/sample_store.h"
#include "studio/session/request_body.h"

#include <atomic>
#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

namespace oriel::studio {

/// What is learnt, and from what.
struct LearningTask {
  RuleBase rules;
  /// The pack's own text.
  std::string text;
  std::shared_ptr<const SampleList> samples;
  LearnOptions options;
  /// Changes of rules are looked for, too.
  bool proposes = false;
  ForEachShare for_each;
};

/// One search for better params in the background. Functions may be called from any thread.
class LearningJob {
 public:
  LearningJob() = default;
  /// Stops it.
  ~LearningJob();
  LearningJob(const LearningJob&) = delete;
  LearningJob& operator=(const LearningJob&) = delete;

  /// Throws RefusedRequest 409 if one is running.
  void start(LearningTask task);
  /// Ends it as soon as the step at hand can be left.
  void stop();
  /// {state, done, all, text, summary, report, params, proposals, issues}.
  [[nodiscard]] StudioJson json() const;
  /// What was learnt last with these rules, if anything was.
  [[nodiscard]] std::shared_ptr<const Learnt> learnt(const RuleBase& rules) const;

 private:
  enum class State { idle, running, done, failed };

  void run(const LearningTask& task);
  void learn(LearningTask task);
  void finish(const LearningTask& task, const Learnt& learnt,
              const std::vector<Proposal>& proposals, const std::vector<Issue>& issues);
  void fail(const std::vector<Issue>& issues);

  mutable std::mutex mutex_;
  State state_ = State::idle;
  std::size_t done_ = 0, all_ = 0;
  StudioJson result_;
  std::shared_ptr<const Learnt> learnt_;
  std::string learnt_from_;
  std::atomic<bool> is_stopped_ = false;
  std::thread thread_;
};

}  // namespace oriel::studio
