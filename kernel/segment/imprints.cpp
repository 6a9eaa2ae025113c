#include "kernel/segment/imprints.h"

#include "kernel/geometry/planar.h"
#include "kernel/segment/detail/insets.h"
#include "kernel/segment/detail/sheets.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <vector>

namespace oriel {

namespace {

using detail::Inset;
using detail::Outline;

std::size_t at(int i) { return static_cast<std::size_t>(i); }

/// How far points reach along two directions in a plane.
struct Reach {
  double u0 = Box::kInfinity, u1 = -Box::kInfinity, v0 = Box::kInfinity, v1 = -Box::kInfinity;

  [[nodiscard]] bool holds(const Reach& r, double slack) const {
    return r.u0 >= u0 - slack && r.u1 <= u1 + slack && r.v0 >= v0 - slack && r.v1 <= v1 + slack;
  }
};

struct Axes {
  Vec3 u, v;

  [[nodiscard]] Reach of(const std::vector<Vec3>& points) const {
    Reach reach;
    for (const Vec3 p : points) {
      reach.u0 = std::min(reach.u0, dot(p, u));
      reach.u1 = std::max(reach.u1, dot(p, u));
      reach.v0 = std::min(reach.v0, dot(p, v));
      reach.v1 = std::max(reach.v1, dot(p, v));
    }
    return reach;
  }
};

Axes axes_in(Vec3 normal) {
  const Vec3 any = std::abs(normal.z) < 0.9 ? Vec3{0, 0, 1} : Vec3{1, 0, 0};
  const Vec3 u = normalised(cross(any, normal));
  return {u, cross(normal, u)};
}

/// A feature of the tree whose largest cap lies in the plane of a sheet.
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
        sheets_(detail::sheets_of(building, solid, tolerances)),
        insets_(find_insets(solid, sheets_, tolerances)),
        tree_features_(segmentation.features.size()) {}

  void run() {
    if (insets_.empty()) return;
    find_homes();
    for (std::size_t i = 0; i < insets_.size();) {
      std::size_t past = i;
      while (past < insets_.size() && insets_[past].sheet == insets_[i].sheet) ++past;
      write_sheet(i, past);
      i = past;
    }
    take_in();
  }

 private:
  [[nodiscard]] Feature& feature(FeatureId id) { return out_.features[id.index()]; }
  [[nodiscard]] const Facet& facet_of(const Inset& inset) const {
    return solid_.facets[sheets_.sheets[at(inset.sheet)].facet.index()];
  }

  /// Which cell facet has an input polygon, and which features lie in which plane.
  void find_homes() {
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
      for (const int v : f.vertices) {
        const Vec3 p = out_.vertices[at(v)].point;
        if (std::abs(dot(plane.normal, p) - plane.offset_m) <= tolerances_.plane_offset_m)
          cap.push_back(p);
      }
      residents_[f.planes.front()].push_back({FeatureId{i}, axes_in(plane.normal).of(cap)});
    }
    for (auto& [plane, residents] : residents_)
      std::ranges::stable_sort(residents, {}, [](const Resident& r) { return r.cap.u0; });
  }

  /// The insets of one sheet, the largest first.
  void write_sheet(std::size_t first, std::size_t past) {
    const PlaneId plane = facet_of(insets_[first]).plane;
    const Axes axes = axes_in(solid_.planes[plane.index()].normal);
    for (std::size_t i = first; i < past; ++i) {
      Inset& inset = insets_[i];
      const auto home = home_of(inset);
      if (!home) continue;
      if (!inset.whole.empty() && fills_whole(inset, *home, plane, axes)) {
        inset.outline = std::move(inset.whole);
        inset.area_m2 = detail::signed_area(inset.outline, normal_of(plane));
      }
      if (inset.outline.empty()) continue;
      const Reach reach = axes.of(inset.outline);
      const std::vector<FeatureId> within = residents_within(inset.outline, *home, plane, reach);
      if (absorb(inset, within, reach, axes)) continue;
      const FeatureId id{static_cast<int>(out_.features.size())};
      out_.features.push_back(make(inset, *home, plane));
      for (const FeatureId resident : within) feature(resident).host = id;
      for (const int p : inset.polygons) owner_[p] = id;
    }
  }

  /// The cell facet that has the largest of the polygons.
  [[nodiscard]] std::optional<CellFacet> home_of(const Inset& inset) const {
    std::optional<CellFacet> home;
    double largest = -1;
    for (const int p : inset.polygons) {
      const detail::SheetPolygon& polygon = sheets_.polygons[at(p)];
      const auto found = home_.find(polygon.source);
      if (found == home_.end() || polygon.area_m2 <= largest) continue;
      largest = polygon.area_m2;
      home = found->second;
    }
    return home;
  }

