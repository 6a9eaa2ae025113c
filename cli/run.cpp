#include "cli/run.h"

#include "cli/progress.h"
#include "kernel/io/output_file.h"
#include "kernel/io/reader.h"

#include <algorithm>
#include <cstdio>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::cli {

Run::Run(const LineArguments& arguments, const RuleBase* rules, Report& report)
    : arguments_(arguments), rules_(rules), report_(report) {}

ExitCode Run::go(const Visitor& visitor) {
  const auto stdins = std::ranges::count(arguments_.inputs, "-");
  if (stdins > 1 || (stdins > 0 && arguments_.repeat > 1))
    throw CLI::ValidationError("input", "stdin can be read only once");
  for (run_ = 1; run_ <= arguments_.repeat; ++run_) {
    timings_.begin_run();
    buildings_ = set_aside_ = 0;
    labels_.clear();
    for (std::size_t input = 0; input < arguments_.inputs.size(); ++input)
      read_input(input, visitor);
  }
  if (!arguments_.timings_file.empty()) write_file(arguments_.timings_file, timings_.to_json());
  return code_;
}

void Run::tell(const std::vector<Issue>& issues) {
  if (run_ == 1) report_.tell(issues);
}

void Run::set_aside(const Issue& why) {
  ++set_aside_;
  raise(ExitCode::set_aside);
  tell({why});
}

void Run::read_input(std::size_t input, const Visitor& visitor) {
  Progress progress(arguments_.inputs.size());
  try {
    Reader reader(arguments_.inputs[input], arguments_.read_options());
    visitor.begin(input);
    bool is_readable = true;
    for (bool is_first = true;; is_first = false) {
      auto record = timings_.measure(Stage::read, [&] { return reader.next(); });
      if (!record) break;
      tell(record->issues);
      if (record->value) {
        run_record(*record, visitor);
        progress.show(input, buildings_);
        continue;
      }
      // A line of a stream costs that line; a file as a whole, or a stream's header, costs the
      // input.
      if (reader.format() == Format::cityjson_seq && !is_first) {
        ++set_aside_;
        raise(ExitCode::set_aside);
        continue;
      }
      raise(ExitCode::input);
      is_readable = false;
    }
    if (is_readable) visitor.end(input);
  } catch (const InputError& error) {
    tell({error.issue()});
    raise(ExitCode::input);
  }
}

void Run::run_record(const Checked<Document>& record, const Visitor& visitor) {
  // Errors beside a document are buildings that could not be read.
  const auto unread = std::ranges::count(record.issues, Severity::error, &Issue::severity);
  buildings_ += static_cast<int>(unread);
  set_aside_ += static_cast<int>(unread);
  if (unread > 0) raise(ExitCode::set_aside);
  std::vector<OnLine> lines;
  for (const Building& building : record.value->buildings) {
    ++buildings_;
    lines.push_back(run_line(building, arguments_.segment_options(), rules_, timings_));
    tell(lines.back().issues);
    if (!lines.back().is_done()) {
      ++set_aside_;
      raise(ExitCode::set_aside);
    }
    for (const Verdict& verdict : lines.back().interpretation.verdicts) ++labels_[verdict.label];
  }
  visitor.record(*record.value, lines);
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
