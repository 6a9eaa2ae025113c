#include "kernel/segment/remove.h"

#include "kernel/base/indexed_vector.h"
#include "kernel/base/issue.h"
#include "kernel/geometry/outlines.h"
#include "kernel/segment/boundary/parting.h"
#include "kernel/segment/cuts/carve.h"
#include "kernel/segment/cuts/patch.h"
#include "kernel/segment/removal/feature_cut.h"
#include "kernel/segment/removal/ring_cut.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <set>
#include <span>
#include <utility>

namespace oriel {

namespace {

using detail::Boundary;
using detail::PlaneSide;

/// What sits on or in a feature goes with it. By feature.
std::vector<char> spread(std::vector<char> go, const Segmentation& segmentation) {
  for (bool has_changed = true; has_changed;) {
    has_changed = false;
    for (std::size_t i = 0; i < go.size(); ++i) {
      const Feature& f = segmentation.features[i];
      const bool carrier_goes = (f.parent.is_valid() && go[f.parent.index()]) ||
                                (f.host.is_valid() && go[f.host.index()]);
      if (go[i] || !carrier_goes) continue;
      go[i] = 1;
      has_changed = true;
    }
  }
  return go;
}

/// As many features come off in a step for each half-edge of a body.
constexpr std::int64_t kCutsPerStep = 4;

class FeatureRemover {
 public:
  FeatureRemover(const Solid& solid, const Segmentation& segmentation,
                 const SegmentOptions& options, Work* work)
      : solid_(solid), segmentation_(segmentation), options_(options), work_(work), world_(solid) {
    int lumps = 0;
    for (const Shell& shell : solid.shells) lumps = std::max(lumps, shell.lump + 1);
    for (int lump = 0; lump < lumps; ++lump) bodies_.push_back(boundary_of(solid, lump, world_));
    for (const FacetId f : ids_below<FacetId>(solid.facets.size()))
      for (const int polygon : solid.facets[f.index()].polygons) facets_.emplace_back(polygon, f);
    std::ranges::sort(facets_);
  }

  Remainder run(const std::vector<FeatureId>& asked) {
    wanted_.assign(segmentation_.features.size(), 0);
    for (const FeatureId id : asked) wanted_[id.index()] = 1;
    hosted_.resize(segmentation_.features.size());
    for (const FeatureId i : ids_below<FeatureId>(segmentation_.features.size())) enter(i);
    const std::vector<Boundary> untouched = bodies_;
    const std::vector<char> all_wanted = wanted_;
    while (!try_all()) {
      bodies_ = untouched;
      if (!may_try_again(asked.size())) return nothing_removed(asked);
      if (!std::exchange(is_spoilt_, false)) continue;
      is_careful_ = true;
      wanted_ = all_wanted;
      out_.refused.clear();
    }
    for (const FeatureId i : ids_below<FeatureId>(segmentation_.features.size()))
      if (go_[i.index()]) out_.removed.push_back(i);
    out_.solid = remaining_solid();
    return std::move(out_);
  }

 private:
  [[nodiscard]] const Feature& feature(FeatureId id) const {
    return segmentation_.features[id.index()];
  }

  /// Counts what it takes to take features off bodies that are whole again.
  [[nodiscard]] bool may_try_again(std::size_t features) const {
    if (work_ == nullptr) return true;
    std::int64_t half_edges = 0;
    for (const Boundary& body : bodies_) half_edges += body.half_edge_count();
    work_->add(half_edges * (1 + static_cast<std::int64_t>(features) / kCutsPerStep));
    return !work_->is_used_up();
  }

  [[nodiscard]] Remainder nothing_removed(const std::vector<FeatureId>& asked) const {
    Remainder out{solid_, {}, {}};
    for (const FeatureId id : asked)
      out.refused.push_back({id, "the work budget is used up", Code::E502});
    std::ranges::sort(out.refused, {}, &Refusal::feature);
    return out;
  }

