#include "kernel/segment/flush/imprints.h"

#include "kernel/base/index.h"
#include "kernel/geometry/planar.h"
#include "kernel/segment/flush/contained_polygons.h"
#include "kernel/segment/flush/subdivisions.h"
#include "kernel/segment/flush/unassigned_polygons.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

namespace oriel {

namespace {

using detail::ContainedPolygons;

/// A feature of the tree whose largest cap lies in the plane of a subdivision.
struct CapInPlane {
  FeatureId id;
  Reach cap;  ///< of its points in that plane
};

class ImprintWriter {
 public:
  ImprintWriter(const Building& building, const Solid& solid, Segmentation& segmentation,
                const Tolerances& tolerances, Work& work)
      : solid_(solid),
        out_(segmentation),
        tolerances_(tolerances),
        work_(work),
        subdivisions_(detail::subdivisions_of(building, solid, tolerances, work)),
        contained_(find_contained(solid, subdivisions_, tolerances, work)),
        tree_features_(segmentation.features.size()) {}

  void run() {
    if (contained_.empty()) return;
    find_homes();
    for (std::size_t i = 0; i < contained_.size();) {
      std::size_t past = i;
      while (past < contained_.size() && contained_[past].subdivision == contained_[i].subdivision)
        ++past;
      if (!work_.is_used_up()) write_subdivision(i, past);
      i = past;
    }
    take_in();
  }

 private:
  [[nodiscard]] Feature& feature(FeatureId id) { return out_.features[id.index()]; }
  [[nodiscard]] const Facet& facet_of(const ContainedPolygons& contained) const {
    return solid_.facets[subdivisions_.subdivisions[contained.subdivision].facet.index()];
  }

  /// Which cell facet has an input polygon, and which features lie in which plane.
  void find_homes() {
    const auto features = ids_below<FeatureId>(out_.features.size());
    for (const FeatureId i : features)
      if (feature(i).is_uncut)  // outer ones first
        for (const int source : feature(i).source_polygons) ring_[source] = i;
    for (const CellId c : ids_below<CellId>(out_.cells.size())) {
      int number = 0;
      for (const Facet& facet : out_.cells[c.index()].facets) {
        for (const int polygon : facet.polygons) home_[polygon] = {c, number};
        ++number;
      }
    }
    for (const FeatureId i : features) {
      const Feature& f = feature(i);
      if (f.planes.empty()) continue;
      const Plane& plane = out_.planes[f.planes.front().index()];
      std::vector<Vec3> cap;
      for (const Vec3 p : cap_points_of(f)) {
        if (std::abs(dot(plane.normal, p) - plane.offset_m) <= tolerances_.plane_offset_m)
          cap.push_back(p);
      }
      caps_on_[f.planes.front()].push_back({i, axes_in(plane.normal).reach_of(cap)});
    }
    for (auto& [plane, caps] : caps_on_)
      std::ranges::stable_sort(caps, {}, [](const CapInPlane& r) { return r.cap.u0; });
  }

  /// What the cap of a feature is told by: of an uncut one its ring, as it holds what lies beside
  /// it.
  [[nodiscard]] std::vector<Vec3> cap_points_of(const Feature& f) const {
    std::vector<Vec3> points;
    for (const int v : f.is_uncut ? f.outline : f.vertices)
      points.push_back(out_.vertices[at(v)].point);
    return points;
  }

  /// The insets of one subdivision, the largest first.
  void write_subdivision(std::size_t first, std::size_t past) {
    const PlaneId plane = facet_of(contained_[first]).plane;
    const ReachAxes axes = axes_in(solid_.planes[plane.index()].normal);
    for (std::size_t i = first; i < past && !work_.is_used_up(); ++i) {
      ContainedPolygons& contained = contained_[i];
      const auto home = home_of(contained);
      if (!home) continue;
      if (!contained.whole.empty() && fills_whole(contained, plane, axes)) {
        contained.outline = std::move(contained.whole);
        contained.area_m2 = signed_area(contained.outline, normal_of(plane));
      }
      if (contained.outline.empty()) continue;
      const Reach reach = axes.reach_of(contained.outline);
      const std::vector<FeatureId> within = features_within(contained.outline, plane, reach);
      if (absorb(contained, within, reach, axes)) continue;
      const FeatureId id{static_cast<int>(out_.features.size())};
      out_.features.push_back(make(contained, *home, plane));
      for (const FeatureId found_id : within)
        if (!carries(found_id, id)) feature(found_id).host = id;
      for (const detail::InputPolygonId p : contained.polygons) owner_[p] = id;
    }
  }