  /// The features of the tree that lie within an inset and stand where it stands.
  [[nodiscard]] std::vector<FeatureId> residents_within(const Outline& outline, CellFacet home,
                                                        PlaneId plane, const Reach& reach) {
    std::vector<FeatureId> within;
    const auto found = residents_.find(plane);
    if (found == residents_.end()) return within;
    const FeatureId body = out_.cells[home.cell.index()].feature;
    const double slack = tolerances_.weld_m;
    auto r = std::ranges::lower_bound(found->second, reach.u0 - slack, {},
                                      [](const Resident& resident) { return resident.cap.u0; });
    for (; r != found->second.end() && r->cap.u0 <= reach.u1; ++r) {
      if (!reach.holds(r->cap, slack)) continue;
      const Feature& f = feature(r->id);
      const FeatureId base = is_imprint(f.host) ? feature(f.host).parent : f.host;
      if (base == body && detail::contains({{outline}}, normal_of(plane), f.cap_point))
        within.push_back(r->id);
    }
    std::ranges::sort(within);
    return within;
  }

  /// Polygons and recesses together are what the host leaves free.
  [[nodiscard]] bool fills_whole(const Inset& inset, CellFacet home, PlaneId plane,
                                 const Axes& axes) {
    double filled_m2 = 0;
    for (const int p : inset.polygons) filled_m2 += sheets_.polygons[at(p)].area_m2;
    for (const FeatureId id : residents_within(inset.whole, home, plane, axes.of(inset.whole))) {
      if (feature(id).sense != Sense::hole) return false;
      filled_m2 += feature(id).new_area_m2;
    }
    constexpr double kFilled = 0.98;  // noise, and what a cut leaves at the rim
    return filled_m2 >= kFilled * detail::signed_area(inset.whole, normal_of(plane));
  }

  [[nodiscard]] Vec3 normal_of(PlaneId plane) const { return solid_.planes[plane.index()].normal; }

  /// True if the outline is that of a recess: then the recess has the polygons.
  bool absorb(const Inset& inset, const std::vector<FeatureId>& within, const Reach& reach,
              const Axes& axes) {
    for (const FeatureId id : within) {
      Feature& recess = feature(id);
      if (recess.sense != Sense::hole) continue;
      std::vector<Vec3> points;
      for (const int v : recess.vertices) points.push_back(out_.vertices[at(v)].point);
      if (!axes.of(points).holds(reach, tolerances_.weld_m)) continue;
      for (const int p : inset.polygons)
        recess.source_polygons.push_back(sheets_.polygons[at(p)].source);
      tidy(recess.source_polygons);
      return true;
    }
    return false;
  }

  static void tidy(std::vector<int>& numbers) {
    std::ranges::sort(numbers);
    numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
  }

  Feature make(const Inset& inset, CellFacet home, PlaneId plane) {
    Feature f;
    f.sense = Sense::imprint;
    f.parent = out_.cells[home.cell.index()].feature;
    const auto owner = owner_.find(inset.host);
    f.host = owner != owner_.end() ? owner->second : f.parent;
    f.host_facet = home;
    f.new_area_m2 = inset.area_m2;
    f.planes = {plane};
    f.cap_point =
        detail::interior_point({{inset.outline}}, normal_of(plane)).value_or(inset.outline[0]);
    f.is_natural = true;
    for (const int p : inset.polygons) {
      f.source_polygons.push_back(sheets_.polygons[at(p)].source);
      f.surface_m2 += sheets_.polygons[at(p)].area_m2;
    }
    for (const Vec3 p : inset.outline) {
      f.vertices.push_back(static_cast<int>(out_.vertices.size()));
      out_.vertices.push_back({p, false});
      f.box.grow(p);
    }
    return f;
  }

  /// Adds to every imprint what the features that it hosts have; inner imprints, which stand behind
  /// outer ones, first.
  void take_in() {
    std::vector<double> gained_m2(out_.features.size(), 0);
    const auto pass_on = [&](const Feature& inner, double surface_m2) {
      if (!is_imprint(inner.host)) return;
      Feature& outer = feature(inner.host);
      outer.volume_m3 += inner.volume_m3;
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
  detail::Sheets sheets_;
  std::vector<Inset> insets_;
  std::size_t tree_features_;
  std::map<int, CellFacet> home_;  ///< by Polygon::source
  std::map<PlaneId, std::vector<Resident>> residents_;
  std::map<int, FeatureId> owner_;  ///< of sheet polygons: the smallest imprint so far
};

}  // namespace

void add_imprints(const Building& building, const Solid& solid, Segmentation& segmentation,
                  const Tolerances& tolerances) {
  ImprintWriter(building, solid, segmentation, tolerances).run();
}

}  // namespace oriel
