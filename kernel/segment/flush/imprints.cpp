#include "kernel/segment/flush/imprints.h"

#include "kernel/base/index.h"
#include "kernel/geometry/planar.h"
#include "kernel/segment/boundary/reach.h"
#include "kernel/segment/flush/insets.h"
#include "kernel/segment/flush/loose.h"
#include "kernel/segment/flush/subdivisions.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

namespace oriel {

namespace {

using detail::Inset;
using detail::Outline;
using detail::Reach;

/// A feature of the tree whose largest cap lies in the plane of a subdivision.
struct Resident {
  FeatureId id;
  Reach cap;  ///< of its points in that plane
};

class ImprintWriter {
 public:
  ImprintWriter(const Building& building, const Solid& solid, Segmentation& segmentation,
                const Tolerances& tolerances)
      : solid_(solid),
        out_(segmentation),
        tolerances_(tolerances),
        subdivisions_(detail::subdivisions_of(building, solid, tolerances)),
        insets_(find_insets(solid, subdivisions_, tolerances)),
        tree_features_(segmentation.features.size()) {}

  void run() {
    if (insets_.empty()) return;
    find_homes();
    for (std::size_t i = 0; i < insets_.size();) {
      std::size_t past = i;
      while (past < insets_.size() && insets_[past].subdivision == insets_[i].subdivision) ++past;
      write_subdivision(i, past);
      i = past;
    }
    take_in();
  }

 private:
  [[nodiscard]] Feature& feature(FeatureId id) { return out_.features[id.index()]; }
  [[nodiscard]] const Facet& facet_of(const Inset& inset) const {
    return solid_.facets[subdivisions_.subdivisions[at(inset.subdivision)].facet.index()];
  }

  /// Which cell facet has an input polygon, and which features lie in which plane.
  void find_homes() {
    for (int i = 0; i < std::ssize(out_.features); ++i)
      if (out_.features[at(i)].is_uncut)  // outer ones first
        for (const int source : out_.features[at(i)].source_polygons) ring_[source] = FeatureId{i};
    for (int c = 0; c < std::ssize(out_.cells); ++c) {
      const auto& facets = out_.cells[at(c)].facets;
      for (int f = 0; f < std::ssize(facets); ++f)
        for (const int polygon : facets[at(f)].polygons) home_[polygon] = {CellId{c}, f};
    }
    for (int i = 0; i < std::ssize(out_.features); ++i) {
      const Feature& f = out_.features[at(i)];
      if (f.planes.empty()) continue;
      const Plane& plane = out_.planes[f.planes.front().index()];
      std::vector<Vec3> cap;
      for (const Vec3 p : cap_points_of(f)) {
        if (std::abs(dot(plane.normal, p) - plane.offset_m) <= tolerances_.plane_offset_m)
          cap.push_back(p);
      }
      residents_[f.planes.front()].push_back(
          {FeatureId{i}, detail::axes_in(plane.normal).reach_of(cap)});
    }
    for (auto& [plane, residents] : residents_)
      std::ranges::stable_sort(residents, {}, [](const Resident& r) { return r.cap.u0; });
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
    const PlaneId plane = facet_of(insets_[first]).plane;
    const detail::ReachAxes axes = detail::axes_in(solid_.planes[plane.index()].normal);
    for (std::size_t i = first; i < past; ++i) {
      Inset& inset = insets_[i];
      const auto home = home_of(inset);
      if (!home) continue;
      if (!inset.whole.empty() && fills_whole(inset, plane, axes)) {
        inset.outline = std::move(inset.whole);
        inset.area_m2 = detail::signed_area(inset.outline, normal_of(plane));
      }
      if (inset.outline.empty()) continue;
      const Reach reach = axes.reach_of(inset.outline);
      const std::vector<FeatureId> within = residents_within(inset.outline, plane, reach);
      if (absorb(inset, within, reach, axes)) continue;
      const FeatureId id{static_cast<int>(out_.features.size())};
      out_.features.push_back(make(inset, *home, plane));
      for (const FeatureId resident : within)
        if (!carries(resident, id)) feature(resident).host = id;
      for (const int p : inset.polygons) owner_[p] = id;
    }
  }

  /// One feature stands on another, directly or over others.
  [[nodiscard]] bool carries(FeatureId carrier, FeatureId id) const {
    for (FeatureId host = id; host.is_valid(); host = out_.features[host.index()].host)
      if (host == carrier) return true;
    return false;
  }

  /// The cell facet that has the largest of the polygons.
  [[nodiscard]] std::optional<CellFacet> home_of(const Inset& inset) const {
    std::optional<CellFacet> home;
    double largest = -1;
    for (const int p : inset.polygons) {
      const detail::SubdivisionPolygon& polygon = subdivisions_.polygons[at(p)];
      const auto found = home_.find(polygon.source);
      if (found == home_.end() || polygon.area_m2 <= largest) continue;
      largest = polygon.area_m2;
      home = found->second;
    }
    return home;
  }