  /// One feature stands on another, directly or over others.
  [[nodiscard]] bool carries(FeatureId carrier, FeatureId id) const {
    for (FeatureId host = id; host.is_valid(); host = out_.features[host.index()].host) {
      work_.add(1);
      if (host == carrier) return true;
    }
    return false;
  }

  /// The cell facet that has the largest of the polygons.
  [[nodiscard]] std::optional<CellFacet> home_of(const ContainedPolygons& contained) const {
    std::optional<CellFacet> home;
    double largest = -1;
    for (const detail::InputPolygonId p : contained.polygons) {
      const detail::SubdivisionPolygon& polygon = subdivisions_.polygons[p];
      const auto found = home_.find(polygon.source);
      if (found == home_.end() || polygon.area_m2 <= largest) continue;
      largest = polygon.area_m2;
      home = found->second;
    }
    return home;
  }

  /// The features of the tree whose largest cap lies within an outline.
  [[nodiscard]] std::vector<FeatureId> features_within(const Outline& outline, PlaneId plane,
                                                       const Reach& reach) {
    std::vector<FeatureId> within;
    const auto found = caps_on_.find(plane);
    if (found == caps_on_.end()) return within;
    const double slack = slack_m();
    auto r = std::ranges::lower_bound(found->second, reach.u0 - slack, {},
                                      [](const CapInPlane& found_id) { return found_id.cap.u0; });
    for (; r != found->second.end() && r->cap.u0 <= reach.u1; ++r) {
      work_.add(1);
      if (!reach.holds(r->cap, slack)) continue;
      work_.add(std::ssize(outline));
      if (contains({{outline}}, normal_of(plane), feature(r->id).cap_point))
        within.push_back(r->id);
    }
    std::ranges::sort(within);
    // What stands in or on one of them stays there.
    const std::vector<FeatureId> all = within;
    std::erase_if(within, [&](FeatureId id) {
      return std::ranges::binary_search(all, feature(id).parent) ||
             std::ranges::binary_search(all, feature(id).host);
    });
    return within;
  }

  /// Polygons and recesses together are what the host leaves free.
  [[nodiscard]] bool fills_whole(const ContainedPolygons& contained, PlaneId plane,
                                 const ReachAxes& axes) {
    double filled_m2 = 0;
    for (const detail::InputPolygonId p : contained.polygons)
      filled_m2 += subdivisions_.polygons[p].area_m2;
    for (const FeatureId id :
         features_within(contained.whole, plane, axes.reach_of(contained.whole))) {
      if (feature(id).sense != Sense::hole) return false;
      filled_m2 += feature(id).new_area_m2;
    }
    constexpr double kFilled = 0.98;  // noise, and what a cut leaves at the rim
    return filled_m2 >= kFilled * signed_area(contained.whole, normal_of(plane));
  }

  /// How far the input's points and those that were snapped to planes may be apart.
  [[nodiscard]] double slack_m() const { return tolerances_.weld_m + tolerances_.plane_offset_m; }

  [[nodiscard]] Vec3 normal_of(PlaneId plane) const { return solid_.planes[plane.index()].normal; }

  /// True if the outline is that of a recess: then the recess has the polygons.
  bool absorb(const ContainedPolygons& contained, const std::vector<FeatureId>& within,
              const Reach& reach, const ReachAxes& axes) {
    for (const FeatureId id : within) {
      Feature& recess = feature(id);
      if (recess.sense != Sense::hole && !recess.is_uncut) continue;
      if (!axes.reach_of(cap_points_of(recess)).holds(reach, slack_m())) continue;
      for (const detail::InputPolygonId p : contained.polygons) {
        recess.source_polygons.push_back(subdivisions_.polygons[p].source);
        owner_[p] = id;
      }
      tidy(recess.source_polygons);
      return true;
    }
    return false;
  }

