#include "io/json/text.h"

#include "kernel/base/text/printable.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <utf8.h>

namespace oriel {

namespace {

/// Bytes of a line shown on each side of a finding.
constexpr std::size_t kShown = 40;
/// Bytes of a text shown in a message.
constexpr std::size_t kQuoted = 40;

constexpr bool is_continuation(unsigned char byte) { return (byte & 0xC0U) == 0x80U; }

/// `text` with a '?' for each character that is not printable, so that the caret stays under its
/// place.
std::string with_question_marks(std::string_view text) {
  std::string result;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = std::max<std::size_t>(utf8_length(text, at), 1);
    result += is_printable(text, at) ? text.substr(at, length) : "?";
    at += length;
  }
  return result;
}

/// The line around `offset`, cut to what fits a terminal, and a caret under the place.
std::string excerpt(std::string_view line, std::size_t offset) {
  std::size_t from = offset > kShown ? offset - kShown : 0;
  while (from > 0 && is_continuation(static_cast<unsigned char>(line[from]))) --from;
  std::size_t to = std::min(line.size(), offset + kShown);
  while (to < line.size() && is_continuation(static_cast<unsigned char>(line[to]))) ++to;
  const std::string before = with_question_marks(line.substr(from, offset - from));
  const auto columns = std::ranges::count_if(
      before, [](char c) { return !is_continuation(static_cast<unsigned char>(c)); });
  return "  " + with_question_marks(line.substr(from, to - from)) + "\n  " +
         std::string(static_cast<std::size_t>(columns), ' ') + "^";
}

}  // namespace

Issue error_at(const TextName& name, std::string_view text, std::size_t offset, Fault fault) {
  offset = std::min(offset, text.size());
  const std::string_view before = text.substr(0, offset);
  const std::size_t newline = before.rfind('\n');
  const std::size_t start = newline == std::string_view::npos ? 0 : newline + 1;
  const std::size_t end = std::min(text.find('\n', start), text.size());
  Issue issue = error_in(name, std::move(fault));
  issue.place.line = std::max(name.line, 1) + static_cast<int>(std::ranges::count(before, '\n'));
  issue.place.column = static_cast<int>(offset - start) + 1;
  issue.excerpt = excerpt(text.substr(start, end - start), offset - start);
  return issue;
}

Issue error_in(const TextName& name, Fault fault) {
  return {Severity::error,
          fault.code,
          std::move(fault.sentence),
          {name.file, name.line, 0, "", ""},
          ""};
}

Issue finding_of(const TextName& name, Severity severity, std::string_view building, Fault fault) {
  Issue issue = error_in(name, std::move(fault));
  issue.severity = severity;
  issue.place.building = building;
  return issue;
}

std::optional<std::size_t> find_non_utf8(std::string_view text) {
  const std::size_t at = utf8::find_invalid(text);
  return at == std::string_view::npos ? std::nullopt : std::optional(at);
}

std::string_view without_bom(std::string_view text) {
  constexpr std::string_view kBom = "\xEF\xBB\xBF";
  if (text.starts_with(kBom)) text.remove_prefix(kBom.size());
  return text;
}

std::string in_quotes(std::string_view text) {
  const bool is_cut = text.size() > kQuoted;
  std::size_t end = std::min(text.size(), kQuoted);
  while (end < text.size() && is_continuation(static_cast<unsigned char>(text[end]))) ++end;
  return fmt::format("'{}{}'", printable(text.substr(0, end)), is_cut ? "…" : "");
}

}  // namespace oriel
