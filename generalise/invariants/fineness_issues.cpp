#include "generalise/invariants/fineness_issues.h"

#include <algorithm>
#include <limits>
#include <map>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

std::string place_text(Vec3 local_m, const Frame& frame) {
  const Vec3 p = local_m + frame.origin_m;
  return fmt::format("({:.3f}, {:.3f}, {:.3f})", p.x, p.y, p.z);
}

/// What of one feature, or of the body, is too fine for one reason.
struct Finding {
  std::size_t count = 0;
  double least_m = std::numeric_limits<double>::infinity();
  Vec3 at;

  void add(double length_m, Vec3 where) {
    ++count;
    if (length_m >= least_m) return;
    least_m = length_m;
    at = where;
  }
};
using Findings = std::map<std::pair<FeatureId, std::string>, Finding>;

/// That the feature was to change and was refused, or nothing.
std::string refusal_of(FeatureId feature, const Generalised& generalised) {
  const auto found = std::ranges::find(generalised.refused, feature, &CarriedOut::Refused::feature);
  return found == generalised.refused.end() ? "" : "it was refused, " + to_string(found->code);
}

/// Why a new edge is there: its feature was refused, or it could not be cleared.
std::string reason_of(const ShortEdge& edge, const Generalised& generalised,
                      const std::string& otherwise) {
  std::string refusal = refusal_of(edge.feature, generalised);
  if (!refusal.empty()) return refusal;
  const auto is_near = [](Vec3 p, Vec3 q) { return length(q - p) <= kOnBox_m; };
  for (const UnclearedEdge& left : generalised.uncleared)
    if ((is_near(left.from, edge.from) && is_near(left.to, edge.to)) ||
        (is_near(left.from, edge.to) && is_near(left.to, edge.from)))
      return left.reason;
  return otherwise;
}

}  // namespace

std::vector<Issue> fineness_issues(const Building& building, const Solid& before,
                                   const Solid& after, const Segmentation& segmentation,
                                   const FeatureTable& table, const Generalised& generalised,
                                   const Fineness& asked) {
  const double least_m = asked.least_m;
  const std::vector<FeatureId>& removed = generalised.removed;
  const auto found = asked.is_everywhere
                         ? short_edges(after, segmentation, removed, least_m)
                         : new_short_edges(before, after, segmentation, removed, least_m);
  Findings edges, whole, gaps;
  const auto add = [&](Findings& findings, FeatureId feature, double size_m, Vec3 at) {
    findings[{feature, refusal_of(feature, generalised)}].add(size_m, at);
  };
  if (asked.is_everywhere) {
    for (const ShortEdge& edge : found) add(edges, edge.feature, edge.length_m, edge.from);
    for (const NarrowGap& gap : narrow_gaps(after, segmentation, removed, least_m))
      add(gaps, gap.feature, gap.width_m, gap.at);
  } else {
    const auto torn =
        without_whole_edges(found, segmentation, generalised.changed, removed, least_m);
    for (const ShortEdge& edge : torn)
      edges[{edge.feature, reason_of(edge, generalised, asked.why_not_tried)}].add(edge.length_m,
                                                                                   edge.from);
    for (const ShortEdge& edge : found)
      if (std::ranges::find(torn, edge) == torn.end())
        add(whole, edge.feature, edge.length_m, edge.from);
  }

  std::vector<Issue> issues;
  const auto tell = [&](const Findings& findings, Code code, const char* what,
                        bool is_left = true) {
    for (const auto& [whose, finding] : findings) {
      const auto& [feature, reason] = whose;
      const bool is_news =
          is_left && reason != asked.why_not_tried && refusal_of(feature, generalised).empty();
      Issue issue = building_issue(
          asked.is_everywhere || is_news ? Severity::warning : Severity::note, code, building.id,
          fmt::format("has {} {}, the least of {:.3f} m at {}{}{}", finding.count,
                      fmt::format(fmt::runtime(what), least_m), finding.least_m,
                      place_text(finding.at, building.frame), reason.empty() ? "" : ": ", reason));
      if (feature.is_valid()) issue.place.feature = table.id(feature);
      issues.push_back(std::move(issue));
    }
  };
  tell(edges, Code::G415, "edges below {} m left");
  tell(whole, Code::G415, "edges below {} m of parts that stay as they were", false);
  tell(gaps, Code::G416, "gaps below {} m left");
  return issues;
}

}  // namespace oriel
