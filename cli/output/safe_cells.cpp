#include "cli/output/safe_cells.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>

namespace oriel::cli {

namespace {

/// The end of the cell that begins at `begin`: at a comma, at the end of a line, or of the text.
std::size_t end_of_cell(std::string_view csv, std::size_t begin) {
  bool is_in_quotes = false;
  for (std::size_t at = begin; at < csv.size(); ++at) {
    if (csv[at] == '"') is_in_quotes = !is_in_quotes;
    if (!is_in_quotes && (csv[at] == ',' || csv[at] == '\n')) return at;
  }
  return csv.size();
}

/// A number, or a list of them joined by ';' such as a box.
bool is_of_numbers(std::string_view text) {
  while (true) {
    double number = 0;
    const char* all = text.data() + text.size();
    const auto [end, fault] = std::from_chars(text.data(), all, number);
    if (fault != std::errc() || (end != all && *end != ';')) return false;
    if (end == all) return true;
    text.remove_prefix(static_cast<std::size_t>(end - text.data()) + 1);
  }
}

bool may_be_run(std::string_view text) {
  constexpr std::array<std::string_view, 11> kStarts{"=",  "+",  "-",  "@",  "\t", "\r",
                                                     "\n", "＝", "＋", "－", "＠"};
  return std::ranges::any_of(kStarts,
                             [&](std::string_view start) { return text.starts_with(start); }) &&
         !is_of_numbers(text);
}

void append_safe(std::string& out, std::string_view cell) {
  const bool is_quoted = cell.size() > 1 && cell.front() == '"';
  const std::string_view inside = is_quoted ? cell.substr(1, cell.size() - 2) : cell;
  const bool is_run = may_be_run(inside);
  if (!is_quoted && !is_run && cell.find_first_of(";\t") == std::string_view::npos) {
    out += cell;
    return;
  }
  out.append(is_run ? "\"'" : "\"").append(inside).append("\"");
}

}  // namespace

std::string with_safe_cells(std::string_view csv) {
  std::string out;
  out.reserve(csv.size() + csv.size() / 16);
  for (std::size_t begin = 0; begin < csv.size();) {
    const std::size_t end = end_of_cell(csv, begin);
    append_safe(out, csv.substr(begin, end - begin));
    if (end < csv.size()) out += csv[end];
    begin = end + 1;
  }
  return out;
}

}  // namespace oriel::cli