  /// The features of the tree whose largest cap lies within an outline.
  [[nodiscard]] std::vector<FeatureId> residents_within(const Outline& outline, PlaneId plane,
                                                        const Reach& reach) {
    std::vector<FeatureId> within;
    const auto found = residents_.find(plane);
    if (found == residents_.end()) return within;
    const double slack = slack_m();
    auto r = std::ranges::lower_bound(found->second, reach.u0 - slack, {},
                                      [](const Resident& resident) { return resident.cap.u0; });
    for (; r != found->second.end() && r->cap.u0 <= reach.u1; ++r) {
      if (!reach.holds(r->cap, slack)) continue;
      if (detail::contains({{outline}}, normal_of(plane), feature(r->id).cap_point))
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
  [[nodiscard]] bool fills_whole(const Inset& inset, PlaneId plane, const detail::ReachAxes& axes) {
    double filled_m2 = 0;
    for (const int p : inset.polygons) filled_m2 += subdivisions_.polygons[at(p)].area_m2;
    for (const FeatureId id : residents_within(inset.whole, plane, axes.reach_of(inset.whole))) {
      if (feature(id).sense != Sense::hole) return false;
      filled_m2 += feature(id).new_area_m2;
    }
    constexpr double kFilled = 0.98;  // noise, and what a cut leaves at the rim
    return filled_m2 >= kFilled * detail::signed_area(inset.whole, normal_of(plane));
  }

  /// How far the input's points and those that were snapped to planes may be apart.
  [[nodiscard]] double slack_m() const { return tolerances_.weld_m + tolerances_.plane_offset_m; }

  [[nodiscard]] Vec3 normal_of(PlaneId plane) const { return solid_.planes[plane.index()].normal; }

  /// True if the outline is that of a recess: then the recess has the polygons.
  bool absorb(const Inset& inset, const std::vector<FeatureId>& within, const Reach& reach,
              const detail::ReachAxes& axes) {
    for (const FeatureId id : within) {
      Feature& recess = feature(id);
      if (recess.sense != Sense::hole && !recess.is_uncut) continue;
      if (!axes.reach_of(cap_points_of(recess)).holds(reach, slack_m())) continue;
      for (const int p : inset.polygons) {
        recess.source_polygons.push_back(subdivisions_.polygons[at(p)].source);
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
  [[nodiscard]] std::optional<FeatureId> host_of(const Inset& inset) const {
    const auto imprint = owner_.find(inset.host);
    const auto ring = ring_.find(subdivisions_.polygons[at(inset.host)].source);
    if (imprint == owner_.end() && ring == ring_.end()) return std::nullopt;
    if (imprint == owner_.end()) return ring->second;
    if (ring == ring_.end()) return imprint->second;
    const auto area_m2 = [&](FeatureId id) { return out_.features[id.index()].new_area_m2; };
    return area_m2(ring->second) < area_m2(imprint->second) ? ring->second : imprint->second;
  }

  Feature make(const Inset& inset, CellFacet home, PlaneId plane) {
    Feature f;
    f.sense = Sense::imprint;
    f.parent = out_.cells[home.cell.index()].feature;
    f.host = host_of(inset).value_or(f.parent);
    f.host_facet = home;
    f.new_area_m2 = inset.area_m2;
    f.planes = {plane};
    f.cap_point =
        detail::interior_point({{inset.outline}}, normal_of(plane)).value_or(inset.outline[0]);
    f.is_natural = true;
    for (const int p : inset.polygons) {
      f.source_polygons.push_back(subdivisions_.polygons[at(p)].source);
      f.surface_m2 += subdivisions_.polygons[at(p)].area_m2;
    }
    for (const Vec3 p : inset.outline) {
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
  detail::Subdivisions subdivisions_;
  std::vector<Inset> insets_;
  std::size_t tree_features_;
  std::map<int, CellFacet> home_;  ///< by Polygon::source
  std::map<PlaneId, std::vector<Resident>> residents_;
  std::map<int, FeatureId> ring_;   ///< by Polygon::source: the smallest uncut feature
  std::map<int, FeatureId> owner_;  ///< of subdivision polygons: the smallest imprint so far
};

}  // namespace

void add_imprints(const Building& building, const Solid& solid, Segmentation& segmentation,
                  const Tolerances& tolerances) {
  ImprintWriter(building, solid, segmentation, tolerances).run();
  detail::join_loose_polygons(building, solid, segmentation, tolerances);
}

}  // namespace oriel
