#include "cli/commands/targets.h"

#include "cli/commands/options.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>

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

void check_lod(const std::string& option, const std::string& lod) {
  if (!is_lod(lod))
    throw CLI::ValidationError(option, fmt::format("'{}' is no level of detail", lod));
}

/// The names of the profiles, as load_profile_file takes them.
std::vector<std::string> profile_names(const TargetArguments& arguments) {
  const auto& [has_scale, scale, lods, profile, edge_min_m] = arguments;
  if (lods.empty()) return profile.empty() ? std::vector<std::string>{} : std::vector{profile};
  std::vector<std::string> sorted = lods;
  std::ranges::sort(sorted);
  if (std::ranges::adjacent_find(sorted) != sorted.end())
    throw CLI::ValidationError("--to-lod", "a level of detail stands twice");
  std::vector<std::string> names;
  for (const std::string& lod : lods) {
    check_lod("--to-lod", lod);
    names.push_back((profile.empty() ? "lod" : profile) + ":" + lod);
  }
  return names;
}

}  // namespace

double denominator_of(const std::string& text, const std::string& option) {
  std::string number;
  std::ranges::remove_copy(text, std::back_inserter(number), ' ');
  if (number.starts_with("1:")) number.erase(0, 2);
  double value = 0;
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), value);
  if (error != std::errc() || end != number.data() + number.size() || !(value >= 1) ||
      !std::isfinite(value))
    refuse_usage(option, Code::E125,
                 fmt::format("'{}' is no scale: write 1:N with N >= 1, such as 1:2000", text));
  return value;
}

std::optional<Targets> targets_of(const TargetArguments& arguments, const RuleBase& rules,
                                  Report& report) {
  Targets targets;
  if (arguments.has_scale) targets.scale = denominator_of(arguments.scale, "--scale");
  const std::vector<std::string> names = profile_names(arguments);
  if (names.empty() && arguments.edge_min_m > 0)
    throw CLI::ValidationError("--edge-min", "works only with --profile or --to-lod");
  for (const std::string& name : names) {
    auto loaded = load_profile_file(name);
    report.add(loaded.issues);
    if (!loaded.value) return std::nullopt;
    report.add(check_profile(*loaded.value, rules));
    if (arguments.edge_min_m > 0)
      loaded.value = with_edge_min(std::move(*loaded.value), arguments.edge_min_m);
    if (targets.has_lods()) check_lod("--profile", loaded.value->level);
    targets.profiles.push_back(std::move(*loaded.value));
  }
  return targets;
}

}  // namespace oriel::cli
