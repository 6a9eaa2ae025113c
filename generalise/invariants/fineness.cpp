#include "generalise/invariants/fineness.h"

#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/box_tree.h"
#include "kernel/geometry/boxes.h"
#include "kernel/geometry/outlines.h"
#include "kernel/geometry/planar.h"
#include "model/tolerances.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// An edge lies on another one, a facet in front of another one, within the rounding of doubles.
constexpr double kRounding_m = 1e-6;  // tolerance of doubles

/// The boxes of the features that are not removed.
class OwnerBoxes {
 public:
  OwnerBoxes(const Segmentation& segmentation, const std::vector<FeatureId>& removed)
      : segmentation_(segmentation), owners_(left_of(segmentation, removed)), tree_(boxes()) {}

  /// The feature with the smallest box around both points, of equal ones the first; or none.
  [[nodiscard]] FeatureId smallest_around(Vec3 p, Vec3 q) const {
    std::pair best{std::numeric_limits<double>::infinity(), FeatureId{}};
    tree_.search(
        [&](const Box& box) { return contains(box, p, kOnBox_m) && contains(box, q, kOnBox_m); },
        [&](int i) {
          const Box& box = segmentation_.features[owners_[at(i)].index()].box;
          best = std::min(best, {length(box.max - box.min), owners_[at(i)]});
        });
    return best.second;
  }

 private:
  static std::vector<FeatureId> left_of(const Segmentation& segmentation,
                                        const std::vector<FeatureId>& removed) {
    std::vector<FeatureId> left;
    for (const FeatureId i : ids_below<FeatureId>(segmentation.features.size()))
      if (!std::ranges::binary_search(removed, i)) left.push_back(i);
    return left;
  }
  [[nodiscard]] std::vector<Box> boxes() const {
    std::vector<Box> boxes;
    boxes.reserve(owners_.size());
    for (const FeatureId id : owners_) boxes.push_back(segmentation_.features[id.index()].box);
    return boxes;
  }

  const Segmentation& segmentation_;
  std::vector<FeatureId> owners_;
  BoxTree tree_;
};

/// Adds those edges of a facet that are shorter than asked for; `is_wanted` of two vertices.
template <class IsWanted>
void add_edges_below(const Solid& solid, const Facet& facet, double least_m, FeatureId owner,
                     const IsWanted& is_wanted, std::vector<ShortEdge>& edges) {
  for (const Loop& loop : facet.loops)
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const int v = loop[i], w = loop[(i + 1) % loop.size()];
      const Vec3 p = solid.vertices[at(v)].point, q = solid.vertices[at(w)].point;
      const double length_m = length(q - p);
      if (length_m < least_m - kRounding_m && is_wanted(v, w))
        edges.push_back({p, q, length_m, owner});
    }
}

/// Edges shorter than asked for, each once, their owners not known yet.
std::vector<ShortEdge> edges_below(const Solid& solid, double least_m) {
  std::vector<ShortEdge> edges;
  for (const Facet& facet : solid.facets)
    add_edges_below(solid, facet, least_m, {}, std::less{}, edges);
  return edges;
}

void find_owners(std::vector<ShortEdge>& edges, const Segmentation& segmentation,
                 const std::vector<FeatureId>& removed) {
  if (edges.empty()) return;
  const OwnerBoxes owners(segmentation, removed);
  for (ShortEdge& edge : edges) edge.feature = owners.smallest_around(edge.from, edge.to);
}

/// The corners of a solid, to find again what stays where it was: sorted along a direction that no
/// wall or row of windows is likely to stand across, so that few are at the same place of it.
class SolidCorners {
 public:
  explicit SolidCorners(const Solid& solid) {
    std::vector<char> is_met(solid.vertices.size(), 0);
    for (const Facet& facet : solid.facets)
      for (const Loop& loop : facet.loops)
        for (const int v : loop)
          if (std::exchange(is_met[at(v)], 1) == 0) {
            const Vec3 p = solid.vertices[at(v)].point;
            corners_.push_back({along(p), p});
          }
    std::ranges::sort(corners_, {}, &PlacedCorner::along);
  }

  [[nodiscard]] bool has(Vec3 p) const {
    constexpr double kReach_m = kOnBox_m + kRounding_m;
    const double place = along(p);
    auto next = std::ranges::lower_bound(corners_, place - kReach_m, {}, &PlacedCorner::along);
    for (; next != corners_.end() && next->along <= place + kReach_m; ++next)
      if (length(next->point - p) <= kOnBox_m) return true;
    return false;
  }

 private:
  struct PlacedCorner {
    double along;
    Vec3 point;
  };
  static double along(Vec3 p) {
    constexpr Vec3 kAskew{0.48, 0.64, 0.6};  // of length 1
    return dot(kAskew, p);
  }

