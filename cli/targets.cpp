#include "cli/targets.h"

#include "cli/series.h"

#include <algorithm>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

/// CityJSON's closed list.
bool is_lod(const std::string& text) {
  const auto is_digit = [](char c) { return c >= '0' && c <= '3'; };
  return (text.size() == 1 && is_digit(text[0])) ||
         (text.size() == 3 && is_digit(text[0]) && text[1] == '.' && is_digit(text[2]));
}

}  // namespace

std::string Targets::recipe() const {
  std::string text = fmt::format("scale={}", scale.value_or(0));
  for (const Profile& profile : profiles) text += ' ' + profile.level + '=' + profile.sha256;
  return text;
}

std::string Targets::text() const {
  if (scale) return fmt::format("1:{}", *scale);
  std::string text;
  for (const Profile& profile : profiles) text += (text.empty() ? "LoD " : ", ") + profile.level;
  return text;
}

std::optional<Targets> targets_of(const std::string& scale, const std::vector<std::string>& lods,
                                  const std::string& profile, const RuleBase& rules,
                                  Report& report) {
  Targets targets;
  std::vector<std::string> names;
  if (lods.empty()) {
    targets.scale = denominator_of(scale, "--scale");
    if (!profile.empty()) names.push_back(profile);
  }
  std::vector<std::string> sorted = lods;
  std::ranges::sort(sorted);
  if (std::ranges::adjacent_find(sorted) != sorted.end())
    throw CLI::ValidationError("--to-lod", "a level of detail stands twice");
  for (const std::string& lod : lods) {
    if (!is_lod(lod))
      throw CLI::ValidationError("--to-lod", fmt::format("'{}' is no level of detail", lod));
    names.push_back((profile.empty() ? "lod" : profile) + ":" + lod);
  }
  for (const std::string& name : names) {
    auto loaded = load_profile_file(name);
    report.tell(loaded.issues);
    if (!loaded.value) return std::nullopt;
    report.tell(check_profile(*loaded.value, rules));
    targets.profiles.push_back(std::move(*loaded.value));
  }
  return targets;
}

}  // namespace oriel::cli
