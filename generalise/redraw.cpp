#include "generalise/generalise.h"
#include "generalise/removal/facets.h"
#include "kernel/base/indexed_vector.h"
#include "kernel/geometry/directions.h"
#include "kernel/geometry/outlines.h"
#include "kernel/geometry/planar.h"
#include "kernel/segment/flush/draw_imprints.h"
#include "model/vec3.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace oriel {

namespace {

/// Along the normal of a polygon, as long as its area without its holes.
Vec3 area_vector(const Building& building, const Polygon& polygon) {
  Vec3 doubled;
  for (const auto& ring : polygon.rings)
    add_doubled_area(doubled, ring.size(),
                     [&](std::size_t i) { return building.vertices[at(ring[i])]; });
  return 0.5 * doubled;
}

/// What a facet is that no input polygon lies in.
std::string type_by_slope(Vec3 normal) {
  if (looks_up(normal)) return "RoofSurface";
  return looks_down(normal) ? "OuterCeilingSurface" : "WallSurface";
}

/// What is drawn looks the way of a polygon within 45 degrees.
constexpr double kSameWay = 0.7071;

/// Planes of one face before and after: within 2.6 degrees.
constexpr double kSamePlane = 0.999;

class Redrawer {
 public:
  Redrawer(const RedrawContext& context, Generalised generalised)
      : context_(context),
        labelled_(context.labelled),
        generalised_(std::move(generalised)),
        reach_m_(context.options.tolerances.plane_offset_m + context.options.tolerances.weld_m) {
    for (const Polygon& polygon : context.building.polygons)
      area_[polygon.source] = area_vector(context.building, polygon);
    out_.labelled.building = labelled_.building;
    out_.labelled.attributes = labelled_.attributes;
  }

  Redrawn run() {
    for (const FeatureId id : generalised_.removed) gone_.insert(context_.table.id(id));
    label_facets();
    tie_openings();
    keep_installations(heirs());
    count_removed(generalised_.removed, context_.segmentation, context_.interpretation, out_);
    out_.labelled.geometry = std::move(generalised_.solid);
    return std::move(out_);
  }

 private:
  [[nodiscard]] const std::vector<Facet>& facets() const { return generalised_.solid.facets; }

  /// The largest input polygon of a facet that looks where the facet does, or of all; it says what
  /// the facet is. Or -1.
  [[nodiscard]] int main_polygon(const Facet& facet) const {
    const Vec3 normal = generalised_.solid.planes[facet.plane.index()].normal;
    const auto rank = [&](int polygon) {
      const Vec3 area = area_.at(polygon);
      return std::pair(dot(normal, area) > kSameWay * length(area), length(area));
    };
    int best = -1;
    for (const int polygon : facet.polygons)
      if (best < 0 || rank(polygon) > rank(best)) best = polygon;
    return best;
  }

  [[nodiscard]] int surface_of(const Facet& facet) const {
    const int polygon = main_polygon(facet);
    return polygon < 0 ? -1 : labelled_.surface_of_polygon[at(polygon)];
  }

  [[nodiscard]] std::string type_of_bare(const Facet& facet) const {
    const Plane& plane = generalised_.solid.planes[facet.plane.index()];
    const auto outlines = outlines_of(generalised_.solid.vertices, facet.loops);
    const auto inside = interior_point(outlines, plane.normal);
    const bool is_closing =
        facet.polygons.empty() && inside &&
        std::ranges::any_of(generalised_.closing, [&](const ClosingFace& face) {
          return dot(face.plane.normal, plane.normal) > kSamePlane &&
                 std::abs(dot(face.plane.normal, *inside) - face.plane.offset_m) <= reach_m_ &&
                 contains(face.outlines, face.plane.normal, *inside);
        });
    return is_closing ? "ClosureSurface" : type_by_slope(plane.normal);
  }

  /// A wall or roof no longer names a feature that was removed from it.
  void forget_gone(SemanticSurface& surface) const {
    if (!is_opening_type(surface.type) && gone_.contains(surface.label->id)) surface.label = {};
  }

  /// Surfaces are copied once; polygons of others that went into the same facet have that facet's
  /// surface now.
  void label_facets() {
    for (const Facet& facet : facets()) {
      const int old = surface_of(facet);
      int number = static_cast<int>(out_.labelled.surfaces.size());
      if (old < 0) {
        out_.labelled.surfaces.push_back({type_of_bare(facet), -1, {}});
      } else if (const auto [entry, is_new] = number_.emplace(old, number); is_new) {
        out_.labelled.surfaces.push_back(labelled_.surfaces[at(old)]);
        forget_gone(out_.labelled.surfaces.back());
      } else {
        number = entry->second;
      }
      out_.labelled.surface_of_polygon.push_back(number);
      for (const int polygon : facet.polygons)
        if (const int other = labelled_.surface_of_polygon[at(polygon)]; other >= 0)
          absorbed_.emplace(other, number);
    }
  }

