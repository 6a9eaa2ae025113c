#include "cli/options/feature_choice.h"

#include "kernel/base/text/counted.h"
#include "kernel/base/text/printable.h"
#include "kernel/base/text/suggest.h"
#include "oriel/explain.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::cli {

namespace {

/// An id or its beginning: f with digits of base 32, where other texts are names.
bool may_be_id(std::string_view text) {
  return text.starts_with('f') &&
         text.find_first_not_of("0123456789abcdefghjkmnpqrstvwxyz") == std::string_view::npos;
}

}  // namespace

std::string names_a_feature(const std::string& text) {
  return text.empty() ? "an empty text names no feature" : "";
}

std::optional<FeatureId> FeatureChoice::look(const PipelineResult& line) {
  const FeatureTable& table = line.description.table;
  const std::vector<std::string> names = names_of_features(line);
  const auto entry = [&](FeatureId id) {
    return Entry{table.building(), table.id(id), names[id.index()]};
  };
  for (std::size_t i = 0; i < table.rows(); ++i)
    all_.push_back(entry(FeatureId{static_cast<int>(i)}));
  const std::vector<FeatureId> found = find_features(line, text_);
  for (const FeatureId id : found) found_.push_back(entry(id));
  return found.empty() ? std::nullopt : std::optional(found.front());
}

void FeatureChoice::clear() {
  all_.clear();
  found_.clear();
}

void FeatureChoice::check(ExitCode code) const {
  const bool has_said_why =
      code == ExitCode::input || (code == ExitCode::set_aside && all_.empty());
  if (found_.empty() && !has_said_why) refuse_unknown();
  if (found_.size() < 2) return;
  const bool is_one = std::ranges::all_of(
      found_, [&](const Entry& entry) { return entry.building == found_.front().building; });
  throw CLI::ValidationError(
      option_, fmt::format("{} start with '{}'; it may be {}{}", counted(found_.size(), "feature"),
                           text_, some_of(found_), is_one ? "" : "; --id names one building"));
}

/// "f11yv1hbtweapa (chimney 1 of roof slope north)", a few of them; of several buildings with the
/// building.
std::string FeatureChoice::some_of(const std::vector<Entry>& features) const {
  constexpr std::size_t kMostShown = 5;
  const bool is_one = std::ranges::all_of(
      features, [&](const Entry& entry) { return entry.building == features.front().building; });
  std::string text;
  for (std::size_t i = 0; i < std::min(kMostShown, features.size()); ++i) {
    const Entry& entry = features[i];
    text += fmt::format("{}{} ({}{})", i == 0 ? "" : ", ", entry.id, entry.name,
                        is_one ? "" : " in building " + printable(entry.building));
  }
  return features.size() > kMostShown ? text + " ..." : text;
}

/// No feature is meant: those with the nearest names, or if an id seems to be meant the first ones.
void FeatureChoice::refuse_unknown() const {
  constexpr std::size_t kMostNear = 3;
  std::string which = "there are none";
  if (!all_.empty() && may_be_id(text_)) which = "there are " + some_of(all_);
  if (!all_.empty() && !may_be_id(text_)) {
    std::vector<std::string> names;
    for (const Entry& entry : all_) names.push_back(entry.name);
    which =
        fmt::format("there are '{}'", fmt::join(nearest_names(names, text_, kMostNear), "', '"));
  }
  throw CLI::ValidationError(option_, fmt::format("no feature starts with '{}'; {}", text_, which));
}

}  // namespace oriel::cli
