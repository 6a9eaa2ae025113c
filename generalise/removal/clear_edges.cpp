#include "generalise/removal/clear_edges.h"

#include "kernel/attach/drop_facet.h"
#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/planar.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// What dropping a facet and looking for short edges takes, for each corner of the solid.
constexpr std::int64_t kStepsPerDrop = 32;

class EdgeClearer {
 public:
  EdgeClearer(Solid solid, const ClearOrder& order, const SolidValidator& validator)
      : solid_(std::move(solid)), order_(order), validator_(validator) {}

  Cleared run() {
    short_ = order_.short_edges_of(solid_);
    while (clear_one()) {
    }
    return {std::move(solid_), std::move(left_)};
  }

 private:
  /// Drops one facet. False if none can go: then all edges are left, each with its reason.
  bool clear_one() {
    left_.clear();
    list_edges();
    for (const ShortEdge& edge : short_) {
      std::string reason;
      if (clear(edge, reason)) return true;
      left_.push_back({edge.from, edge.to, std::move(reason)});
    }
    return false;
  }

  bool clear(const ShortEdge& edge, std::string& reason) {
    if (!validator_) {
      reason = "whether the building would still be valid was not checked";
      return false;
    }
    for (const FacetId facet : facets_at(edge)) {
      std::string why_not = drop(facet);
      if (why_not.empty()) return true;
      if (reason.empty()) reason = "cannot remove the narrow facet: " + std::move(why_not);
    }
    return false;
  }

  /// An edge of a facet, its ends in either order.
  struct FacetEdge {
    Vec3 less, more;
    FacetId facet;
  };
  static FacetEdge facet_edge(Vec3 p, Vec3 q, FacetId facet) {
    return is_lesser(q, p) ? FacetEdge{q, p, facet} : FacetEdge{p, q, facet};
  }
  static bool is_before(const FacetEdge& one, const FacetEdge& other) {
    if (one.less != other.less) return is_lesser(one.less, other.less);
    return is_lesser(one.more, other.more);
  }

  /// Lists the edges of the solid that are no longer than those that are too short.
  void list_edges() {
    double most_m = 0;
    for (const ShortEdge& edge : short_) most_m = std::max(most_m, edge.length_m);
    edges_.clear();
    for (const FacetId f : ids_below<FacetId>(solid_.facets.size()))
      for (const Loop& loop : solid_.facets[f.index()].loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
          const Vec3 p = solid_.vertices[at(loop[i])].point;
          const Vec3 q = solid_.vertices[at(loop[(i + 1) % loop.size()])].point;
          if (length(q - p) <= most_m) edges_.push_back(facet_edge(p, q, f));
        }
    std::ranges::stable_sort(edges_, is_before);
  }

  /// The facets beside the edge, the one with fewer corners first.
  [[nodiscard]] std::vector<FacetId> facets_at(const ShortEdge& edge) const {
    std::vector<FacetId> out;
    for (const FacetEdge& its :
         std::ranges::equal_range(edges_, facet_edge(edge.from, edge.to, {}), is_before))
      out.push_back(its.facet);
    const auto corners = [&](FacetId id) { return solid_.facets[id.index()].loops[0].size(); };
    std::ranges::stable_sort(out, {}, corners);
    return out;
  }

  /// Why the facet cannot go, or nothing: then it is gone.
  std::string drop(FacetId facet) {
    if (auto reason = order_.keeps_facet(solid_, solid_.facets[facet.index()]))
      return std::move(*reason);
    if (!may_go_on(validator_.work, solid_, kStepsPerDrop)) return kNoWorkLeft;
    DroppedFacet dropped = drop_facet(solid_, facet, order_.reach_m);
    if (!dropped.solid) return std::move(dropped.reason);
    auto left = order_.short_edges_of(*dropped.solid);
    if (left.size() >= short_.size()) return "edges as short would be left";
    if (validator_.violation_of)
      if (const auto violation = validator_.violation_of(*dropped.solid))
        return violation->sentence;
    // The solid as it is now is judged only where that decides.
    if (!fitness_) fitness_ = validator_.fitness_of(solid_);
    const Fitness fitness = validator_.fitness_of(*dropped.solid);
    if (fitness < *fitness_) return "the building would not be valid";
    fitness_ = fitness;
    solid_ = std::move(*dropped.solid);
    short_ = std::move(left);
    return {};
  }

  Solid solid_;
  const ClearOrder& order_;
  const SolidValidator& validator_;
  std::optional<Fitness> fitness_;  ///< of solid_
  std::vector<ShortEdge> short_;
  std::vector<FacetEdge> edges_;  ///< of solid_, as long as those, sorted
  std::vector<UnclearedEdge> left_;
};

}  // namespace

Cleared clear_edges(Solid solid, const ClearOrder& order, const SolidValidator& validator) {
  return EdgeClearer(std::move(solid), order, validator).run();
}

}  // namespace oriel
