#include "cli/run.h"

#include "cli/line_surfaces.h"
#include "kernel/io/output_file.h"
#include "kernel/model/sha256.h"

#include <algorithm>
#include <cstdio>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_pipeline.h>
#include <oneapi/tbb/task_arena.h>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::cli {

namespace {

Building without_hints(Building building) {
  for (Polygon& polygon : building.polygons) polygon.hint.clear();
  return building;
}

}  // namespace

Run::Run(const LineArguments& arguments, const RuleBase* rules, Report& report)
    : arguments_(arguments), rules_(rules), report_(report) {}

ExitCode Run::go(const Visitor& visitor) {
  const auto stdins = std::ranges::count(arguments_.inputs, "-");
  if (stdins > 1 || (stdins > 0 && arguments_.repeat > 1))
    throw CLI::ValidationError("input", "stdin can be read only once");
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
  }
  visitor.commit();
  if (!arguments_.timings_file.empty()) write_file(arguments_.timings_file, to_json(timings_));
  if (code_ == ExitCode::set_aside && arguments_.allows(set_aside_, buildings_))
    code_ = ExitCode::clean;
  if (ledger_) close_books();
  if (resume_) resume_->remove();
  return code_;
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
  Progress progress(arguments_.inputs.size());
  Intake intake(arguments_, resume_ ? resume_->position() : Resume::Position{});
  if (arguments_.jobs == 1) {
    while (const auto arrival = intake.next()) {
      work_on(*arrival);
      settle(*arrival, visitor, progress);
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
    work_on(*arrival);
    return arrival;
  };
  const auto end = [&](const Item& arrival) { settle(*arrival, visitor, progress); };
  arena.execute([&] {
    tbb::parallel_pipeline(
        records, tbb::make_filter<void, Item>(tbb::filter_mode::serial_in_order, read) &
                     tbb::make_filter<Item, Item>(tbb::filter_mode::parallel, work) &
                     tbb::make_filter<Item, void>(tbb::filter_mode::serial_in_order, end));
  });
}

OnLine Run::on_line(const Building& building, Timings& timings) const {
  const RepairOptions repair = arguments_.repair_options();
  if (arguments_.ends_at_reading) return {};
  if (arguments_.ends_at_solid)
    return run_to_solid(building, arguments_.tolerances, repair, timings);
  const SegmentOptions options = arguments_.segment_options();
  OnLine line = arguments_.ignores_semantics
                    ? run_line(without_hints(building), options, repair, rules_, timings)
                    : run_line(building, options, repair, rules_, timings);
  if (rules_ != nullptr) describe_line_surfaces(building, options.tolerances, timings, line);
  return line;
}

/// As far as the command asks for.
bool Run::came_to_end(const OnLine& line) const {
  if (arguments_.ends_at_reading) return true;
  return arguments_.ends_at_solid ? line.solid.has_value() : line.is_done();
}

/// Touches nothing but the arrival.
void Run::work_on(Arrival& arrival) const {
  if (!arrival.record.value || arrival.was_done) return;
  for (const Building& building : arrival.record.value->buildings) {
    if (arguments_.selection.takes(building))
      arrival.lines.push_back(on_line(building, arrival.timings));
    else
      arrival.lines.emplace_back().is_passed_over = true;
  }
  drop_unselected(arrival);
}

void Run::settle(Arrival& arrival, const Visitor& visitor, Progress& progress) {
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
      return progress.show(arrival.input, buildings_);
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

/// Of a file with many records those go on that have something selected; other files stay as they
/// are.
bool Run::is_passed_over(const Arrival& arrival) const {
  return !arguments_.selection.is_all() && !arrival.is_header &&
         arrival.record.value->format != Format::cityjson && arrival.record.issues.empty() &&
         std::ranges::all_of(arrival.lines, &OnLine::is_passed_over);
}

/// What was found in buildings that are not asked for is not told.
void Run::drop_unselected(Arrival& arrival) const {
  const auto& lines = arrival.lines;
  if (arguments_.selection.is_all() || !arrival.record.value) return;
  const std::vector<Building>& buildings = arrival.record.value->buildings;
  std::erase_if(arrival.record.issues, [&](const Issue& issue) {
    if (issue.place.building.empty()) return false;
    const auto read = std::ranges::find(buildings, issue.place.building, &Building::id);
    if (read != buildings.end())
      return lines[static_cast<std::size_t>(read - buildings.begin())].is_passed_over;
    return !arguments_.selection.takes(issue.place.building);
  });
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
  for (const OnLine& line : arrival.lines) {
    if (line.is_passed_over) continue;
    ++buildings_;
    tell(line.issues);
    if (!came_to_end(line)) {
      keep_errors(line.issues);
      ++set_aside_;
      raise(ExitCode::set_aside);
    }
    if (line.is_open) ++open_;
    for (const Verdict& verdict : line.interpretation.verdicts) ++labels_[verdict.label];
  }
  visitor.record(*record.value, arrival.lines);
}

void Run::tell_summary(const std::string& verb, const std::map<std::string, int>& counts,
                       const std::string& what_of_them) const {
  std::vector<std::string> parts;
  for (const auto& [label, count] : counts)
    if (!label.empty()) parts.push_back(fmt::format("{} {}", count, label));
  if (const auto unknown = counts.find(""); unknown != counts.end())
    parts.push_back(fmt::format("{} unknown", unknown->second));
  std::string text =
      fmt::format("{} {} of {} buildings", verb, buildings_ - set_aside_, buildings_);
  if (!parts.empty()) text += fmt::format(": {}{}", fmt::join(parts, ", "), what_of_them);
  if (open_ > 0) text += fmt::format("; {} open", open_);
  if (set_aside_ > 0) {
    text += fmt::format("; {} set aside", set_aside_);
    std::string codes;
    for (const auto& [code, count] : report_.errors())
      codes += fmt::format("{}{} {}", codes.empty() ? "" : ", ", code, count);
    if (!codes.empty()) text += " (" + codes + ")";
  }
  std::fputs((text + "\n").c_str(), stderr);
}

}  // namespace oriel::cli
