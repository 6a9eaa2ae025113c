#include "generalise/invariants/stays.h"
#include "generalise/removal/removal.h"
#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/planar.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace oriel {

namespace {

Outline outline_of_loop(const std::vector<Vertex>& vertices, const Loop& loop) {
  Outline outline;
  for (const int v : loop) outline.push_back(vertices[at(v)].point);
  return outline;
}

/// What filling a ring takes, for each corner of the solid.
constexpr std::int64_t kStepsPerRing = 32;

class RingFiller {
 public:
  RingFiller(const RedrawContext& context, Solid solid)
      : segmentation_(context.segmentation),
        weld_m_(context.options.tolerances.weld_m),
        solid_(std::move(solid)),
        goes_(solid_.facets.size(), 0) {
    for (const FacetId f : goes_.ids())
      for (const Loop& loop : solid_.facets[f.index()].loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
          facet_at_[{loop[i], loop[(i + 1) % loop.size()]}] = f;
  }

  /// The solid without what stands in the feature's ring; nothing if that hangs on something else.
  std::optional<Solid> without(const Feature& feature) {
    const Plane& plane = segmentation_.planes[feature.planes[0].index()];
    const std::vector<Outline> ring{outline_of_loop(segmentation_.vertices, feature.outline)};
    for (const FacetId f : goes_.ids()) {
      const Facet& facet = solid_.facets[f.index()];
      if (!lies_in(solid_.planes[facet.plane.index()], plane)) continue;
      for (std::size_t loop = 1; loop < facet.loops.size(); ++loop)
        if (is_within(facet.loops[loop], ring, plane.normal) && !flood(f, facet.loops[loop]))
          return std::nullopt;
    }
    return rest(ring, plane);
  }

 private:
  [[nodiscard]] bool lies_in(const Plane& its, const Plane& plane) const {
    return its.coefficients == plane.coefficients &&
           std::abs(its.offset_m - plane.offset_m) <= weld_m_;
  }

  [[nodiscard]] bool is_within(const Loop& loop, const std::vector<Outline>& ring,
                               Vec3 normal) const {
    const std::vector<Outline> shape{outline_of_loop(solid_.vertices, loop)};
    const auto point = interior_point(shape, normal);
    return point && contains(ring, normal, *point);
  }

  /// Marks all that hangs on the loop; false if its own facet does so another way.
  bool flood(FacetId own, const Loop& loop) {
    std::vector<FacetId> open;
    const auto visit = [&](int from, int to) {
      const FacetId facet = facet_at_.at({to, from});
      if (goes_[facet] != 0) return;
      goes_[facet] = 1;
      open.push_back(facet);
    };
    for (std::size_t i = 0; i < loop.size(); ++i) visit(loop[i], loop[(i + 1) % loop.size()]);
    while (!open.empty() && goes_[own] == 0) {
      const FacetId facet = open.back();
      open.pop_back();
      for (const Loop& its : solid_.facets[facet.index()].loops)
        for (std::size_t i = 0; i < its.size(); ++i) {
          const int from = its[i], to = its[(i + 1) % its.size()];
          if (facet_at_.at({to, from}) == own && is_edge_of(loop, to, from)) continue;
          visit(from, to);
        }
    }
    return goes_[own] == 0;
  }

  [[nodiscard]] static bool is_edge_of(const Loop& loop, int from, int to) {
    const auto found = std::ranges::find(loop, from);
    if (found == loop.end()) return false;
    return *(std::next(found) == loop.end() ? loop.begin() : std::next(found)) == to;
  }

  /// What is not marked, with the facets in the ring's plane closed over it.
  [[nodiscard]] Solid rest(const std::vector<Outline>& ring, const Plane& plane) const {
    Solid out = solid_;
    out.facets.clear();
    out.vertices.clear();
    IndexedVector<FacetId, FacetId> numbers(solid_.facets.size());
    std::map<int, int> vertices;
    for (const FacetId f : goes_.ids()) {
      if (goes_[f] != 0) continue;
      Facet facet = solid_.facets[f.index()];
      if (lies_in(solid_.planes[facet.plane.index()], plane))
        facet.loops.erase(
            std::remove_if(facet.loops.begin() + 1, facet.loops.end(),
                           [&](const Loop& loop) { return is_within(loop, ring, plane.normal); }),
            facet.loops.end());
      for (Loop& loop : facet.loops)
        for (int& v : loop) {
          const auto [entry, is_new] = vertices.emplace(v, static_cast<int>(vertices.size()));
          if (is_new) out.vertices.push_back(solid_.vertices[at(v)]);
          v = entry->second;
        }
      numbers[f] = FacetId{static_cast<int>(out.facets.size())};
      out.facets.push_back(std::move(facet));
    }
    for (Shell& shell : out.shells) {
      std::erase_if(shell.facets, [&](FacetId id) { return !numbers[id].is_valid(); });
      for (FacetId& id : shell.facets) id = numbers[id];
    }
    return out;
  }

  const Segmentation& segmentation_;
  double weld_m_;
  Solid solid_;
  std::map<std::pair<int, int>, FacetId> facet_at_;  ///< by directed edge
  IndexedVector<FacetId, char> goes_;
};

}  // namespace

Remainder fill_rings(const RedrawContext& context, Remainder remainder) {
  std::vector<FeatureId> rings;
  for (const Refusal& refusal : remainder.refused)
    if (context.feature(refusal.feature).is_uncut) rings.push_back(refusal.feature);
  for (const FeatureId id : rings) {
    if (std::ranges::binary_search(remainder.removed, id)) continue;  // it went with another one
    if (!context.may_go_on(remainder.solid, kStepsPerRing)) break;
    auto made = RingFiller(context, remainder.solid).without(context.feature(id));
    if (!made || !is_closed(*made) || volume_m3(*made) <= 0) continue;
    std::vector<FeatureId> gone = remainder.removed;
    gone.push_back(id);
    gone = with_what_sits_on(context.segmentation, gone);
    if (detail::loses_what_stays(remainder.solid, *made, context.segmentation, gone)) continue;
    if (context.judge != nullptr && context.judge->fitness_of(*made) == Fitness::unfit) continue;
    remainder.solid = std::move(*made);
    remainder.removed = std::move(gone);
  }
  std::erase_if(remainder.refused, [&](const Refusal& refusal) {
    return std::ranges::binary_search(remainder.removed, refusal.feature);
  });
  return remainder;
}

}  // namespace oriel