  std::vector<PlacedCorner> corners_;
};

/// How far a feature reaches along a direction.
double extent_along(Vec3 direction, const Feature& feature, const Segmentation& segmentation) {
  double low = Box::kInfinity, high = -Box::kInfinity;
  for (const int v : feature.vertices) {
    const double along = dot(segmentation.vertices[at(v)].point, direction);
    low = std::min(low, along);
    high = std::max(high, along);
  }
  return high - low;
}

/// The edge runs along the depth of a recess.
bool is_depth(const ShortEdge& edge, const Segmentation& segmentation) {
  if (!edge.feature.is_valid()) return false;
  const Feature& feature = segmentation.features[edge.feature.index()];
  if (feature.sense != Sense::hole || feature.planes.empty()) return false;
  const Vec3 normal = segmentation.planes[feature.planes[0].index()].normal;
  return length(cross(normalised(edge.to - edge.from), normal)) < kDepthLean;
}

/// The edge is as long as its feature was along it: a block that is as deep as it was, a low window
/// that moved.
bool is_as_long_as_before(const ShortEdge& edge, const Segmentation& segmentation) {
  if (!edge.feature.is_valid()) return false;
  const Feature& feature = segmentation.features[edge.feature.index()];
  const Vec3 along = normalised(edge.to - edge.from);
  return edge.length_m >= extent_along(along, feature, segmentation) - kOnBox_m;
}

/// By input polygon the feature that an operator drew, or an invalid one if it only went with that.
std::map<int, FeatureId> drawn_polygons(const RedrawContext& context, const Generalised& made) {
  std::map<int, FeatureId> drawn;
  for (const FeatureId id : made.changed)
    for (const int polygon : context.feature(id).source_polygons) drawn.try_emplace(polygon, id);
  for (const FeatureId id : made.removed)
    for (const int polygon : context.feature(id).source_polygons) drawn.try_emplace(polygon);
  return drawn;
}

/// The feature that the facet was drawn for; invalid if it was not.
FeatureId drawn_owner(const Facet& facet, const std::map<int, FeatureId>& drawn) {
  FeatureId owner;
  for (const int polygon : facet.polygons) {
    const auto found = drawn.find(polygon);
    if (found == drawn.end()) return {};
    if (!owner.is_valid()) owner = found->second;
  }
  return owner;
}

/// Edges, shorter than asked for, of cells and outlines of what stays as it was: their ends.
std::vector<std::pair<Vec3, Vec3>> edges_of_staying(const Segmentation& segmentation,
                                                    const Generalised& drawn, double least_m) {
  std::vector<std::pair<Vec3, Vec3>> edges;
  const auto add = [&](const Loop& loop) {
    for (std::size_t i = 0; i < loop.size(); ++i) {
      const Vec3 p = segmentation.vertices[at(loop[i])].point;
      const Vec3 q = segmentation.vertices[at(loop[(i + 1) % loop.size()])].point;
      if (length(q - p) < least_m + 2 * kOnBox_m) edges.emplace_back(p, q);
    }
  };
  const auto stays = [&](FeatureId id) {
    return !std::ranges::binary_search(drawn.changed, id) &&
           !std::ranges::binary_search(drawn.removed, id);
  };
  for (const Cell& cell : segmentation.cells)
    if (stays(cell.feature))
      for (const Facet& facet : cell.facets)
        for (const Loop& loop : facet.loops) add(loop);
  for (const FeatureId i : ids_below<FeatureId>(segmentation.features.size()))
    if (stays(i)) add(segmentation.features[i.index()].outline);
  return edges;
}

/// The edge lies between these points, whichever way it runs.
bool has_ends(const ShortEdge& edge, Vec3 p, Vec3 q) {
  const auto are = [&](Vec3 from, Vec3 to) {
    return length(from - edge.from) <= kOnBox_m && length(to - edge.to) <= kOnBox_m;
  };
  return are(p, q) || are(q, p);
}

/// A facet of the solid as outlines.
struct FacetSheet {
  std::vector<Outline> outlines;
  Vec3 normal;
  double offset_m = 0;
};

FacetSheet sheet_of(const Solid& solid, const Facet& facet) {
  const Plane& plane = solid.planes[facet.plane.index()];
  return {outlines_of(solid.vertices, facet.loops), plane.normal, plane.offset_m};
}

Vec3 moved_onto(const FacetSheet& sheet, Vec3 p) {
  return p + (sheet.offset_m - dot(sheet.normal, p)) * sheet.normal;
}

