#include "cli/terminal/report.h"

#include "cli/terminal/logging.h"

#include <algorithm>

#include <nlohmann/json.hpp>

namespace oriel::cli {

namespace {

/// With --log-json a finding is an object of its parts.
std::string json_of(const Issue& issue) {
  nlohmann::ordered_json object{{"code", to_string(issue.code)}, {"message", issue.sentence}};
  const auto add = [&](const char* name, const std::string& text) {
    if (!text.empty()) object[name] = text;
  };
  add("file", issue.place.file);
  if (issue.place.line > 0) object["line"] = issue.place.line;
  if (issue.place.column > 0) object["column"] = issue.place.column;
  add("building", issue.place.building);
  add("feature", issue.place.feature);
  return object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

/// Characters, not bytes: continuation bytes of UTF-8 take no column.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::ranges::count_if(
      text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

bool is_number(const std::string& text) {
  return !text.empty() && text.find_first_not_of("0123456789.,-+%e ") == std::string::npos;
}

}  // namespace

void Report::add(const std::vector<Issue>& issues) {
  for (const Issue& issue : issues) add(issue);
}

void Report::add(const Issue& issue) {
  if (issue.severity == Severity::error) ++errors_[to_string(issue.code)];
  LogLevel level = is_verbose_ ? LogLevel::info : LogLevel::debug;
  if (issue.severity == Severity::warning) level = LogLevel::warning;
  if (issue.severity == Severity::error) level = LogLevel::error;
  const Log log = findings_log();
  if (log.is_on(level)) log.write(level, logs_json() ? json_of(issue) : to_string(issue));
}

std::string table(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows)
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (c == widths.size()) widths.push_back(0);
      widths[c] = std::max(widths[c], width_of(row[c]));
    }
  std::string out;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::string line;
    for (std::size_t c = 0; c < rows[r].size(); ++c) {
      const std::string padding(widths[c] - width_of(rows[r][c]), ' ');
      const bool is_right = is_number(r == 0 && rows.size() > 1 ? rows[1][c] : rows[r][c]);
      line += c == 0 ? "" : "  ";
      line += is_right ? padding + rows[r][c] : rows[r][c] + padding;
    }
    out += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return out;
}

}  // namespace oriel::cli
