#include "cli/batch/batch_runner.h"

#include "cli/batch/arena.h"
#include "cli/batch/isolation.h"
#include "cli/terminal/logging.h"
#include "cli/terminal/table.h"
#include "io/files/output_file.h"
#include "io/files/partial_files.h"
#include "io/records/feature_records.h"
#include "kernel/base/log.h"
#include "kernel/base/own_fault.h"
#include "kernel/base/sha256.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/printable.h"

#include <algorithm>
#include <oneapi/tbb/parallel_pipeline.h>
#include <stdexcept>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#if defined(__SANITIZE_THREAD__)
extern "C" void __tsan_acquire(void*);
extern "C" void __tsan_release(void*);
#endif

namespace oriel::cli {

using nlohmann::ordered_json;

namespace {

/// What one thread did to `what` before it was handed on is seen by the one that takes it over. TBB
/// does that; its library is not instrumented, so the thread sanitizer is told.
void hand_on([[maybe_unused]] const void* what) {
#if defined(__SANITIZE_THREAD__)
  __tsan_release(const_cast<void*>(what));
#endif
}

void take_over([[maybe_unused]] const void* what) {
#if defined(__SANITIZE_THREAD__)
  __tsan_acquire(const_cast<void*>(what));
#endif
}

/// Tables that the first to ask for them makes are made before there are threads: where rooms are
/// built without the thread sanitizer, it does not see that the others wait for the first.
void make_tables() {
#if defined(__SANITIZE_THREAD__)
  static_cast<void>(record_fields());
  static_cast<void>(surface_schema());
#endif
}

/// The medians of the stages over several runs:
/// {"read_ms":…,"solidify_ms":…,…,"runs":N} with a line end.
std::string timings_json(const std::vector<Timings>& runs) {
  std::string out = "{";
  for (std::size_t s = 0; s < kStageNames.size(); ++s) {
    std::vector<double> values;
    for (const Timings& run : runs) values.push_back(run.ms(static_cast<Stage>(s)));
    std::ranges::sort(values);
    const std::size_t n = values.size();
    const double median = n == 0 ? 0 : (values[(n - 1) / 2] + values[n / 2]) / 2;
    out += fmt::format("\"{}_ms\":{:.3f},", kStageNames[s], median);
  }
  return out + fmt::format("\"runs\":{}}}\n", runs.size());
}

}  // namespace

ExitCode BatchRunner::run(VisitingCommand& command) {
  command_ = visitor_ = &command;
  return run_all();
}

ExitCode BatchRunner::run(ProducingCommand& command) {
  command_ = producer_ = &command;
  return run_all();
}

ExitCode BatchRunner::run_all() {
  const auto stdins = std::ranges::count(options_.inputs, "-");
  if (stdins > 1 || (stdins > 0 && options_.repeat > 1))
    throw CLI::ValidationError("input",
                               "stdin can be read only once: give - once, and no --repeat");
  for (const auto& [option, is_given] : {std::pair("--isolate", options_.is_isolated),
                                         std::pair("--reuse", !options_.reuse.empty())})
    if (producer_ == nullptr && is_given)
      throw CLI::ValidationError(option, "works only with commands that write record by record");
  if (options_.is_resumable && (producer_ == nullptr || !producer_->writes_files()))
    throw CLI::ValidationError("--resume", "needs outputs that are files: -o, --features, --table");
  NamedFiles files;
  files.add(options_);
  command_->name_files(files);
  replaces_input_ = files.check();
  if (!begin_status()) return state_.code;
  const bool is_all_read =
      resume_ && resume_->state() && resume_->position().input >= options_.inputs.size();
  if (producer_ != nullptr && is_all_read && state_.code != ExitCode::input) producer_->reopen();
  for (run_ = 1; run_ <= options_.repeat; ++run_) {
    timings_.emplace_back();
    if (!resume_) state_ = {.code = state_.code};
    run_inputs();
    progress_->finish(progress_counts());
    log_stages();
  }
  command_->commit();
  if (!options_.timings_file.empty()) write_file(options_.timings_file, timings_json(timings_));
  if (state_.code == ExitCode::set_aside && options_.allows(state_.set_aside, state_.buildings))
    state_.code = ExitCode::clean;
  report_emptiness();
  report_featureless();
  report_.finish();
  if (status_) write_status();
  if (resume_) resume_->remove();
  return state_.code;
}

/// Says what was asked for and is not there; nothing on which to work is no clean end either.
void BatchRunner::report_emptiness() {
  if (state_.code == ExitCode::input || !options_.reports_emptiness) return;
  const bool has_any = state_.buildings > 0 || command_->other_features() > 0;
  std::vector<Issue> issues = options_.selection.unmet(state_.found_ids, has_any, seen_ids_);
  if (options_.selection.is_all() && !has_any)
    issues.push_back(nothing_to_work_on(options_.inputs, "no building"));
  if (issues.empty()) return;
  report_.add(issues);
  state_.raise(ExitCode::set_aside);
}

/// Of all buildings together: of some of them the summary has the number.
void BatchRunner::report_featureless() {
  const int done = state_.buildings - state_.set_aside;
  if (!options_.seeks_features || done == 0 || state_.featureless < done) return;
  report_.add(no_feature_found(options_.inputs, done));
  if (options_.gives_only_features) state_.raise(ExitCode::set_aside);
}

/// How many buildings have no features while others have; else 0.
int BatchRunner::partly_featureless() const {
  const bool is_part = state_.featureless < state_.buildings - state_.set_aside;
  return options_.seeks_features && is_part ? state_.featureless : 0;
}

/// False if there is nothing to do: the same command has come to its end before.
bool BatchRunner::begin_status() {
  if (options_.status_stem.empty()) return true;
  PartialFiles::watch();
  if (producer_ != nullptr && producer_->writes_files() && options_.repeat == 1 &&
      !options_.is_forced && !begin_journal())
    return false;
  if (!options_.reuse.empty()) {
    cache_.emplace(options_.reuse, options_.status_stem, recipe_sha256());
    if (cache_->fault()) report_.add(*cache_->fault());
  }
  status_.emplace(options_.status_stem);
  if (!resume_ || !resume_->state()) return true;
  try {
    restore(*resume_->state());
  } catch (const ordered_json::exception&) {
    throw damaged_journal(resume_->path());
  }
  return true;
}

/// False if there is nothing to do.
bool BatchRunner::begin_journal() {
  resume_.emplace(options_, recipe_sha256());
  if (!options_.is_resumable || resume_->state()) return true;
  if (const auto finished = resume_->finished()) {
    was_done_ = true;
    state_.code = *finished;
    run_log().info("there is nothing left to do: the run was complete");
    return false;
  }
  run_log().info("there is nothing to resume from: the run begins with the first record");
  return true;
}

/// Results are taken from a run of the same program with the same rules and options only.
std::string BatchRunner::recipe_sha256() const {
  const Selection& selection = options_.selection;
  return sha256(fmt::format(
      "{} {} {} rules={} program={} selection={} {} {} {} {} {}", producer_->recipe(),
      options_.configuration(), options_.from, rules_ != nullptr ? rules_->sha256() : "",
      program_sha256(), fmt::join(selection.ids, ","), fmt::join(selection.bbox, ","),
      selection.cotype, selection.one_in, selection.seed, selection.is_exclusion));
}

void BatchRunner::run_inputs() {
  progress_.emplace(progress_style_of(options_.progress), options_.inputs, state_.buildings);
  InputReader reader(options_, resume_ ? resume_->position() : InputPosition{});
  if (options_.is_isolated) return run_isolated(reader);
  if (options_.jobs > 1) return run_in_threads(reader);
  const RecordWorker worker = this->worker();
  while (const auto item = next(reader)) {
    reuse(*item);
    worker.work_on(*item);
    settle(*item);
  }
}

void BatchRunner::run_in_threads(InputReader& reader) {
  constexpr std::size_t kRecordsPerJob = 4;
  // A record goes through the line in a slot of its own: so many are held in memory at most. What
  // TBB itself hands on is the address, which needs no memory that two threads would see.
  using Slot = std::unique_ptr<WorkItem>;
  std::vector<Slot> slots(kRecordsPerJob * static_cast<std::size_t>(options_.jobs));
  std::size_t items_read = 0;
  make_tables();
  const RecordWorker worker = this->worker();
  const auto read = [&](tbb::flow_control& control) -> Slot* {
    take_over(&reader);
    Slot& slot = slots[items_read++ % slots.size()];
    take_over(&slot);
    slot = next(reader);
    if (!slot) control.stop();
    hand_on(&slot);
    hand_on(&reader);
    return &slot;
  };
  const auto work = [&](Slot* slot) {
    take_over(slot);
    reuse(**slot);
    worker.work_on(**slot);
    hand_on(slot);
    return slot;
  };
  const auto end = [&](Slot* slot) {
    take_over(slot);
    take_over(this);
    settle(**slot);
    slot->reset();
    hand_on(slot);
    hand_on(this);
  };
  in_arena(options_.jobs, [&] {
    tbb::parallel_pipeline(
        slots.size(), tbb::make_filter<void, Slot*>(tbb::filter_mode::serial_in_order, read) &
                          tbb::make_filter<Slot*, Slot*>(tbb::filter_mode::parallel, work) &
                          tbb::make_filter<Slot*, void>(tbb::filter_mode::serial_in_order, end));
  });
  take_over(&reader);
  take_over(this);
}

/// Workers have worked on a copy: issues that they dropped are still here.
void BatchRunner::run_isolated(InputReader& reader) {
  const RecordWorker worker = this->worker();
  const auto next_item = [&] {
    auto item = next(reader);
    if (item) reuse(*item);
    return item;
  };
  const auto settle_item = [&](WorkItem& item) {
    worker.drop_unselected(item);
    settle(item);
  };
  Isolation isolation(options_.jobs, options_.most_seconds,
                      {next_item, [&](WorkItem& item) { worker.work_on(item); }, settle_item});
  isolation.run();
}

std::unique_ptr<WorkItem> BatchRunner::next(InputReader& reader) const {
  auto event = reader.next();
  return event ? std::make_unique<WorkItem>(std::move(*event)) : nullptr;
}

/// Takes from an earlier run what came of the same source.
void BatchRunner::reuse(WorkItem& item) const {
  const Record* record = item.record();
  if (!cache_ || record == nullptr || record->header_sha256.empty() || record->was_done) return;
  const Document& document = *record->document.value;
  item.source_sha256 = sha256(record->header_sha256 + std::string(source_line(document)));
  auto outcome = cache_->find(item.source_sha256);
  item.is_reused = outcome && outcome->buildings.size() == document.buildings.size();
  if (!item.is_reused) return;
  item.outcome = std::move(*outcome);
  worker().drop_unselected(item);
}

void BatchRunner::settle(WorkItem& item) {
  timings().add(item.timings);
  if (const auto* begin = std::get_if<InputBegin>(&item.event)) command_->begin(begin->input);
  if (const Record* record = item.record()) settle(item, *record);
  if (const auto* end = std::get_if<InputEnd>(&item.event)) settle(*end);
  if (const auto* failure = std::get_if<InputFailure>(&item.event)) settle(*failure);
}

void BatchRunner::settle(WorkItem& item, const Record& record) {
  bytes_ = record.bytes;
  if (record.was_done) return;
  errors_.clear();
  report(record.document.issues);
  keep_errors(record.document.issues);
  if (record.document.value)
    settle_read(item, record);
  else
    settle_refused(record);
  if (status_ && is_last_run()) status_->add(record, errors_);
  if (producer_ != nullptr && producer_->is_streaming() && record.line > 0)
    note({record.input, record.number, record.sha256});
  progress_->show(progress_counts());
}

void BatchRunner::settle(const InputEnd& end) {
  bytes_ = end.bytes;
  if (end.is_whole && !loses_records(end)) command_->end(end.input);
  state_.records.read += end.records;
  if (!end.sha256.empty()) input_sha256_[end.input_name] = end.sha256;
  if (resume_) resume_->note_read(end.input_name, end.sha256);
  note({end.input + 1, 0, ""});
}

/// With --force the input is replaced by what was read of it: what could not be would be deleted.
bool BatchRunner::loses_records(const InputEnd& end) {
  const std::size_t refused = std::exchange(refused_of_input_, 0);
  if (!replaces_input_ || refused == 0) return false;
  Issue issue;
  issue.code = Code::E601;
  issue.sentence = fmt::format(
      "nothing is written: {} could not be read and would be lost by --force; name another output",
      counted(refused, "record"));
  issue.place.file = end.input_name;
  report({issue});
  state_.raise(ExitCode::output);
  return true;
}

void BatchRunner::settle(const InputFailure& failure) {
  bytes_ = failure.bytes;
  report({failure.issue});
  if (status_ && is_last_run()) status_->add_unread(failure.input_name, failure.issue);
  state_.raise(ExitCode::input);
  state_.records.read += failure.records;
  note({failure.input + 1, 0, ""});
}

/// A line that cannot be read counts as one building.
void BatchRunner::settle_refused(const Record& record) {
  ++state_.records.refused;
  ++refused_of_input_;
  state_.raise(record.is_one_of_many ? ExitCode::set_aside : ExitCode::input);
  if (!record.is_one_of_many) return;
  ++state_.buildings;
  ++state_.set_aside;
}

void BatchRunner::settle_read(WorkItem& item, const Record& record) {
  note_found_ids(record.document);
  if (worker().is_passed_over(item)) {
    ++state_.records.not_selected;
    return;
  }
  ++state_.records.passed_on;
  // Errors of a document that was read are buildings that could not be.
  const auto unread = static_cast<int>(
      std::ranges::count(record.document.issues, Severity::error, &Issue::severity));
  state_.buildings += unread;
  state_.set_aside += unread;
  if (unread > 0) state_.raise(ExitCode::set_aside);
  for (const BuildingOutcome& building : item.outcome.buildings) {
    if (building.is_passed_over) continue;
    ++state_.buildings;
    report(building.issues);
    if (!building.is_done) {
      keep_errors(building.issues);
      ++state_.set_aside;
      state_.raise(ExitCode::set_aside);
    }
    if (building.is_open) ++state_.open;
    if (building.is_done && !building.has_features) ++state_.featureless;
    for (const auto& [label, count] : building.labels) state_.labels[label] += count;
  }
  if (producer_ != nullptr)
    settle_product(item, *record.document.value);
  else
    visitor_->visit(*record.document.value, item.results);
}

/// Of those that --id names, also of buildings that cannot be read, lie elsewhere, or are passed
/// over by --exclude.
void BatchRunner::note_found_ids(const Checked<Document>& document) {
  const std::vector<std::string>& ids = options_.selection.ids;
  if (ids.empty()) return;
  constexpr std::size_t kMostSeen = 10'000;
  const auto note = [&](const std::string& id) {
    if (std::ranges::find(ids, id) != ids.end()) state_.found_ids.insert(id);
    if (run_ == 1 && seen_ids_.size() < kMostSeen) seen_ids_.push_back(id);
  };
  for (const Building& building : document.value->buildings) note(building.id);
  for (const Issue& issue : document.issues) note(issue.place.building);
}

void BatchRunner::settle_product(WorkItem& item, const Document& document) {
  Product& product = item.outcome.product;
  reused_ += item.is_reused ? 1 : 0;
  const auto is_lasting = [](const BuildingOutcome& building) {
    return std::ranges::none_of(building.issues, is_own_fault);
  };
  if (cache_ && !item.source_sha256.empty() && item.lost.empty() &&
      std::ranges::all_of(item.outcome.buildings, is_lasting))
    cache_->add(item.source_sha256, producer_->places(), item.outcome);
  for (const Issue& issue : product.issues) {
    if (issue.severity == Severity::error)
      set_aside(issue);
    else
      report({issue});
  }
  if (auto* counts = producer_->counts())
    for (const auto& [name, count] : product.counts) (*counts)[name] += count;
  timings().measure(Stage::write, [&] { producer_->take(document, std::move(product)); });
}

void BatchRunner::set_aside(const Issue& why) {
  // A building that several errors name is one.
  const std::string& id = why.place.building;
  if (id.empty() ||
      std::ranges::none_of(errors_, [&](const Issue& known) { return known.place.building == id; }))
    ++state_.set_aside;
  state_.raise(ExitCode::set_aside);
  report({why});
  errors_.push_back(why);
}

void BatchRunner::report(const std::vector<Issue>& issues) {
  if (run_ == 1) report_.add(issues);
}

void BatchRunner::keep_errors(const std::vector<Issue>& issues) {
  for (const Issue& issue : issues)
    if (issue.severity == Severity::error) errors_.push_back(issue);
}

/// From here the run can go on.
void BatchRunner::note(const InputPosition& position) {
  if (!resume_) return;
  ordered_json journal = to_json(state_);
  journal["errors"] = report_.errors();
  journal["ledger"] = status_->state();
  if (auto* counts = producer_ != nullptr ? producer_->counts() : nullptr)
    journal["counts"] = *counts;
  resume_->note(position, std::move(journal));
}

void BatchRunner::restore(const ordered_json& journal) {
  state_ = run_state_of(journal);
  report_.restore(counts_of(journal.at("errors")));
  status_->restore(journal.at("ledger"));
  if (auto* counts = producer_ != nullptr ? producer_->counts() : nullptr)
    *counts = counts_of(journal.at("counts"));
  run_log().info("resumes after {}", counted(state_.buildings, "building"));
}

void BatchRunner::write_status() {
  const RecordCounts& records = state_.records;
  if (!records.add_up())
    throw std::logic_error(
        fmt::format("of {} records {} were passed on, {} refused, {} not selected", records.read,
                    records.passed_on, records.refused, records.not_selected));
  if (cache_) {
    cache_->commit();
    run_log().info("took {} from {}", counted(reused_, "record"), printable(options_.reuse));
  }
  status_->close();
  RunStatus status;
  status.inputs = options_.inputs;
  status.input_sha256 = input_sha256_;
  if (resume_)
    for (const auto& [name, mark] : resume_->read()) status.input_sha256[name] = mark.sha256;
  status.outputs = resume_ ? resume_->done() : PartialFiles::take_done();
  if (rules_ != nullptr) status.rules_sha256 = rules_->sha256();
  status.config_sha256 = sha256(options_.configuration());
  status.state = state_;
  if (resume_) status.run_sha256 = run_sha256(status, resume_->command_sha256());
  status_->commit(status);
}

/// One line for each stage that took time.
void BatchRunner::log_stages() const {
  for (std::size_t s = 0; s < kStageNames.size(); ++s)
    if (const double ms = timings_.back().ms(static_cast<Stage>(s)); ms > 0)
      log("oriel").info("stage {}: buildings={} set_aside={} ms={:.0f}", kStageNames[s],
                        state_.buildings, state_.set_aside, ms);
}

ProgressCounts BatchRunner::progress_counts() const {
  return {bytes_, state_.buildings, state_.set_aside};
}

void BatchRunner::report_summary(const std::string& verb, const std::map<std::string, int>& counts,
                                 const std::string& suffix) const {
  if (progress_ && progress_->style() == ProgressStyle::bar)
    return run_log().write(LogLevel::info, summary_table(verb, counts, suffix));
  std::vector<std::string> parts;
  for (const auto& [label, count] : counts)
    if (!label.empty()) parts.push_back(fmt::format("{} {}", count, printable(label)));
  if (const auto unknown = counts.find(""); unknown != counts.end())
    parts.push_back(fmt::format("{} unknown", unknown->second));
  std::string text = fmt::format(
      "{} {}", counted_of(state_.buildings - state_.set_aside, state_.buildings, "building"), verb);
  if (!parts.empty()) text += fmt::format(": {}{}", fmt::join(parts, ", "), suffix);
  if (state_.open > 0) text += fmt::format("; {} open", state_.open);
  if (const int without = partly_featureless(); without > 0)
    text += fmt::format("; {} without features", without);
  if (state_.set_aside > 0) text += fmt::format("; {} rejected", state_.set_aside);
  std::vector<std::string> codes;
  for (const auto& [code, count] : report_.errors())
    codes.push_back(fmt::format("{} {}", code, count));
  if (state_.set_aside > 0 && !codes.empty()) text += fmt::format(" ({})", fmt::join(codes, ", "));
  run_log().write(LogLevel::info, text);
}

std::string BatchRunner::summary_table(const std::string& verb,
                                       const std::map<std::string, int>& counts,
                                       const std::string& suffix) const {
  std::vector<std::vector<std::string>> rows{{verb, "count"}};
  const auto add = [&](const std::string& what, int count) {
    rows.push_back({what, std::to_string(count)});
  };
  add("buildings", state_.buildings);
  add("done", state_.buildings - state_.set_aside);
  if (state_.open > 0) add("open", state_.open);
  if (const int without = partly_featureless(); without > 0) add("without features", without);
  add("rejected", state_.set_aside);
  for (const auto& [code, count] : report_.errors()) add("  " + code, count);
  for (const auto& [label, count] : counts)
    add("feature " + (label.empty() ? "unknown" : label) + suffix, count);
  return fmt::format("{}{:.1f} s, {:.1f} buildings/s, {:.2f} MB/s", table(rows),
                     progress_->seconds(), progress_->buildings_per_s(), progress_->mb_per_s());
}

}  // namespace oriel::cli