  /// Where others are looked for by it.
  void enter(FeatureId id) {
    const Feature& f = feature(id);
    if (f.host.is_valid()) hosted_[f.host.index()].push_back(id);
    if (f.sense == Sense::cavity) cavities_.push_back(id);
    if (f.source_polygons.empty()) return;
    const std::size_t first = at(f.source_polygons.front());
    if (first >= starting_at_.size()) starting_at_.resize(first + 1);
    starting_at_[first].push_back(id);
  }

  /// Removes all that is wanted, one after the other. False if something was refused after what
  /// sits on it had gone: then all has to be done again without it. False also if a body was spoilt
  /// by a cut that could not be made: then all has to be done again carefully.
  bool try_all() {
    go_ = spread(wanted_, segmentation_);
    rings_.clear();
    for (const Boundary& body : bodies_) rings_.emplace_back(body);
    for (const FeatureId id : ids_below<FeatureId>(segmentation_.features.size())) {
      if (!go_[id.index()] || goes_with_parent(id)) continue;
      const auto reason = remove(id);
      if (is_spoilt_ || (reason && !refuse(id, *reason))) return false;
    }
    return true;
  }

  [[nodiscard]] bool goes_with_parent(FeatureId id) const {
    const FeatureId parent = feature(id).parent;
    return parent.is_valid() && go_[parent.index()];
  }

  /// The feature stays, and so does what was to go for its sake only. False if some of that is gone
  /// already.
  bool refuse(FeatureId id, const std::string& reason) {
    if (std::ranges::find(out_.refused, id, &Refusal::feature) == out_.refused.end())
      out_.refused.push_back({id, reason});
    wanted_[id.index()] = 0;
    go_[id.index()] = 0;
    const std::vector<char> still = spread(wanted_, segmentation_);
    for (std::size_t i = 0; i < go_.size(); ++i) {
      if (!go_[i] || still[i]) continue;
      if (i < id.index()) return false;
      go_[i] = 0;
    }
    return true;
  }

  /// A facet of a cell is part of the solid's boundary that looks to `side`.
  [[nodiscard]] bool is_on_surface(const Facet& facet, PlaneSide side) const {
    const Vec3 normal = world_.planes.normal(side);
    const auto shape = outlines_of(segmentation_.vertices, facet.loops);
    const auto point = interior_point(shape, normal);
    return point && std::ranges::any_of(solid_.facets, [&](const Facet& of_solid) {
             if (world_.planes.side_of(of_solid.plane) != side) return false;
             return contains(outlines_of(solid_.vertices, of_solid.loops), normal, *point);
           });
  }

  /// Nothing if it went well, else the reason why not.
  std::optional<std::string> remove(FeatureId id) {
    const Feature& f = feature(id);
    if (f.sense == Sense::cavity) return fill_cavity(f);
    if (f.sense == Sense::imprint) {
      // There is nothing to cut: its facet is that of its host. What it owns went before it.
      if (has_hosted_that_stays(id)) return "what lies in it cannot be removed";
      return std::nullopt;
    }
    if (f.is_uncut) return "no single cut isolates it: only its ring is known";
    std::vector<PlaneSide> sides;
    for (const PlaneId plane : f.planes) {
      const auto side = world_.planes.find(segmentation_.planes[plane.index()]);
      if (!side) return "it lies on a part that stays";
      sides.push_back(*side);
    }
    auto reason = sides.size() == 1 ? remove_by_section(f, sides[0]) : remove_by_patch(f, sides);
    if (!reason || is_spoilt_ || !f.parent.is_valid()) return reason;
    const auto all_sides = sides_around(id);
    if (all_sides.size() > sides.size() && !remove_by_patch(f, all_sides)) return std::nullopt;
    return reason;
  }

  /// A feature that sits on this one, or on what does, is refused.
  [[nodiscard]] bool has_hosted_that_stays(FeatureId id) const {
    return std::ranges::any_of(hosted_[id.index()], [&](FeatureId hosted) {
      return !go_[hosted.index()] || has_hosted_that_stays(hosted);
    });
  }

