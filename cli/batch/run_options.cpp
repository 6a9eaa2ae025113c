#include "cli/batch/run_options.h"

#include "kernel/base/text/counted.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::cli {

namespace {

/// FNV-1a over the id, begun with the seed, then mixed (splitmix64) so that all bits count.
std::uint64_t draw(std::uint64_t seed, const std::string& id) {
  std::uint64_t hash = 0xcbf29ce484222325U ^ (seed * 0x9e3779b97f4a7c15U);
  for (const char byte : id) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  hash = (hash ^ (hash >> 30U)) * 0xbf58476d1ce4e5b9U;
  hash = (hash ^ (hash >> 27U)) * 0x94d049bb133111ebU;
  return hash ^ (hash >> 31U);
}

bool is_in(const std::vector<double>& bbox, const Building& building) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  Vec3 least{kInfinity, kInfinity, kInfinity}, most{-kInfinity, -kInfinity, -kInfinity};
  for (const Vec3 v : building.vertices) {
    least = {std::min(least.x, v.x), std::min(least.y, v.y), std::min(least.z, v.z)};
    most = {std::max(most.x, v.x), std::max(most.y, v.y), std::max(most.z, v.z)};
  }
  const Vec3 middle = building.frame.origin_m + 0.5 * (least + most);
  return middle.x >= bbox[0] && middle.y >= bbox[1] && middle.x <= bbox[2] && middle.y <= bbox[3];
}

/// "; did you mean 'house'?", or which ids there are.
std::string meant_id(const std::string& id, const std::vector<std::string>& seen) {
  constexpr std::size_t kShown = 3;
  if (seen.empty()) return {};
  if (const std::string near = nearest(id, seen); !near.empty())
    return fmt::format("; did you mean '{}'?", near);
  const std::vector<std::string> first(
      seen.begin(), seen.begin() + static_cast<std::ptrdiff_t>(std::min(kShown, seen.size())));
  return fmt::format("; there {} '{}'{}", agreeing(seen.size(), "is", "are"),
                     fmt::join(first, "', '"), first.size() < seen.size() ? " ..." : "");
}

}  // namespace

bool Selection::is_all() const {
  return ids.empty() && bbox.empty() && cotype.empty() && one_in == 1 && !is_exclusion;
}

bool Selection::fits(const std::string& id, const std::string& type) const {
  return (cotype.empty() || cotype == type) &&
         (ids.empty() || std::ranges::find(ids, id) != ids.end()) && draw(seed, id) % one_in == 0;
}

bool Selection::takes(const Building& building, const std::string& type) const {
  return (fits(building.id, type) && (bbox.empty() || is_in(bbox, building))) != is_exclusion;
}

bool Selection::takes_feature(const std::string& id, const std::string& type) const {
  return !cotype.empty() && takes(id, type);
}

bool Selection::takes(const std::string& id, const std::string& type) const {
  return (fits(id, type) && bbox.empty()) != is_exclusion;
}

std::vector<Issue> Selection::unmet(const std::set<std::string>& found, bool has_any,
                                    const std::vector<std::string>& seen) const {
  std::vector<Issue> issues;
  for (const std::string& id : std::set(ids.begin(), ids.end()))
    if (!found.contains(id) && (cotype.empty() || !has_any))
      issues.push_back(
          building_issue(Severity::warning, Code::E130, id,
                         "is named by --id but is in none of the inputs" + meant_id(id, seen)));
  if (!issues.empty() || has_any || is_all()) return issues;
  Issue issue;
  issue.severity = Severity::warning;
  issue.code = Code::E130;
  issue.sentence =
      "the selection (--id, --bbox, --cotype, --random, --exclude) matches no building";
  return {issue};
}

Issue nothing_to_work_on(const std::vector<std::string>& inputs, const std::string& what) {
  Issue issue;
  issue.severity = Severity::warning;
  issue.code = Code::E134;
  const bool is_one = inputs.size() == 1;
  if (is_one) issue.place.file = inputs[0];
  issue.sentence = fmt::format("{}there is {} to work on", is_one ? "" : "in the inputs ", what);
  return issue;
}

Issue nothing_compared(std::string sentence) {
  Issue issue;
  issue.severity = Severity::warning;
  issue.code = Code::E131;
  issue.sentence = std::move(sentence);
  return issue;
}

Issue no_feature_found(const std::vector<std::string>& inputs, int buildings) {
  Issue issue;
  issue.severity = Severity::warning;
  issue.code = Code::E134;
  if (inputs.size() == 1) issue.place.file = inputs[0];
  issue.sentence = fmt::format(
      "no feature was found in {}: nothing stands out of {} walls and roofs or is cut into them",
      counted(buildings, "building"), agreeing(buildings, "its", "their"));
  return issue;
}

ReadOptions RunOptions::read_options() const {
  ReadOptions options;
  if (!lod.empty()) options.lod = lod;
  if (!from.empty()) options.format = parse_format(from);
  options.joins_installations = joins_installations;
  return options;
}

ReadOptions RunOptions::read_options(const std::string& input) const {
  ReadOptions options = read_options();
  if (!options.format && input == "-") options.format = kFormatOfStdin;
  return options;
}

bool RunOptions::is_piped_stream() const {
  return inputs.size() == 1 && inputs[0] == "-" && read_options("-").format == Format::cityjson_seq;
}

LabelOptions RunOptions::label_options(StageObserver observer) const {
  LabelOptions options;
  options.tolerances = tolerances;
  options.fits_noise = !is_plane_offset_given;
  options.repair = {*parse_closing(close), cap_area_m2,
                    crossings == "cut" ? Crossings::cut : Crossings::leave, ends_at_solid};
  options.order = order == "paper" ? Order::paper : Order::natural;
  options.budget = budget;
  options.ignores_semantics = ignores_semantics;
  options.lod = lod;
  options.observer = std::move(observer);
  options.measures_surfaces = !only_names_surfaces;
  options.measures_features = !only_labels_features;
  options.has_output = false;
  options.corrections = corrections;
  options.neighbours = neighbours;
  return options;
}

std::string RunOptions::configuration() const { return oriel::configuration(label_options()); }

bool RunOptions::allows(int set_aside, int buildings) const {
  const double number = std::stod(allowed_bad);
  if (allowed_bad.ends_with('%')) return set_aside * 100.0 <= number * buildings;
  return set_aside <= number;
}

}  // namespace oriel::cli
