#include "cli/batch/run.h"
#include "cli/terminal/logging.h"
#include "kernel/base/sha256.h"
#include "kernel/io/files/partial_files.h"

#include <stdexcept>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::cli {

using nlohmann::ordered_json;

/// False if there is nothing to do: the same command has come to its end before.
bool Run::begin_books(const Visitor& visitor) {
  if (arguments_.status_stem.empty()) return true;
  PartialFiles::watch();
  if (arguments_.is_resumable) {
    resume_.emplace(arguments_, rules_ != nullptr ? rules_->sha256() : "");
    if (const auto finished = resume_->finished()) {
      was_done_ = true;
      code_ = static_cast<ExitCode>(*finished);
      run_log().info("all of it was done before");
      return false;
    }
  }
  if (!arguments_.reuse.empty()) begin_reuse(visitor.recipe);
  ledger_.emplace(arguments_.status_stem);
  if (resume_ && resume_->state()) restore(*resume_->state(), visitor);
  return true;
}

/// Results are taken from a run of the same program with the same rules and options only.
void Run::begin_reuse(const std::string& recipe) {
  const Selection& selection = arguments_.selection;
  const std::string all = fmt::format(
      "{} {} {} rules={} program={} selection={} {} {} {} {} {}", recipe,
      arguments_.configuration(), arguments_.from, rules_ != nullptr ? rules_->sha256() : "",
      program_sha256(), fmt::join(selection.ids, ","), fmt::join(selection.bbox, ","),
      selection.cotype, selection.one_in, selection.seed, selection.is_exclusion);
  const std::string recipe_sha256 = sha256(all);
  earlier_.emplace(arguments_.reuse, recipe_sha256);
  if (earlier_->fault()) report_.tell(*earlier_->fault());
  notes_.emplace(arguments_.status_stem, recipe_sha256);
}

ordered_json Run::state(const Visitor& visitor) const {
  ordered_json state{
      {"buildings", buildings_},
      {"set_aside", set_aside_},
      {"open", open_},
      {"code", static_cast<int>(code_)},
      {"labels", labels_},
      {"errors", report_.errors()},
      {"counted", {records_.read, records_.refused, records_.not_selected, records_.passed_on}},
      {"ledger", ledger_->state()}};
  if (visitor.counts != nullptr) state["counts"] = *visitor.counts;
  return state;
}

void Run::restore(const ordered_json& state, const Visitor& visitor) {
  using Counts = std::map<std::string, int>;
  buildings_ = state.at("buildings");
  set_aside_ = state.at("set_aside");
  open_ = state.at("open");
  code_ = static_cast<ExitCode>(state.at("code").get<int>());
  labels_ = state.at("labels").get<Counts>();
  report_.restore(state.at("errors").get<Counts>());
  const ordered_json& counted = state.at("counted");
  records_ = {counted[0], counted[1], counted[2], counted[3]};
  ledger_->restore(state.at("ledger"));
  if (visitor.counts != nullptr) *visitor.counts = state.at("counts").get<Counts>();
  run_log().info("resumes after {} building{}", buildings_, buildings_ == 1 ? "" : "s");
}

/// The arrival is done: from here the run can go on.
void Run::note(const Arrival& arrival, const Visitor& visitor) {
  if (!resume_) return;
  const bool is_record = arrival.kind == Arrival::Kind::record;
  resume_->note({is_record ? arrival.input : arrival.input + 1, is_record ? arrival.number : 0,
                 is_record ? arrival.sha256 : ""},
                state(visitor));
}

void Run::close_books() {
  if (records_.read != records_.passed_on + records_.refused + records_.not_selected)
    throw std::logic_error(
        fmt::format("of {} records {} were passed on, {} refused, {} not selected", records_.read,
                    records_.passed_on, records_.refused, records_.not_selected));
  if (notes_) notes_->commit();
  if (earlier_) run_log().info("took {} records from {}", reused_, arguments_.reuse);
  ledger_->close();
  Account account;
  account.inputs = arguments_.inputs;
  account.input_sha256 = input_sha256_;
  if (resume_)
    for (const auto& [name, mark] : resume_->read()) account.input_sha256[name] = mark.sha256;
  if (resume_) account.command_sha256 = resume_->command_sha256();
  account.outputs = resume_ ? resume_->done() : PartialFiles::take_done();
  account.records = records_;
  if (rules_ != nullptr) account.rules_sha256 = rules_->sha256();
  account.config_sha256 = sha256(arguments_.configuration());
  account.buildings = buildings_;
  account.set_aside = set_aside_;
  account.labels = labels_;
  account.exit_code = static_cast<int>(code_);
  ledger_->commit(account);
}

}  // namespace oriel::cli