/// A point of `of` that lies over the other sheet, seen along their normal.
std::optional<Vec3> point_over(const FacetSheet& of, const FacetSheet& other) {
  std::vector<Vec3> points;
  if (const auto inside = interior_point(of.outlines, of.normal)) points.push_back(*inside);
  for (const Outline& outline : of.outlines)
    points.insert(points.end(), outline.begin(), outline.end());
  for (const Vec3 p : points)
    if (contains_clearly(other.outlines, other.normal, moved_onto(other, p), kRounding_m)) return p;
  return std::nullopt;
}

/// Where an edge of one crosses an edge of the other, seen along their normal.
std::optional<Vec3> crossing(const FacetSheet& a, const FacetSheet& b) {
  for (const Outline& mine : a.outlines)
    for (std::size_t i = 0; i < mine.size(); ++i) {
      const Vec3 p = moved_onto(b, mine[i]), q = moved_onto(b, mine[(i + 1) % mine.size()]);
      for (const Outline& yours : b.outlines)
        for (std::size_t k = 0; k < yours.size(); ++k)
          if (do_cross(p, q, yours[k], yours[(k + 1) % yours.size()], b.normal, kRounding_m))
            return yours[k];
    }
  return std::nullopt;
}

}  // namespace

std::vector<ShortEdge> short_edges(const Solid& solid, const Segmentation& segmentation,
                                   const std::vector<FeatureId>& removed, double least_m) {
  std::vector<ShortEdge> edges = edges_below(solid, least_m);
  find_owners(edges, segmentation, removed);
  return edges;
}

std::vector<ShortEdge> new_short_edges(const RedrawContext& context, const Solid& after,
                                       const std::vector<FeatureId>& removed, double least_m) {
  std::vector<ShortEdge> edges = edges_below(after, least_m);
  if (edges.empty()) return edges;
  const SolidCorners corners(context.solid);
  std::erase_if(
      edges, [&](const ShortEdge& edge) { return corners.has(edge.from) && corners.has(edge.to); });
  find_owners(edges, context.segmentation, removed);
  std::erase_if(edges, [&](const ShortEdge& edge) { return is_depth(edge, context.segmentation); });
  return edges;
}

std::vector<ShortEdge> short_edges_of_drawn(const RedrawContext& context, const Generalised& drawn,
                                            double least_m) {
  std::vector<ShortEdge> edges;
  const auto polygons = drawn_polygons(context, drawn);
  for (const Facet& facet : drawn.solid.facets)
    if (const FeatureId owner = drawn_owner(facet, polygons); owner.is_valid())
      add_edges_below(
          drawn.solid, facet, least_m, owner, [](int, int) { return true; }, edges);
  if (edges.empty()) return edges;
  const SolidCorners corners(context.solid);
  std::erase_if(edges, [&](const ShortEdge& edge) {
    return is_depth(edge, context.segmentation) ||
           is_as_long_as_before(edge, context.segmentation) ||
           (corners.has(edge.from) && corners.has(edge.to));
  });
  return edges;
}

std::vector<ShortEdge> without_whole_edges(std::vector<ShortEdge> edges,
                                           const Segmentation& segmentation,
                                           const Generalised& drawn, double least_m) {
  if (edges.empty()) return edges;
  const auto whole = edges_of_staying(segmentation, drawn, least_m);
  std::erase_if(edges, [&](const ShortEdge& edge) {
    return std::ranges::any_of(
        whole, [&](const auto& ends) { return has_ends(edge, ends.first, ends.second); });
  });
  return edges;
}

std::vector<NarrowGap> narrow_gaps(const Solid& solid, const Segmentation& segmentation,
                                   const std::vector<FeatureId>& removed, double least_m) {
  std::map<std::array<std::int64_t, 3>, std::vector<FacetSheet>> by_normal;
  for (const Facet& facet : solid.facets)
    by_normal[solid.planes[facet.plane.index()].coefficients].push_back(sheet_of(solid, facet));
  std::vector<NarrowGap> gaps;
  const OwnerBoxes owners(segmentation, removed);
  for (const auto& [normal, sheets] : by_normal) {
    const std::array<std::int64_t, 3> back{-normal[0], -normal[1], -normal[2]};
    const auto opposite = by_normal.find(back);
    if (opposite == by_normal.end() || back < normal) continue;
    for (const FacetSheet& one : sheets)
      for (const FacetSheet& other : opposite->second) {
        const double width_m = -other.offset_m - one.offset_m;
        if (width_m < kRounding_m || width_m >= least_m - kRounding_m) continue;
        auto where = point_over(one, other);
        if (!where) where = point_over(other, one);
        if (!where) where = crossing(one, other);
        if (!where) continue;
        gaps.push_back({*where, width_m, owners.smallest_around(*where, *where)});
      }
  }
  return gaps;
}

