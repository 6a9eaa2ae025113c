#include "studio/session/learning/learning_job.h"

#include "kernel/base/own_fault.h"
#include "kernel/base/text/counted.h"
#include "studio/editing/proposal_text.h"
#include "studio/session/labels/pack_answer.h"

#include <exception>
#include <utility>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

/// So many parts of the samples are held out in turn.
constexpr std::size_t kFolds = 5;

StudioJson empty_result() {
  return {{"text", ""},
          {"summary", ""},
          {"report", ""},
          {"params", StudioJson::array()},
          {"proposals", StudioJson::array()},
          {"issues", StudioJson::array()}};
}

std::string summary_of(const Learnt& learnt) {
  const std::string of_folds =
      fmt::format("{} on buildings held out: {:.3f} before, {:.3f} after", learnt.objective,
                  learnt.held_out_before, learnt.held_out_after);
  if (learnt.params.empty())
    return "the pack stays as it is" + (learnt.reason.empty() ? "" : ": " + learnt.reason);
  return counted(learnt.params.size(), "param") + " changed; " + of_folds;
}

StudioJson params_of_learnt(const Learnt& learnt, const RuleBase& rules) {
  StudioJson list = StudioJson::array();
  for (const LearntParam& param : learnt.params)
    list.push_back({{"name", param.value.name},
                    {"before", value_text(rules, param.value.name, param.before)},
                    {"after", value_text(rules, param.value.name, param.value.value)},
                    {"gain", rounded(param.gain, 4)},
                    {"folds", param.folds}});
  return list;
}

StudioJson proposal_text_json(const ProposalText& made) {
  return {{"yaml", made.yaml}, {"text", made.text}, {"why_not", made.why_not}};
}

StudioJson proposals_json(const LearningTask& task, const std::vector<Proposal>& proposals) {
  StudioJson list = StudioJson::array();
  for (const Proposal& proposal : proposals) {
    StudioJson json{{"what", proposal.what},
                    {"rule", proposal.rule},
                    {"gain", rounded(proposal.gain, 4)},
                    {"held_out_gain", rounded(proposal.held_out_gain, 4)},
                    {"folds", proposal.folds}};
    json.update(proposal_text_json(text_with_proposal(task.rules, task.text, task.file, proposal)));
    list.push_back(std::move(json));
  }
  return list;
}

}  // namespace

LearningJob::~LearningJob() {
  stop();
  if (thread_.joinable()) thread_.join();
}

void LearningJob::start(LearningTask task) {
  const std::lock_guard lock(mutex_);
  if (state_ == State::running)
    throw RefusedRequest(409, "learning is running already; stop it before you begin again");
  if (thread_.joinable()) thread_.join();
  is_stopped_ = false;
  state_ = State::running;
  done_ = all_ = 0;
  result_ = empty_result();
  thread_ = std::thread([this, task = std::move(task)]() mutable { learn(std::move(task)); });
}

void LearningJob::stop() { is_stopped_ = true; }

StudioJson LearningJob::accept(std::size_t proposal, const std::string& text) const {
  const std::lock_guard lock(mutex_);
  if (!proposed_for_ || proposal >= proposals_.size())
    throw RefusedRequest(409, "there is no such proposal; learn again");
  return proposal_text_json(text_with_proposal(*proposed_for_, text, file_, proposals_[proposal]));
}

StudioJson LearningJob::json() const {
  const std::lock_guard lock(mutex_);
  static constexpr const char* kNames[] = {"idle", "running", "done", "failed"};
  StudioJson json{
      {"state", kNames[static_cast<std::size_t>(state_)]}, {"done", done_}, {"all", all_}};
  json.update(state_ == State::idle ? empty_result() : result_);
  return json;
}

std::shared_ptr<const Learnt> LearningJob::learnt(const RuleBase& rules) const {
  const std::lock_guard lock(mutex_);
  return learnt_from_ == rules.sha256() ? learnt_ : nullptr;
}

void LearningJob::learn(LearningTask task) {
  task.options.step = [&](std::size_t done, std::size_t all) {
    const std::lock_guard lock(mutex_);
    done_ = done;
    all_ = all;
  };
  try {
    if (run(task)) return;
    const std::lock_guard lock(mutex_);
    state_ = State::idle;
  } catch (const std::exception& fault) {
    fail({own_fault(fault)});
  }
}

bool LearningJob::run(const LearningTask& task) {
  const IsGivenUp is_given_up = [this] { return is_stopped_.load(); };
  const std::vector<Sample>& samples = task.samples->samples;
  const auto parts = folds_of(samples.size(), kFolds, task.options.seed);
  const auto learnt =
      learn_params(task.rules, samples, parts, task.options, task.for_each, is_given_up);
  if (!learnt.value && has_errors(learnt.issues)) fail(learnt.issues);
  if (!learnt.value) return has_errors(learnt.issues);
  std::optional<std::vector<Proposal>> proposals(std::in_place);
  if (task.proposes) {
    ProposeOptions options;
    options.objective = task.options.objective;
    options.penalty = task.options.penalty;
    proposals = propose(task.rules, samples, parts, options, task.for_each, is_given_up);
  }
  if (proposals) finish(task, *learnt.value, *proposals, learnt.issues);
  return proposals.has_value();
}

void LearningJob::finish(const LearningTask& task, const Learnt& learnt,
                         const std::vector<Proposal>& proposals, const std::vector<Issue>& issues) {
  std::vector<ParamValue> values;
  for (const LearntParam& param : learnt.params) values.push_back(param.value);
  StudioJson result{{"text", text_with_params(task.rules, task.text, values)},
                    {"summary", summary_of(learnt)},
                    {"report", to_text(learnt, task.rules)},
                    {"params", params_of_learnt(learnt, task.rules)},
                    {"proposals", proposals_json(task, proposals)},
                    {"issues", issues_json(issues)}};
  const std::lock_guard lock(mutex_);
  learnt_ = std::make_shared<const Learnt>(learnt);
  learnt_from_ = task.rules.sha256();
  proposals_ = proposals;
  proposed_for_ = task.rules;
  file_ = task.file;
  result_ = std::move(result);
  done_ = all_;
  state_ = State::done;
}

void LearningJob::fail(const std::vector<Issue>& issues) {
  StudioJson result = empty_result();
  for (const Issue& issue : issues)
    if (issue.severity == Severity::error && result["summary"] == "")
      result["summary"] = issue.sentence;
  result["issues"] = issues_json(issues);
  const std::lock_guard lock(mutex_);
  result_ = std::move(result);
  state_ = State::failed;
}

}  // namespace oriel::studio
