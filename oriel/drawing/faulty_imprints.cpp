#include "oriel/drawing/faulty_imprints.h"

#include "kernel/base/indexed_vector.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <utility>

namespace oriel {

namespace {

/// So often imprints are looked for in the planes of what is wrong.
constexpr int kLooksForImprints = 2;

}  // namespace

bool FaultyImprints::add(OutputCheck& check, const Segmentation& segmentation, const Solid& solid) {
  const auto key_of = [](const Plane& plane) {
    return std::pair(plane.coefficients, plane.offset);
  };
  std::set<std::pair<std::array<std::int64_t, 3>, std::int64_t>> faulty;
  const auto& findings = check.findings(solid);
  if (findings.empty()) return false;
  for (const Finding& finding : findings)
    if (finding.polygon >= 0)
      faulty.insert(key_of(solid.planes[solid.facets[at(finding.polygon)].plane.index()]));
  const bool are_all = ++times_ > kLooksForImprints;
  std::set<int> polygons;  // of what is left: those of imprints that are gone are in no facet
  for (const Facet& facet : solid.facets)
    polygons.insert(facet.polygons.begin(), facet.polygons.end());
  const std::size_t known = ids_.size();
  for (const FeatureId i : ids_below<FeatureId>(segmentation.features.size())) {
    const Feature& feature = segmentation.features[i.index()];
    if (feature.sense != Sense::imprint) continue;
    const bool is_there = std::ranges::any_of(
        feature.source_polygons, [&](int polygon) { return polygons.contains(polygon); });
    const Plane& plane = segmentation.planes[feature.planes.front().index()];
    if (is_there && (are_all || faulty.contains(key_of(plane)))) ids_.push_back(i);
  }
  std::ranges::sort(ids_);
  ids_.erase(std::unique(ids_.begin(), ids_.end()), ids_.end());
  return ids_.size() > known;
}

std::vector<Issue> FaultyImprints::issues(const FeatureTable& table) const {
  std::vector<Issue> issues;
  for (const FeatureId id : ids_) {
    Issue& issue = issues.emplace_back(
        building_issue(Severity::warning, Code::G410, table.building(),
                       "gets no outline: the wall around it would not be valid as written"));
    issue.place.feature = table.id(id);
  }
  return issues;
}

}  // namespace oriel
