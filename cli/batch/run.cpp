#include "cli/batch/run.h"

#include "cli/batch/isolation.h"
#include "kernel/base/log.h"
#include "kernel/base/sha256.h"
#include "kernel/io/files/output_file.h"

#include <algorithm>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

Run::Run(const LineArguments& arguments, const RuleBase* rules, Report& report)
    : arguments_(arguments), rules_(rules), report_(report) {}

ExitCode Run::go(const Visitor& visitor) {
  const auto stdins = std::ranges::count(arguments_.inputs, "-");
  if (stdins > 1 || (stdins > 0 && arguments_.repeat > 1))
    throw CLI::ValidationError("input", "stdin can be read only once");
  if (arguments_.is_isolated && !visitor.make)
    throw CLI::ValidationError("--isolate", "works only with commands that write record by record");
  if (!arguments_.reuse.empty() && !visitor.make)
    throw CLI::ValidationError("--reuse", "works only with commands that write record by record");
  if (!begin_books(visitor)) return code_;
  const bool is_all_read =
      resume_ && resume_->state() && resume_->position().input >= arguments_.inputs.size();
  if (is_all_read && code_ != ExitCode::input) visitor.reopen();
  for (run_ = 1; run_ <= arguments_.repeat; ++run_) {
    timings_.emplace_back();
    if (!resume_) {
      buildings_ = set_aside_ = open_ = 0;
      labels_.clear();
      records_ = {};
    }
    run_inputs(visitor);
    progress_->finish({bytes_, buildings_, set_aside_});
    log_stages();
  }
  visitor.commit();
  if (!arguments_.timings_file.empty()) write_file(arguments_.timings_file, to_json(timings_));
  if (code_ == ExitCode::set_aside && arguments_.allows(set_aside_, buildings_))
    code_ = ExitCode::clean;
  if (ledger_) close_books();
  if (resume_) resume_->remove();
  return code_;
}

/// One line for each stage that took time.
void Run::log_stages() const {
  for (std::size_t s = 0; s < kStageNames.size(); ++s)
    if (const double ms = timings_.back().ms(static_cast<Stage>(s)); ms > 0)
      log("oriel").info("stage {}: buildings={} set_aside={} ms={:.0f}", kStageNames[s], buildings_,
                        set_aside_, ms);
}

void Run::keep_errors(const std::vector<Issue>& issues) {
  for (const Issue& issue : issues)
    if (issue.severity == Severity::error) errors_.push_back(issue);
}

void Run::tell(const std::vector<Issue>& issues) {
  if (run_ == 1) report_.tell(issues);
}

void Run::set_aside(const Issue& why) {
  ++set_aside_;
  raise(ExitCode::set_aside);
  tell({why});
  errors_.push_back(why);
}

void Run::run_inputs(const Visitor& visitor) {
  progress_.emplace(progress_style_of(arguments_.progress), arguments_.inputs, buildings_);
  Intake intake(arguments_, resume_ ? resume_->position() : Resume::Position{});
  if (arguments_.is_isolated) return run_isolated(intake, visitor);
  if (arguments_.jobs == 1) {
    while (const auto arrival = intake.next()) {
      if (earlier_) reuse(*arrival);
      work_on(*arrival, visitor);
      settle(*arrival, visitor);
    }
    return;
  }
  // So many records are held in memory at most.
  constexpr std::size_t kRecordsPerJob = 4;
  using Item = std::shared_ptr<Arrival>;
  const tbb::global_control more_than_cores(tbb::global_control::max_allowed_parallelism,
                                            static_cast<std::size_t>(arguments_.jobs));
  tbb::task_arena arena(arguments_.jobs);
  const std::size_t records = kRecordsPerJob * static_cast<std::size_t>(arguments_.jobs);
  const auto read = [&](tbb::flow_control& control) {
    Item arrival = intake.next();
    if (!arrival) control.stop();
    return arrival;
  };
  const auto work = [&](Item arrival) {
    if (earlier_) reuse(*arrival);
    work_on(*arrival, visitor);
    return arrival;
  };
  const auto end = [&](const Item& arrival) { settle(*arrival, visitor); };
  arena.execute([&] {
    tbb::parallel_pipeline(
        records, tbb::make_filter<void, Item>(tbb::filter_mode::serial_in_order, read) &
                     tbb::make_filter<Item, Item>(tbb::filter_mode::parallel, work) &
                     tbb::make_filter<Item, void>(tbb::filter_mode::serial_in_order, end));
  });
}