bool add_fine_owners(const RedrawContext& context, const Generalised& generalised, double least_m,
                     double most_b_m, const std::string& rule, Plan& plan) {
  const auto has_step = [&](FeatureId id) {
    return std::ranges::find(plan.steps, id, &Step::feature) != plan.steps.end();
  };
  std::set<FeatureId> owners;
  for (const ShortEdge& edge :
       short_edges(generalised.solid, context.segmentation, generalised.removed, least_m)) {
    FeatureId id = edge.feature;
    while (id.is_valid() && has_step(id)) {
      const Feature& feature = context.feature(id);
      id = feature.parent.is_valid() ? feature.parent : feature.host;
    }
    if (id.is_valid() && context.table.number(id, Attribute::b).value_or(most_b_m) < most_b_m)
      owners.insert(id);
  }
  for (const FeatureId id : owners) plan.steps.push_back({id, "omit", rule});
  std::ranges::stable_sort(plan.steps, {}, &Step::feature);
  return !owners.empty();
}

namespace {

std::string place_text(Vec3 local_m, const Frame& frame) {
  const Vec3 p = local_m + frame.origin_m;
  return fmt::format("({:.3f}, {:.3f}, {:.3f})", p.x, p.y, p.z);
}

/// What of one feature, or of the body, is too fine for one reason.
struct FinePart {
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
using FineParts = std::map<std::pair<FeatureId, std::string>, FinePart>;

/// That the feature was to change and was refused, or nothing.
std::string refusal_of(FeatureId feature, const Generalised& generalised) {
  const auto found = std::ranges::find(generalised.refused, feature, &RefusedStep::feature);
  return found == generalised.refused.end() ? "" : "it was refused, " + to_string(found->code);
}

/// Why a new edge is there: its feature was refused, or it could not be cleared.
std::string reason_of(const ShortEdge& edge, const Generalised& generalised,
                      const std::string& otherwise) {
  std::string refusal = refusal_of(edge.feature, generalised);
  if (!refusal.empty()) return refusal;
  for (const UnclearedEdge& left : generalised.uncleared)
    if (has_ends(edge, left.from, left.to)) return left.reason;
  return otherwise;
}

}  // namespace

std::vector<Issue> fineness_issues(const RedrawContext& context, const Solid& after,
                                   const Generalised& generalised, const Fineness& asked) {
  const double least_m = asked.least_m;
  const std::vector<FeatureId>& removed = generalised.removed;
  const auto found = asked.is_everywhere
                         ? short_edges(after, context.segmentation, removed, least_m)
                         : new_short_edges(context, after, removed, least_m);
  FineParts edges, whole, gaps;
  const auto add = [&](FineParts& findings, FeatureId feature, double size_m, Vec3 at) {
    findings[{feature, refusal_of(feature, generalised)}].add(size_m, at);
  };
  if (asked.is_everywhere) {
    for (const ShortEdge& edge : found) add(edges, edge.feature, edge.length_m, edge.from);
    for (const NarrowGap& gap : narrow_gaps(after, context.segmentation, removed, least_m))
      add(gaps, gap.feature, gap.width_m, gap.at);
  } else {
    const auto torn = without_whole_edges(found, context.segmentation, generalised, least_m);
    for (const ShortEdge& edge : torn)
      edges[{edge.feature, reason_of(edge, generalised, asked.why_not_tried)}].add(edge.length_m,
                                                                                   edge.from);
    for (const ShortEdge& edge : found)
      if (std::ranges::find(torn, edge) == torn.end())
        add(whole, edge.feature, edge.length_m, edge.from);
  }

  std::vector<Issue> issues;
  const auto report = [&](const FineParts& findings, Code code, const char* what,
                          bool is_left = true) {
    for (const auto& [whose, finding] : findings) {
      const auto& [feature, reason] = whose;
      const bool is_new =
          is_left && reason != asked.why_not_tried && refusal_of(feature, generalised).empty();
      issues.push_back(context.issue(
          asked.is_everywhere || is_new ? Severity::warning : Severity::note, code, feature,
          fmt::format("has {} {}, the least of {:.3f} m at {}{}{}", finding.count,
                      fmt::format(fmt::runtime(what), least_m), finding.least_m,
                      place_text(finding.at, context.building.frame), reason.empty() ? "" : ": ",
                      reason)));
    }
  };
  report(edges, Code::G415, "edges below {} m left");
  report(whole, Code::G415, "edges below {} m of parts that stay unchanged", false);
  report(gaps, Code::G416, "gaps below {} m left");
  return issues;
}

}  // namespace oriel