  static void tidy(std::vector<int>& numbers) {
    std::ranges::sort(numbers);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  }

  /// The smaller of the imprint and the uncut feature that have the host polygon.
  [[nodiscard]] std::optional<FeatureId> host_of(const ContainedPolygons& contained) const {
    const auto imprint = owner_.find(contained.host);
    const auto ring = ring_.find(subdivisions_.polygons[contained.host].source);
    if (imprint == owner_.end() && ring == ring_.end()) return std::nullopt;
    if (imprint == owner_.end()) return ring->second;
    if (ring == ring_.end()) return imprint->second;
    const auto area_m2 = [&](FeatureId id) { return out_.features[id.index()].new_area_m2; };
    return area_m2(ring->second) < area_m2(imprint->second) ? ring->second : imprint->second;
  }

  Feature make(const ContainedPolygons& contained, CellFacet home, PlaneId plane) {
    Feature f;
    f.sense = Sense::imprint;
    f.parent = out_.cells[home.cell.index()].feature;
    f.host = host_of(contained).value_or(f.parent);
    f.host_facet = home;
    f.new_area_m2 = contained.area_m2;
    f.planes = {plane};
    f.cap_point =
        interior_point({{contained.outline}}, normal_of(plane)).value_or(contained.outline[0]);
    f.is_natural = true;
    for (const detail::InputPolygonId p : contained.polygons) {
      f.source_polygons.push_back(subdivisions_.polygons[p].source);
      f.surface_m2 += subdivisions_.polygons[p].area_m2;
    }
    for (const Vec3 p : contained.outline) {
      f.outline.push_back(static_cast<int>(out_.vertices.size()));
      out_.vertices.push_back({p, false});
      f.box.grow(p);
    }
    f.vertices = f.outline;
    return f;
  }

  /// Adds to every imprint what the features that it hosts have; inner imprints, which stand behind
  /// outer ones, first.
  void take_in() {
    std::vector<double> gained_m2(out_.features.size(), 0);
    const auto pass_on = [&](const Feature& inner, double surface_m2) {
      if (!is_imprint(inner.host)) return;
      Feature& outer = feature(inner.host);
      outer.surface_m2 += surface_m2;
      gained_m2[inner.host.index()] += surface_m2;
      outer.box.grow(inner.box);
      outer.vertices.insert(outer.vertices.end(), inner.vertices.begin(), inner.vertices.end());
      outer.source_polygons.insert(outer.source_polygons.end(), inner.source_polygons.begin(),
                                   inner.source_polygons.end());
    };
    for (std::size_t i = 0; i < tree_features_; ++i)
      pass_on(out_.features[i], out_.features[i].surface_m2);
    for (std::size_t i = out_.features.size(); i-- > tree_features_;) {
      Feature& imprint = out_.features[i];
      tidy(imprint.vertices);
      tidy(imprint.source_polygons);
      // Its own polygons are counted among those of the imprint around it.
      pass_on(imprint, gained_m2[i]);
    }
  }

  [[nodiscard]] bool is_imprint(FeatureId id) const {
    return id.is_valid() && id.index() >= tree_features_;
  }

  const Solid& solid_;
  Segmentation& out_;
  const Tolerances& tolerances_;
  Work& work_;
  detail::Subdivisions subdivisions_;
  std::vector<ContainedPolygons> contained_;
  std::size_t tree_features_;
  std::map<int, CellFacet> home_;  ///< by Polygon::source
  std::map<PlaneId, std::vector<CapInPlane>> caps_on_;
  std::map<int, FeatureId> ring_;  ///< by Polygon::source: the smallest uncut feature
  std::map<detail::InputPolygonId, FeatureId> owner_;  ///< the smallest imprint so far
};

}  // namespace

void add_imprints(const Building& building, const Solid& solid, Segmentation& segmentation,
                  const Tolerances& tolerances, std::int64_t budget) {
  Work work(budget);
  ImprintWriter(building, solid, segmentation, tolerances, work).run();
  detail::join_unassigned_polygons(building, solid, segmentation, tolerances, work);
  if (work.is_used_up())
    segmentation.issues.push_back(
        used_up(building.id, budget, "finding imprints",
                "openings that are flush with their wall may be missing"));
}

}  // namespace oriel
