#include "studio/session/labels/pack_runner.h"

#include "studio/lsp/editing_json.h"
#include "studio/session/labels/pack_answer.h"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

namespace oriel::studio {

namespace {

constexpr const char* kNewerPack = "a newer pack came";

/// True if everything that is loaded by now is labelled, with the truth as it is now.
bool is_up_to_date(const LabelledBuildings& labelled, const BuildingList& buildings,
                   std::uint64_t truth_number) {
  if (labelled.buildings.size() != buildings.size()) return false;
  for (std::size_t i = 0; i < buildings.size(); ++i) {
    const auto& known = labelled.buildings[i];
    if (!known != !buildings[i] || (known && known->truth_number != truth_number)) return false;
  }
  return true;
}

}  // namespace

std::shared_ptr<const LabelledBuildings> PackRunner::last() const {
  const std::lock_guard lock(mutex_);
  return last_;
}

EditedPack PackRunner::edited(const std::string& text) const { return {text, file_.name()}; }

std::shared_ptr<const LabelledBuildings> PackRunner::label(
    const RuleBase& rules, const std::string& text, const std::vector<std::string>& assignments,
    std::uint64_t ticket) {
  const auto before = last();
  const auto truth = corrections_.truth();
  const std::uint64_t number = before ? before->number + 1 : 1;
  const std::function<bool()> is_given_up = [&] { return newest_ > ticket; };
  auto labelled =
      label_buildings({number, rules, text, assignments, {}}, buildings_.list(), *truth,
                      before.get(), {options_.for_each, options_.work_log, is_given_up});
  if (!labelled) return nullptr;
  const std::lock_guard lock(mutex_);
  last_ = labelled;
  return labelled;
}

StudioJson PackRunner::run(const RequestBody& body) {
  const std::string text = body.text("text");
  const std::size_t version =
      body.number("version", std::numeric_limits<std::size_t>::max(), "version");
  const auto assignments = body.assignments("params");
  const std::uint64_t since =
      body.has("since")
          ? body.number("since", std::numeric_limits<std::size_t>::max(), "set of labels")
          : 0;
  const std::uint64_t ticket = ++newest_;
  const std::lock_guard lock(running_);
  if (newest_ > ticket) refuse_superseded(kNewerPack);
  const auto start = std::chrono::steady_clock::now();
  has_begun_ = true;
  const EditedPack pack = edited(text);
  StudioJson findings = findings_json(pack);
  std::optional<RuleBase> rules = pack.rules();
  if (rules && !assignments.empty()) {
    auto changed = with_params(*rules, assignments);
    for (const Issue& issue : changed.issues) findings.push_back(finding_json(issue));
    rules = std::move(changed.value);
  }
  StudioJson answer{{"version", version}, {"is_good", rules.has_value()}};
  answer["findings"] = std::move(findings);
  if (rules) {
    const auto before = last();
    const auto labelled = label(*rules, text, assignments, ticket);
    if (!labelled) refuse_superseded(kNewerPack);
    answer["number"] = labelled->number;
    // A number that was not given here is of a worker before this one.
    const std::uint64_t known = since <= labelled->number ? since : 0;
    add_labels(*labelled, {known, before.get()}, answer);
  }
  const std::chrono::duration<double, std::milli> took = std::chrono::steady_clock::now() - start;
  answer["ms"] = rounded(took.count(), 1);
  return answer;
}

std::shared_ptr<const LabelledBuildings> PackRunner::current() {
  const auto is_current = [&](const std::shared_ptr<const LabelledBuildings>& labelled) {
    return labelled && is_up_to_date(*labelled, buildings_.list(), corrections_.truth()->number);
  };
  if (auto labelled = last(); is_current(labelled)) return labelled;
  const std::lock_guard lock(running_);
  const auto labelled = last();
  if (is_current(labelled)) return labelled;
  constexpr std::uint64_t kNeverGivenUp = std::numeric_limits<std::uint64_t>::max();
  if (labelled) return label(labelled->rules, labelled->text, labelled->assignments, kNeverGivenUp);
  if (has_begun_) return nullptr;
  const std::string text = file_.text();
  const auto rules = edited(text).rules();
  return rules ? label(*rules, text, {}, kNeverGivenUp) : nullptr;
}

std::shared_ptr<const LabelledBuildings> PackRunner::need_current() {
  auto labelled = current();
  if (!labelled)
    throw RefusedRequest(409, "the pack has errors, and there was no good one before it");
  return labelled;
}

}  // namespace oriel::studio
