#include "cli/commands/targets.h"

#include "cli/series/series.h"

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

std::string Targets::recipe() const {
  std::string text = fmt::format("scale={}", scale.value_or(0));
  for (const Profile& profile : profiles)
    text += fmt::format(" {}={} edge={}", profile.level, profile.sha256,
                        profile.edge_min_m.value_or(0));
  return text;
}

std::string Targets::text() const {
  if (scale) return fmt::format("1:{}", *scale);
  std::string text;
  for (const Profile& profile : profiles) text += (text.empty() ? "LoD " : ", ") + profile.level;
  return text;
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
    report.tell(loaded.issues);
    if (!loaded.value) return std::nullopt;
    report.tell(check_profile(*loaded.value, rules));
    if (arguments.edge_min_m > 0)
      loaded.value = with_edge_min(std::move(*loaded.value), arguments.edge_min_m);
    if (targets.has_lods()) check_lod("--profile", loaded.value->level);
    targets.profiles.push_back(std::move(*loaded.value));
  }
  return targets;
}

double least_edge_m(const Profile* profile, std::optional<double> scale) {
  if (profile != nullptr && profile->edge_min_m) return *profile->edge_min_m;
  const auto sizes = profile != nullptr ? profile->thresholds(scale) : std::nullopt;
  return sizes ? sizes->c_m : kGapOnMap_m * scale.value_or(0);
}

Invariants invariants_of(const Profile* profile, const RuleBase& rules,
                         std::optional<double> scale) {
  Invariants invariants;
  invariants.limits = rules.limits();
  if (profile != nullptr) invariants.limits = stricter(invariants.limits, profile->limits);
  // Blocks have edges of their own, and what asks for edges everywhere takes their owners off.
  if (profile == nullptr || (profile->form == Profile::Form::as_is && !profile->edge_min_m))
    invariants.least_edge_m = least_edge_m(profile, scale);
  return invariants;
}

Invariants beside_others(Invariants invariants, const Document& document, const Building& building,
                         const Solid& solid) {
  if (invariants.limits.party_walls_pct)
    invariants.party_walls = party_walls(building, solid, document.buildings);
  return invariants;
}

}  // namespace oriel::cli