  /// Parents are numbers of the labels as they were: those of the facets that their polygons went
  /// into take their place.
  void tie_openings() {
    for (SemanticSurface& surface : out_.labelled.surfaces) {
      if (surface.parent < 0) continue;
      const auto kept = number_.find(surface.parent);
      const auto absorbed = absorbed_.find(surface.parent);
      surface.parent = kept != number_.end()         ? kept->second
                       : absorbed != absorbed_.end() ? absorbed->second
                                                     : -1;
    }
  }

  /// Of facets in which no input polygon lies the ids of the features that they belong to now:
  /// where something is gone, its host, and what that is a piece of.
  [[nodiscard]] std::map<int, std::set<std::string>> heirs() const {
    std::vector<int> bare;
    for (int f = 0; f < std::ssize(facets()); ++f)
      if (facets()[at(f)].polygons.empty()) bare.push_back(f);
    std::map<int, std::set<std::string>> found;
    for (const FeatureId id : generalised_.removed) {
      const Feature& gone = context_.feature(id);
      if (!gone.host.is_valid() || bare.empty()) continue;
      const auto heir = std::ranges::find_if(bare, [&](int f) { return closes(f, gone); });
      if (heir == bare.end()) continue;
      for (FeatureId host = gone.host; host.is_valid(); host = context_.feature(host).parent)
        found[*heir].insert(context_.table.id(host));
    }
    return found;
  }

  /// The facet lies where the feature was cut off.
  [[nodiscard]] bool closes(int f, const Feature& gone) const {
    const Solid& solid = generalised_.solid;
    const Facet& facet = facets()[at(f)];
    const Plane& plane = solid.planes[facet.plane.index()];
    return !gone.planes.empty() &&
           std::abs(dot(plane.normal, gone.cap_point) - plane.offset_m) <= reach_m_ &&
           dot(plane.normal, context_.segmentation.planes[gone.planes[0].index()].normal) > 0.99 &&
           contains(outlines_of(solid.vertices, facet.loops), plane.normal, gone.cap_point);
  }

  void keep_installations(const std::map<int, std::set<std::string>>& heirs) {
    for (const Installation& installation : labelled_.installations) {
      if (gone_.contains(installation.id)) {
        out_.removed_ids.push_back(installation.id);
        continue;
      }
      Installation kept{installation.id, installation.label, {}, {}};
      const std::set<int> polygons(installation.polygons.begin(), installation.polygons.end());
      for (int f = 0; f < std::ssize(facets()); ++f) {
        const auto heir = heirs.find(f);
        const bool is_heir = heir != heirs.end() && heir->second.contains(installation.id);
        if (!is_heir && !polygons.contains(main_polygon(facets()[at(f)]))) continue;
        kept.polygons.push_back(f);
        kept.surfaces.push_back(out_.labelled.surface_of_polygon[at(f)]);
      }
      if (kept.polygons.empty())  // merged into its host
        out_.removed_ids.push_back(installation.id);
      else
        out_.labelled.installations.push_back(std::move(kept));
    }
  }

  const RedrawContext& context_;
  const LabelledBuilding& labelled_;
  Generalised generalised_;
  double reach_m_;
  std::set<std::string> gone_;   ///< ids of features
  std::map<int, Vec3> area_;     ///< of input polygons
  std::map<int, int> number_;    ///< new number of a surface that was kept
  std::map<int, int> absorbed_;  ///< new number of the facet that took a surface's polygon in
  Redrawn out_;
};

}  // namespace

std::vector<ClosingFace> closing_faces(const Solid& solid) {
  std::vector<ClosingFace> faces;
  for (const Facet& facet : solid.facets)
    if (facet.polygons.empty())
      faces.push_back(
          {solid.planes[facet.plane.index()], outlines_of(solid.vertices, facet.loops)});
  return faces;
}

void count_removed(const std::vector<FeatureId>& removed, const Segmentation& segmentation,
                   const Interpretation& interpretation, Redrawn& redrawn) {
  double volume_m3 = 0;
  for (const FeatureId id : removed) {
    ++redrawn.removed[interpretation.verdicts[id.index()].label];
    volume_m3 += segmentation.features[id.index()].volume_m3;
  }
  auto& attributes = redrawn.labelled.attributes;
  for (const auto& [label, count] : redrawn.removed)
    attributes.emplace_back("oriel_removed_" + (label.empty() ? "unknown" : label),
                            std::int64_t{count});
  if (!redrawn.removed.empty()) attributes.emplace_back("oriel_removed_volume_m3", volume_m3);
}

Redrawn redraw(const RedrawContext& context, Generalised generalised) {
  if (generalised.removed.empty() && generalised.changed.empty() && context.building.is_solid &&
      !generalised.is_drawn_anew)
    return {context.labelled, {}, {}};
  std::vector<FeatureId> imprints;
  for (const FeatureId i : ids_below<FeatureId>(context.segmentation.features.size()))
    if (context.feature(i).sense == Sense::imprint &&
        !std::ranges::binary_search(generalised.removed, i) &&
        !std::ranges::binary_search(generalised.changed, i) &&
        !std::ranges::binary_search(context.undrawn, i))
      imprints.push_back(i);
  generalised.solid = draw_imprints(std::move(generalised.solid), context.segmentation, imprints,
                                    context.options.tolerances);
  return Redrawer(context, std::move(generalised)).run();
}

}  // namespace oriel