/// Workers have worked on a copy: issues that they dropped are still here.
void Run::run_isolated(Intake& intake, const Visitor& visitor) {
  const auto next = [&] {
    auto arrival = intake.next();
    if (arrival && earlier_) reuse(*arrival);
    return arrival;
  };
  const auto settle_it = [&](Arrival& arrival) {
    drop_unselected(arrival);
    settle(arrival, visitor);
  };
  Isolation isolation(arguments_.jobs, arguments_.most_seconds,
                      {next, [&](Arrival& arrival) { work_on(arrival, visitor); }, settle_it});
  isolation.run();
}

void Run::settle(Arrival& arrival, const Visitor& visitor) {
  bytes_ = arrival.bytes;
  timings().add(arrival.timings);
  switch (arrival.kind) {
    case Arrival::Kind::begin:
      return visitor.begin(arrival.input);
    case Arrival::Kind::record:
      if (arrival.was_done) return;
      errors_.clear();
      tell(arrival.record.issues);
      keep_errors(arrival.record.issues);
      if (arrival.record.value)
        settle_record(arrival, visitor);
      else
        settle_refused(arrival);
      if (ledger_ && is_last_run()) ledger_->add(arrival, errors_);
      if (visitor.is_streaming && arrival.line > 0) note(arrival, visitor);
      return progress_->show({bytes_, buildings_, set_aside_});
    case Arrival::Kind::end:
      if (arrival.is_whole) visitor.end(arrival.input);
      records_.read += arrival.number;
      if (!arrival.sha256.empty()) input_sha256_[arrival.input_name] = arrival.sha256;
      if (resume_) resume_->note_read(arrival.input_name, arrival.sha256);
      return note(arrival, visitor);
    case Arrival::Kind::failure:
      tell({*arrival.issue});
      if (ledger_ && is_last_run()) ledger_->add_unread(arrival.input_name, *arrival.issue);
      raise(ExitCode::input);
      records_.read += arrival.number;
      return note(arrival, visitor);
  }
}

/// A line that cannot be read counts as one building.
void Run::settle_refused(const Arrival& arrival) {
  ++records_.refused;
  raise(arrival.is_one_of_many ? ExitCode::set_aside : ExitCode::input);
  if (!arrival.is_one_of_many) return;
  ++buildings_;
  ++set_aside_;
}

void Run::settle_record(Arrival& arrival, const Visitor& visitor) {
  if (is_passed_over(arrival)) {
    ++records_.not_selected;
    return;
  }
  ++records_.passed_on;
  const Checked<Document>& record = arrival.record;
  // Errors beside a document are buildings that could not be read.
  const auto unread = std::ranges::count(record.issues, Severity::error, &Issue::severity);
  buildings_ += static_cast<int>(unread);
  set_aside_ += static_cast<int>(unread);
  if (unread > 0) raise(ExitCode::set_aside);
  for (const BuildingOutcome& building : arrival.outcome.buildings) {
    if (building.is_passed_over) continue;
    ++buildings_;
    tell(building.issues);
    if (!building.is_done) {
      keep_errors(building.issues);
      ++set_aside_;
      raise(ExitCode::set_aside);
    }
    if (building.is_open) ++open_;
    for (const auto& [label, count] : building.labels) labels_[label] += count;
  }
  if (visitor.make)
    settle_product(arrival, visitor);
  else
    visitor.record(*record.value, arrival.lines);
}

void Run::settle_product(Arrival& arrival, const Visitor& visitor) {
  Product& product = arrival.outcome.product;
  reused_ += arrival.is_reused ? 1 : 0;
  if (notes_ && !arrival.source_sha256.empty() && arrival.lost.empty())
    notes_->add(arrival.source_sha256, visitor.places(), arrival.outcome);
  for (const Issue& issue : product.issues) {
    if (issue.severity == Severity::error)
      set_aside(issue);
    else
      tell({issue});
  }
  if (visitor.counts != nullptr)
    for (const auto& [name, count] : product.counts) (*visitor.counts)[name] += count;
  timings().measure(Stage::write, [&] { visitor.take(*arrival.record.value, std::move(product)); });
}

}  // namespace oriel::cli
