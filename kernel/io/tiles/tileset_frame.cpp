#include "kernel/io/tiles/tileset_frame.h"

#include "kernel/base/text/printable.h"
#include "kernel/io/tiles/tileset_writer.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

/// Farther from each other buildings are not of one data set.
constexpr double kMostApart_m = 1'000'000;

Issue frame_issue(Severity severity, Code code, std::string sentence) {
  Issue issue;
  issue.severity = severity;
  issue.code = code;
  issue.sentence = std::move(sentence);
  return issue;
}

/// E163 for the outermost buildings along an axis that is too long.
std::optional<Issue> too_far_apart(const std::vector<const TileEntry*>& entries) {
  for (double Vec3::*axis : {&Vec3::x, &Vec3::y, &Vec3::z}) {
    const auto [least, most] = std::ranges::minmax_element(
        entries, {}, [axis](const TileEntry* entry) { return entry->origin_m.*axis; });
    const double apart_m = (*most)->origin_m.*axis - (*least)->origin_m.*axis;
    if (apart_m <= kMostApart_m) continue;
    return frame_issue(Severity::error, Code::E163,
                       fmt::format("'{}' and '{}' lie {:.0f} km apart", printable((*least)->id),
                                   printable((*most)->id), apart_m / 1000));
  }
  return std::nullopt;
}

Vec3 middle_of(const std::vector<const TileEntry*>& entries) {
  Box box;
  for (const TileEntry* entry : entries) box.grow(entry->origin_m);
  const Vec3 middle = 0.5 * (box.min + box.max);
  return {std::floor(middle.x), std::floor(middle.y), std::floor(box.min.z)};
}

}  // namespace

Checked<TilesetFrame> TilesetFrame::of(const std::vector<const TileEntry*>& entries,
                                       const std::string& crs) {
  if (auto issue = too_far_apart(entries)) return {std::nullopt, {std::move(*issue)}};
  const Vec3 middle = middle_of(entries);
  TilesetFrame frame;
  frame.placement_.origin = middle;
  std::set<std::string> named;
  for (const TileEntry* entry : entries) named.insert(short_name_of_crs(entry->crs));
  if (crs == kLocalFrame) return {std::move(frame), {}};
  if (crs.empty() && named.size() > 1)
    return {std::nullopt,
            {frame_issue(Severity::error, Code::E160,
                         fmt::format("the inputs name several systems, '{}' and '{}': say which "
                                     "one holds with --crs",
                                     printable(*named.begin()), printable(*named.rbegin())))}};
  const std::string name = crs.empty() ? *named.begin() : crs;
  if (name.empty())
    return {std::move(frame),
            {frame_issue(Severity::warning, Code::E161,
                         "the inputs name no coordinate reference system: the tiles stand in a "
                         "local frame; name one with --crs")}};
  auto earth = Earth::of(name, middle);
  if (!earth.value) return {std::nullopt, std::move(earth.issues)};
  frame.earth_ = std::move(earth.value);
  frame.placement_ = frame.earth_->frame_at(middle).value();
  return {std::move(frame), std::move(earth.issues)};
}

std::optional<Vec3> TilesetFrame::local(Vec3 point) const {
  const auto place = earth_->geocentric(point);
  if (!place) return std::nullopt;
  const Vec3 p = *place - placement_.origin;
  return Vec3{dot(placement_.columns[0], p), dot(placement_.columns[1], p),
              dot(placement_.columns[2], p)};
}

std::optional<Placement> TilesetFrame::placement_of(const TileEntry& entry) const {
  Placement placement;
  if (!earth_) {
    placement.origin = entry.origin_m - placement_.origin;
    return placement;
  }
  constexpr double kStep_m = 100;
  const auto origin = local(entry.origin_m);
  const std::array steps{Vec3{kStep_m, 0, 0}, Vec3{0, kStep_m, 0}, Vec3{0, 0, kStep_m}};
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const auto step = local(entry.origin_m + steps[i]);
    if (!origin || !step) return std::nullopt;
    placement.columns[i] = (1 / kStep_m) * (*step - *origin);
  }
  placement.origin = *origin;
  return placement;
}

}  // namespace oriel::detail
