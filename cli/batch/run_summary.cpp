#include "cli/batch/run.h"
#include "cli/terminal/logging.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::cli {

std::string Run::codes_text() const {
  std::string codes;
  for (const auto& [code, count] : report_.errors())
    codes += fmt::format("{}{} {}", codes.empty() ? "" : ", ", code, count);
  return codes;
}

void Run::tell_summary(const std::string& verb, const std::map<std::string, int>& counts,
                       const std::string& what_of_them) const {
  if (progress_ && progress_->style() == ProgressStyle::bar)
    return tell_table(verb, counts, what_of_them);
  std::vector<std::string> parts;
  for (const auto& [label, count] : counts)
    if (!label.empty()) parts.push_back(fmt::format("{} {}", count, label));
  if (const auto unknown = counts.find(""); unknown != counts.end())
    parts.push_back(fmt::format("{} unknown", unknown->second));
  std::string text = fmt::format("{} of {} building{} {}", buildings_ - set_aside_, buildings_,
                                 buildings_ == 1 ? "" : "s", verb);
  if (!parts.empty()) text += fmt::format(": {}{}", fmt::join(parts, ", "), what_of_them);
  if (open_ > 0) text += fmt::format("; {} open", open_);
  if (set_aside_ > 0) {
    text += fmt::format("; {} rejected", set_aside_);
    if (const std::string codes = codes_text(); !codes.empty()) text += " (" + codes + ")";
  }
  run_log().write(LogLevel::info, text);
}

void Run::tell_table(const std::string& verb, const std::map<std::string, int>& counts,
                     const std::string& what_of_them) const {
  std::vector<std::vector<std::string>> rows{{verb, "count"}};
  const auto add = [&](const std::string& what, int count) {
    rows.push_back({what, std::to_string(count)});
  };
  add("buildings", buildings_);
  add("done", buildings_ - set_aside_);
  if (open_ > 0) add("open", open_);
  add("rejected", set_aside_);
  for (const auto& [code, count] : report_.errors()) add("  " + code, count);
  for (const auto& [label, count] : counts)
    add("feature " + (label.empty() ? "unknown" : label) + what_of_them, count);
  run_log().info("{}{:.1f} s, {:.1f} buildings/s, {:.2f} MB/s", table(rows), progress_->seconds(),
                 progress_->buildings_per_s(), progress_->mb_per_s());
}

}  // namespace oriel::cli
