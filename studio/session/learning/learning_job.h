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
  /// The pack's own text, and the path that it has or will have.
  std::string text, file;
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
  /// Ends it as soon as the work at hand can be left.
  void stop();
  /// The change of rules with that number among the proposals, made in a text that may have been
  /// edited meanwhile: {yaml, text, why_not}. Throws RefusedRequest 409 if there is none.
  [[nodiscard]] StudioJson accept(std::size_t proposal, const std::string& text) const;
  /// {state, done, all, text, summary, report, params, proposals, issues}.
  [[nodiscard]] StudioJson json() const;
  /// What was learnt last with these rules, if anything was.
  [[nodiscard]] std::shared_ptr<const Learnt> learnt(const RuleBase& rules) const;

 private:
  enum class State { idle, running, done, failed };

  /// False if it was stopped.
  bool run(const LearningTask& task);
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
  /// Changes of rules that were proposed last, the pack that they were proposed for, and its path.
  std::vector<Proposal> proposals_;
  std::optional<RuleBase> proposed_for_;
  std::string file_;
  std::atomic<bool> is_stopped_ = false;
  std::thread thread_;
};

}  // namespace oriel::studio
