#include "kernel/base/issue.h"

#include "kernel/base/text/printable.h"

#include <algorithm>

#include <fmt/format.h>

namespace oriel {

std::string to_string(Severity severity) {
  switch (severity) {
    case Severity::note:
      return "note";
    case Severity::warning:
      return "warning";
    case Severity::error:
      return "error";
  }
  return "error";
}

namespace {

std::string place_text(const Place& place) {
  std::string text = printable(place.file);
  if (place.line > 0) text += fmt::format(":{}", place.line);
  if (place.line > 0 && place.column > 0) text += fmt::format(":{}", place.column);
  const auto add = [&](const char* separator, const std::string& word) {
    if (word.empty()) return;
    if (!text.empty()) text += separator;
    text += printable(word);
  };
  add(": ", place.building);
  add(" ", place.feature);
  return text;
}

}  // namespace

std::string to_string(const Issue& issue) {
  std::string text = place_text(issue.place);
  if (!text.empty()) text += ": ";
  if (issue.code != Code::none) text += to_string(issue.code) + " ";
  text += printable(issue.sentence);
  if (!issue.excerpt.empty()) text.append("\n").append(printable_lines(issue.excerpt));
  return text;
}

Issue building_issue(Severity severity, Code code, const std::string& building,
                     std::string sentence) {
  Issue issue;
  issue.severity = severity;
  issue.code = code;
  issue.sentence = std::move(sentence);
  issue.place.building = building;
  return issue;
}

bool has_errors(const std::vector<Issue>& issues) {
  return std::ranges::any_of(issues, [](const Issue& i) { return i.severity == Severity::error; });
}

}  // namespace oriel
