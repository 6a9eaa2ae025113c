#include "cli/options/target_options.h"

#include "cli/options/options.h"
#include "oriel/rules.h"

#include <algorithm>
#include <utility>

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
    throw CLI::ValidationError(option, fmt::format("'{}' is not a level of detail", lod));
}

/// The names of the profiles, as load_profile_file takes them.
std::vector<std::string> profile_names(const TargetArguments& arguments) {
  const auto& [has_scale, scale, lods, profile, edge_min_m] = arguments;
  if (lods.empty()) return profile.empty() ? std::vector<std::string>{} : std::vector{profile};
  std::vector<std::string> sorted = lods;
  std::ranges::sort(sorted);
  if (std::ranges::adjacent_find(sorted) != sorted.end())
    throw CLI::ValidationError("--to-lod",
                               "a level of detail is given twice; name each of them once");
  std::vector<std::string> names;
  for (const std::string& lod : lods)
    names.push_back((profile.empty() ? "lod" : profile) + ":" + lod);
  return names;
}

}  // namespace

void check_level(const std::string& option, const std::vector<Issue>& issues) {
  for (const Issue& issue : issues)
    if (issue.code == Code::R275) refuse_usage(option, issue.code, issue.sentence);
}

std::optional<Targets> targets_of(const TargetArguments& arguments, const RuleBase& rules,
                                  bool has_neighbours, Report& report) {
  Targets targets;
  if (arguments.has_scale) targets.scale = denominator_of(arguments.scale, "--scale");
  const std::vector<std::string> names = profile_names(arguments);
  if (names.empty() && arguments.edge_min_m > 0)
    throw CLI::ValidationError("--edge-min", "works only with --profile or --to-lod");
  const std::string option = arguments.lods.empty() ? "--profile" : "--to-lod";
  for (const std::string& name : names) {
    auto loaded = load_profile_file(name);
    check_level(option, loaded.issues);
    report.add(loaded.issues);
    if (!loaded.value) return std::nullopt;
    report.add(check_profile(*loaded.value, rules,
                             targets.scale ? ProfileUse::scale : ProfileUse::level,
                             has_neighbours));
    if (arguments.edge_min_m > 0)
      loaded.value = with_edge_min(std::move(*loaded.value), arguments.edge_min_m);
    if (targets.has_lods()) check_lod(option, loaded.value->level);
    targets.profiles.push_back(std::move(*loaded.value));
  }
  return targets;
}

}  // namespace oriel::cli
