#include "cli/batch/ledger.h"

#include "cli/batch/resume.h"
#include "kernel/model/version.h"

#include <algorithm>
#include <sys/resource.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::cli {

namespace {

using nlohmann::ordered_json;

constexpr const char* kQuarantine = ".quarantine.jsonl";
constexpr const char* kStatus = ".status.json";

bool is_utf8(const std::string& text) {
  try {
    (void)ordered_json(text).dump();
    return true;
  } catch (const ordered_json::type_error&) {
    return false;
  }
}

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

Ledger::Ledger(const std::string& stem)
    : status_file_(stem + kStatus), quarantine_(stem + kQuarantine) {}

void Ledger::add(const Arrival& arrival, const std::vector<Issue>& errors) {
  if (errors.empty()) return;
  const std::string_view line =
      arrival.record.value ? source_line(*arrival.record.value) : std::string_view(arrival.refused);
  append(arrival.input_name, arrival.line, errors, line);
}

void Ledger::add_unread(const std::string& input, const Issue& error) {
  append(input, 0, {error}, {});
}

void Ledger::append(const std::string& input, int line, const std::vector<Issue>& errors,
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
  else if (is_utf8(text))
    entry["record"] = text;
  else
    entry["record_hex"] = hexadecimal(record);
  quarantine_.append(dumped(entry, -1));
}

ordered_json Ledger::state() const { return {{"codes", codes_}, {"records", records_}}; }

void Ledger::restore(const ordered_json& state) {
  codes_ = state.at("codes").get<std::map<std::string, int>>();
  records_ = state.at("records");
}

void Ledger::commit(const Account& account) {
  ordered_json status{{"oriel_version", kVersion},
                      {"program_sha256", program_sha256()},
                      {"inputs", account.inputs},
                      {"input_sha256", account.input_sha256},
                      {"rules_sha256", account.rules_sha256},
                      {"config_sha256", account.config_sha256},
                      {"records",
                       {{"read", account.records.read},
                        {"passed_on", account.records.passed_on},
                        {"refused", account.records.refused},
                        {"not_selected", account.records.not_selected}}},
                      {"buildings", account.buildings},
                      {"done", account.buildings - account.set_aside},
                      {"set_aside", account.set_aside},
                      {"quarantined_records", records_},
                      {"quarantined_by_code", codes_},
                      {"features", ordered_json::object()},
                      {"exit_code", account.exit_code},
                      {"peak_memory_bytes", peak_memory_bytes()}};
  if (!account.command_sha256.empty()) status["command_sha256"] = account.command_sha256;
  status["outputs"] = to_json(account.outputs);
  for (const auto& [label, count] : account.labels)
    status["features"][label.empty() ? "unknown" : label] = count;
  write_file(status_file_, dumped(status, 2));
}

}  // namespace oriel::cli