  /// The sides that part of a part meets the body in: its own cut, and those that its carriers were
  /// cut at.
  [[nodiscard]] std::vector<PlaneSide> sides_around(FeatureId id) const {
    std::set<PlaneSide> sides;
    const int sign = feature(id).sense == Sense::protrusion ? 1 : -1;
    for (const Cell& cell : segmentation_.cells) {
      if (cell.feature != id || cell.sign != sign) continue;
      for (const Facet& facet : cell.facets) {
        const auto side = world_.planes.find(segmentation_.planes[facet.plane.index()]);
        if (!side) continue;
        // Of a void, and of what stays beside a part, the boundary looks the other way.
        const PlaneSide surface = sign > 0 ? *side : *side ^ 1;
        if (!is_on_surface(facet, surface)) sides.insert(surface ^ 1);
      }
    }
    return {sides.begin(), sides.end()};
  }

  std::optional<std::string> remove_by_section(const Feature& f, PlaneSide split) {
    // A protrusion is in front of its plane, a hole behind it.
    const bool is_material = f.sense == Sense::protrusion;
    const int direction = ((split & 1) == 0) == is_material ? 1 : -1;
    const std::vector<FacetId> sources = facets_of(f);
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      Boundary& body = bodies_[b];
      if (const auto caps =
              rings_[b].find(body, split >> 1, direction, is_material, f.cap_point, sources))
        return take(body, *caps, f);
      const auto cut = find_feature_cut(body, split >> 1, direction, is_material, f.cap_point,
                                        {-1, options_.tolerances.weld_m, false, true});
      if (!cut) continue;
      const detail::Lump& lump = cut->lump;
      if (!lump.is_finite || !lump.is_sound || lump.volume <= 0) return "its cut no longer closes";
      if (cut->caps) return take(body, *cut->caps, f);
      return take_imprinted(body, *cut, f);
    }
    return "its cut is no longer found";
  }

  /// The facets of the solid that its input polygons lie in.
  [[nodiscard]] std::vector<FacetId> facets_of(const Feature& f) const {
    std::vector<FacetId> facets;
    for (const int polygon : f.source_polygons)
      for (const auto& [its, facet] :
           std::ranges::equal_range(facets_, polygon, {}, &std::pair<int, FacetId>::first))
        facets.push_back(facet);
    return facets;
  }

  std::optional<std::string> remove_by_patch(const Feature& f, std::vector<PlaneSide> sides) {
    std::ranges::sort(sides);
    for (Boundary& body : bodies_)
      for (const detail::Patch& patch :
           find_patches(body, f.sense == Sense::hole,
                        {.free_side = detail::ground_side(solid_, world_.planes,
                                                          options_.tolerances.coplanar_deg),
                        .is_natural_order = f.sense == Sense::protrusion,
                        .sides = sides})) {
        if (patch.sides() != sides || !has_cap_at(patch, f.cap_point)) continue;
        return take(body, patch.caps, f);
      }
    return "its cut is no longer found";
  }

  [[nodiscard]] bool has_cap_at(const detail::Patch& patch, Vec3 point) const {
    return std::ranges::any_of(patch.caps, [&](const detail::CutCap& cap) {
      const Vec3 normal = world_.planes.normal(cap.side);
      constexpr double kOnPlane_m =
          1e-6;  // tolerance of doubles: the point was made on the plane of one of the caps
      if (std::abs(dot(normal, point) - world_.planes.offset_m(cap.side)) > kOnPlane_m)
        return false;
      std::vector<Outline> shape;
      for (const detail::CapLoop& loop : cap.loops) {
        shape.emplace_back();
        for (const detail::CapEdge& edge : loop.edges)
          shape.back().push_back(world_.points.at(edge.from));
      }
      return contains(shape, normal, point);
    });
  }

  /// A body to try a cut on, in the memory of the one before.
  Boundary& copy_of(const Boundary& body) {
    if (trial_)
      *trial_ = body;
    else
      trial_.emplace(body);
    return *trial_;
  }

  /// Takes the part inside the caps off the body if nothing goes that is to stay.
  std::optional<std::string> take(Boundary& body, const std::vector<detail::CutCap>& caps,
                                  const Feature& f) {
    std::optional<std::string> reason = "its cut no longer closes";
    bool is_told_by_rest = false;
    const auto accepts = [&](const Boundary& lump) {
      reason = fault_of(lump, f);
      is_told_by_rest = !reason && !endangered_by(lump, f).empty();
      return !reason && !is_told_by_rest;
    };
    take_off(body, caps, f.sense == Sense::hole, {}, {}, accepts);
    if (!is_told_by_rest) return reason;
    copy_of(body);
    return take_on_trial(body, caps, f);
  }

