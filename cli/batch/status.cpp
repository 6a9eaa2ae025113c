#include "cli/batch/status.h"

#include "cli/batch/resume.h"
#include "io/json/json_check.h"
#include "kernel/base/sha256.h"
#include "model/version.h"

#include <algorithm>
#include <sys/resource.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <utf8.h>

namespace oriel::cli {

namespace {

using nlohmann::ordered_json;

constexpr const char* kQuarantine = ".quarantine.jsonl";

std::string hexadecimal(std::string_view bytes) {
  std::string digits;
  for (const char byte : bytes) digits += fmt::format("{:02x}", static_cast<unsigned char>(byte));
  return digits;
}

std::string dumped(const ordered_json& value, int indent) {
  return value.dump(indent, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

/// Of this process or of its largest worker.
std::int64_t peak_memory_bytes() {
  struct rusage own {
  }, workers{};
  ::getrusage(RUSAGE_SELF, &own);
  ::getrusage(RUSAGE_CHILDREN, &workers);
  return std::max(own.ru_maxrss, workers.ru_maxrss) * std::int64_t{1024};
}

}  // namespace

ordered_json to_json(const RunState& state) {
  const RecordCounts& records = state.records;
  return {{"buildings", state.buildings},
          {"set_aside", state.set_aside},
          {"open", state.open},
          {"featureless", state.featureless},
          {"code", static_cast<int>(state.code)},
          {"labels", state.labels},
          {"found_ids", state.found_ids},
          {"counted", {records.read, records.refused, records.not_selected, records.passed_on}}};
}

RunState run_state_of(const ordered_json& json) {
  const auto number = [](const ordered_json& value) { return static_cast<int>(count_of(value)); };
  const auto record = [counted = json.at("counted")](std::size_t i) {
    return count_of(counted.at(i));
  };
  return {number(json.at("buildings")),
          number(json.at("set_aside")),
          number(json.at("open")),
          number(json.at("featureless")),
          counts_of(json.at("labels")),
          {record(0), record(1), record(2), record(3)},
          static_cast<ExitCode>(number(json.at("code"))),
          json.at("found_ids").get<std::set<std::string>>()};
}

StatusWriter::StatusWriter(const std::string& stem)
    : status_file_(stem + kStatusEnding), quarantine_(stem + kQuarantine) {}

void StatusWriter::add(const Record& record, const std::vector<Issue>& errors) {
  if (errors.empty()) return;
  const std::string_view line = record.document.value ? source_line(*record.document.value)
                                                      : std::string_view(record.refused);
  append(record.input_name, record.line, errors, line);
}

void StatusWriter::add_unread(const std::string& input, const Issue& error) {
  append(input, 0, {error}, {});
}

void StatusWriter::append(const std::string& input, int line, const std::vector<Issue>& errors,
                          std::string_view record) {
  ++records_;
  ++codes_[to_string(errors[0].code)];
  ordered_json entry{{"input", input}};
  if (line > 0) entry["line"] = line;
  entry["id"] = errors[0].place.building;
  entry["code"] = to_string(errors[0].code);
  entry["errors"] = ordered_json::array();
  for (const Issue& error : errors)
    entry["errors"].push_back({{"id", error.place.building},
                               {"code", to_string(error.code)},
                               {"sentence", error.sentence}});
  const std::string text(record);
  if (record.empty())
    entry["record"] = nullptr;
  else if (utf8::is_valid(text))
    entry["record"] = text;
  else
    entry["record_hex"] = hexadecimal(record);
  quarantine_.append(dumped(entry, -1));
}

ordered_json StatusWriter::state() const { return {{"codes", codes_}, {"records", records_}}; }

void StatusWriter::restore(const ordered_json& state) {
  codes_ = counts_of(state.at("codes"));
  records_ = static_cast<int>(count_of(state.at("records")));
}

void StatusWriter::commit(const RunStatus& run) {
  ordered_json status{{"oriel_version", kVersion},
                      {"program_sha256", program_sha256()},
                      {"inputs", run.inputs},
                      {"input_sha256", run.input_sha256},
                      {"rules_sha256", run.rules_sha256},
                      {"config_sha256", run.config_sha256},
                      {"records",
                       {{"read", run.state.records.read},
                        {"passed_on", run.state.records.passed_on},
                        {"refused", run.state.records.refused},
                        {"not_selected", run.state.records.not_selected}}},
                      {"buildings", run.state.buildings},
                      {"done", run.state.buildings - run.state.set_aside},
                      {"set_aside", run.state.set_aside},
                      {"quarantined_records", records_},
                      {"quarantined_by_code", codes_},
                      {"features", ordered_json::object()},
                      {"exit_code", static_cast<int>(run.state.code)},
                      {"peak_memory_bytes", peak_memory_bytes()}};
  if (!run.run_sha256.empty()) status["run_sha256"] = run.run_sha256;
  status["outputs"] = to_json(run.outputs);
  for (const auto& [label, count] : run.state.labels)
    status["features"][label.empty() ? "unknown" : label] = count;
  write_file(status_file_, dumped(status, 2));
}

std::string run_sha256(const RunStatus& run, std::string_view command_sha256) {
  const ordered_json sealed{command_sha256, run.input_sha256, to_json(run.outputs),
                            static_cast<int>(run.state.code)};
  return sha256(dumped(sealed, -1));
}

RunStatus read_status(const std::string& path) {
  const ordered_json json = read_json_file(path);
  RunStatus run;
  try {
    const ordered_json& records = json.at("records");
    run.input_sha256 = json.at("input_sha256").get<std::map<std::string, std::string>>();
    run.outputs = marks_of(json.at("outputs"));
    run.state.records = {count_of(records.at("read")), count_of(records.at("refused")),
                         count_of(records.at("not_selected")), count_of(records.at("passed_on"))};
    run.state.code = static_cast<ExitCode>(count_of(json.at("exit_code")));
    run.run_sha256 = json.value("run_sha256", "");
  } catch (const ordered_json::exception& error) {
    Issue issue;
    issue.code = Code::E202;
    issue.sentence = "is not a status that oriel wrote: " + reason_of(error);
    issue.place.file = path;
    throw InputError(std::move(issue));
  }
  return run;
}

}  // namespace oriel::cli
