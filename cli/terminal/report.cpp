#include "cli/terminal/report.h"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <unistd.h>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

bool has_colours() {
  const char* no_colour = std::getenv("NO_COLOR");
  return isatty(STDERR_FILENO) != 0 && (no_colour == nullptr || *no_colour == '\0');
}

const char* colour_of(Severity severity) {
  switch (severity) {
    case Severity::error:
      return "\033[31m";
    case Severity::warning:
      return "\033[33m";
    case Severity::note:
      return "\033[36m";
  }
  return "";
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

void Report::tell(const std::vector<Issue>& issues) {
  for (const Issue& issue : issues) tell(issue);
}

void Report::tell(const Issue& issue) {
  if (issue.severity == Severity::error) ++errors_[to_string(issue.code)];
  if (issue.severity == Severity::note && !is_verbose_) return;
  const std::string head = to_string(issue.severity);
  const std::string text =
      has_colours()
          ? fmt::format("{}{}\033[0m: {}\n", colour_of(issue.severity), head, to_string(issue))
          : fmt::format("{}: {}\n", head, to_string(issue));
  std::fputs(text.c_str(), stderr);
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