  /// The same on the copy of a body: it takes the body's place.
  std::optional<std::string> take_on_trial(Boundary& body, const std::vector<detail::CutCap>& caps,
                                           const Feature& f) {
    if (auto reason = why_not_without(*trial_, caps, f)) return reason;
    std::swap(body, *trial_);
    return std::nullopt;
  }

  /// Splits facets for the cut, and takes the part off. Nearly always that goes well, so only a
  /// body of which a part has turned out to stay is copied before.
  std::optional<std::string> take_imprinted(Boundary& body, const detail::FeatureCut& cut,
                                            const Feature& f) {
    Boundary& trial = is_careful_ ? copy_of(body) : body;
    std::vector<PointId> touched;
    const auto caps = imprint(trial, cut.section, cut.lump, touched);
    if (is_careful_) return take_on_trial(body, caps, f);
    auto reason = why_not_without(body, caps, f);
    is_spoilt_ = reason.has_value();
    return reason;
  }

  /// Takes the part inside the caps off for good; the reason if that should not have been.
  std::optional<std::string> why_not_without(Boundary& body,
                                             const std::vector<detail::CutCap>& caps,
                                             const Feature& f) const {
    const auto carved = take_off(body, caps, f.sense == Sense::hole, {}, {});
    if (!carved) return "its cut no longer closes";
    if (auto reason = fault_of(carved->lump, f)) return reason;
    if (loses_others(carved->lump, body, f)) return "a feature that stays would go with it";
    return std::nullopt;
  }

  [[nodiscard]] std::optional<std::string> fault_of(const Boundary& lump, const Feature& f) const {
    if (!is_within(lump, f)) return "its cut would take more than the feature";
    if (f.sense == Sense::protrusion && holds_cavity(lump))
      return "a feature that stays would go with it";
    return std::nullopt;
  }

  /// A cut that was made in a part, or after others, may meet more when it is made in the whole.
  [[nodiscard]] bool is_within(const Boundary& lump, const Feature& f) const {
    Box of_lump;
    for (const detail::BodyFacetId facet : lump.living_facets())
      lump.for_each_edge(facet, [&](EdgeId e) { of_lump.grow(world_.points.at(lump.origin(e))); });
    const double slack_m = options_.tolerances.weld_m;
    const auto all_not_below = [](Vec3 p, Vec3 q) {
      return p.x >= q.x && p.y >= q.y && p.z >= q.z;
    };
    const Vec3 slack{slack_m, slack_m, slack_m};
    return lump.volume() <= f.volume_m3 + slack_m * f.surface_m2 &&
           all_not_below(of_lump.min, f.box.min - slack) &&
           all_not_below(f.box.max + slack, of_lump.max);
  }

  /// The input polygons that have a share in the boundary.
  [[nodiscard]] std::set<int> polygons_of(const Boundary& body) const {
    std::set<int> polygons;
    for_each_polygon(body, [&](int polygon) { polygons.insert(polygon); });
    return polygons;
  }
  template <class Visit>
  void for_each_polygon(const Boundary& body, const Visit& visit) const {
    for (const detail::BodyFacetId facet : body.living_facets())
      for (const FacetId source : body.facet(facet).sources)
        for (const int polygon : solid_.facets[source.index()].polygons) visit(polygon);
  }

  /// The features that are to stay and have surface on the lump, and on the rest if at all: nearly
  /// always none.
  [[nodiscard]] std::vector<const Feature*> endangered_by(const Boundary& lump,
                                                          const Feature& f) const {
    const std::set<int> lost = polygons_of(lump);
    std::vector<const Feature*> endangered;
    for (const int polygon : lost)
      for (const FeatureId id : starting_at(polygon))
        if (!go_[id.index()] && !carries(feature(id), f) && has_all(lost, feature(id)))
          endangered.push_back(&feature(id));
    return endangered;
  }

