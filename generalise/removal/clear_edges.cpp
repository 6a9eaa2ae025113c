#include "generalise/removal/clear_edges.h"

#include "generalise/invariants/fineness.h"
#include "generalise/invariants/stays.h"
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
  EdgeClearer(const RedrawContext& context, Generalised drawn)
      : context_(context),
        drawn_(std::move(drawn)),
        staying_(context.segmentation, drawn_.removed),
        short_(short_edges_of(drawn_.solid)) {}

  Generalised run() {
    while (clear_one()) {
    }
    return std::move(drawn_);
  }

 private:
  /// Drops one facet. False if none can go: then all edges are left, each with its reason.
  bool clear_one() {
    drawn_.uncleared.clear();
    list_edges();
    for (const ShortEdge& edge : short_) {
      std::string reason;
      if (clear(edge, reason)) return true;
      drawn_.uncleared.push_back({edge.from, edge.to, std::move(reason)});
    }
    return false;
  }

  bool clear(const ShortEdge& edge, std::string& reason) {
    if (context_.judge == nullptr) {
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
    for (const FacetId f : ids_below<FacetId>(solid().facets.size()))
      for (const Loop& loop : solid().facets[f.index()].loops)
        for (std::size_t i = 0; i < loop.size(); ++i) {
          const Vec3 p = solid().vertices[at(loop[i])].point;
          const Vec3 q = solid().vertices[at(loop[(i + 1) % loop.size()])].point;
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
    const auto corners = [&](FacetId id) { return solid().facets[id.index()].loops[0].size(); };
    std::ranges::stable_sort(out, {}, corners);
    return out;
  }

  /// Why the facet cannot go, or nothing: then it is gone.
  std::string drop(FacetId facet) {
    if (auto reason = staying_.why_it_stays(solid(), solid().facets[facet.index()]))
      return std::move(*reason);
    if (!context_.may_go_on(solid(), kStepsPerDrop)) return kNoWorkLeft;
    DroppedFacet dropped = drop_facet(solid(), facet, context_.invariants.least_edge_m);
    if (!dropped.solid) return std::move(dropped.reason);
    auto left = short_edges_of(*dropped.solid);
    if (left.size() >= short_.size()) return "edges as short would be left";
    if (const auto broken = context_.violation_by(*dropped.solid)) return broken->sentence;
    // The solid as it is now is judged only where that decides.
    if (!fitness_) fitness_ = context_.judge->fitness_of(solid());
    const Fitness fitness = context_.judge->fitness_of(*dropped.solid);
    if (fitness < *fitness_) return "the building would not be valid";
    fitness_ = fitness;
    drawn_.solid = std::move(*dropped.solid);
    short_ = std::move(left);
    return {};
  }

  [[nodiscard]] const Solid& solid() const { return drawn_.solid; }

  /// The edges of a solid that are to go.
  [[nodiscard]] std::vector<ShortEdge> short_edges_of(const Solid& of) const {
    const double least_m = context_.invariants.least_edge_m;
    return without_whole_edges(new_short_edges(context_, of, drawn_.removed, least_m),
                               context_.segmentation, drawn_, least_m);
  }

  const RedrawContext& context_;
  Generalised drawn_;
  detail::StayingFeatures staying_;
  std::optional<Fitness> fitness_;  ///< of the solid
  std::vector<ShortEdge> short_;
  std::vector<FacetEdge> edges_;  ///< of the solid, as long as those, sorted
};

}  // namespace

Generalised clear_edges(const RedrawContext& context, Generalised drawn) {
  return EdgeClearer(context, std::move(drawn)).run();
}

}  // namespace oriel