  /// A feature that is to stay would lose all its surface with the lump.
  [[nodiscard]] bool loses_others(const Boundary& lump, const Boundary& rest,
                                  const Feature& f) const {
    const auto endangered = endangered_by(lump, f);
    if (endangered.empty()) return false;
    std::set<int> lost = polygons_of(lump);
    for_each_polygon(rest, [&](int polygon) { lost.erase(polygon); });
    return std::ranges::any_of(endangered,
                               [&](const Feature* other) { return has_all(lost, *other); });
  }

  /// A cavity that is to stay lies inside the lump.
  [[nodiscard]] bool holds_cavity(const Boundary& lump) const {
    return std::ranges::any_of(cavities_, [&](FeatureId id) {
      return !go_[id.index()] &&
             is_inside(lump, segmentation_.vertices[at(feature(id).vertices.front())].point);
    });
  }

  /// The features whose first polygon it is.
  [[nodiscard]] std::span<const FeatureId> starting_at(int polygon) const {
    if (polygon >= std::ssize(starting_at_)) return {};
    return starting_at_[at(polygon)];
  }

  static bool has_all(const std::set<int>& polygons, const Feature& f) {
    return std::ranges::all_of(f.source_polygons, [&](int p) { return polygons.contains(p); });
  }

  [[nodiscard]] static bool is_inside(const Boundary& body, Vec3 point) {
    double winding = 0;
    for (const detail::BodyFacetId facet : body.living_facets())
      winding += winding_part(body.outlines(facet), point);
    return winding > 0.5;
  }

  /// `outer` carries `inner`, directly or over others.
  [[nodiscard]] bool carries(const Feature& outer, const Feature& inner) const {
    return std::ranges::includes(outer.source_polygons, inner.source_polygons);
  }

  std::optional<std::string> fill_cavity(const Feature& f) {
    for (std::size_t b = 0; b < bodies_.size(); ++b) {
      if (!detail::fill_cavity(bodies_[b], f.box)) continue;
      return std::nullopt;
    }
    return "its shell is no longer found";
  }

  [[nodiscard]] Solid remaining_solid() const {
    std::set<int> gone;
    for (const FeatureId id : out_.removed)
      gone.insert(feature(id).source_polygons.begin(), feature(id).source_polygons.end());
    return solid_of(bodies_, solid_, gone);
  }

  const Solid& solid_;
  const Segmentation& segmentation_;
  const SegmentOptions& options_;
  Work* work_;
  detail::World world_;
  std::vector<Boundary> bodies_;
  std::vector<detail::RingCuts> rings_;          ///< by body
  std::vector<std::pair<int, FacetId>> facets_;  ///< of the solid, by their polygons
  std::optional<Boundary> trial_;
  bool is_spoilt_ = false;    ///< a part was cut off a body that should have stayed
  bool is_careful_ = false;   ///< facets are split on copies of bodies
  std::vector<char> wanted_;  ///< by feature: asked for and not refused
  std::vector<char> go_;      ///< by feature: wanted, or sits on what is
  std::vector<std::vector<FeatureId>> hosted_;       ///< by feature: what it is the host of
  std::vector<std::vector<FeatureId>> starting_at_;  ///< by their first polygon
  std::vector<FeatureId> cavities_;
  Remainder out_;
};

}  // namespace

std::vector<FeatureId> with_what_sits_on(const Segmentation& segmentation,
                                         const std::vector<FeatureId>& features) {
  std::vector<char> go(segmentation.features.size(), 0);
  for (const FeatureId id : features) go[id.index()] = 1;
  go = spread(std::move(go), segmentation);
  std::vector<FeatureId> all;
  for (int i = 0; i < std::ssize(go); ++i)
    if (go[at(i)] != 0) all.push_back(FeatureId{i});
  return all;
}

Remainder remove_features(const Solid& solid, const Segmentation& segmentation,
                          const std::vector<FeatureId>& features, const SegmentOptions& options,
                          Work* work) {
  return FeatureRemover(solid, segmentation, options, work).run(features);
}

}  // namespace oriel
