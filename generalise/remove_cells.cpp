#include "generalise/remove_cells.h"

#include "generalise/detail/stays.h"
#include "kernel/geometry/exact.h"
#include "kernel/geometry/planar.h"
#include "kernel/model/building.h"
#include "kernel/model/cell_complex.h"
#include "kernel/model/detail/index.h"
#include "kernel/segment/cell_complex.h"
#include "kernel/solidify/solidify.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <utility>

namespace oriel {

namespace {

/// Where vertices lie off their planes sheets of the complex do not meet: slits stay, as long as an
/// edge of the building and up to some centimetres wide.
constexpr double kSlit_m2 = 0.5;

/// Where a cut passes a vertex by a hair what stays is no solid, or none that is valid in a file,
/// until vertices are put together that lie this many times further apart than weld_m.
constexpr std::array kCoarser{1.0, 4.0, 10.0};

/// A footprint is the same if its area is to this share: half of what levels of detail allow.
constexpr double kFootprint = 0.0005;

using Ids = std::vector<FeatureId>;

std::vector<detail::Outline> outlines_of(const std::vector<Vertex>& vertices,
                                         const std::vector<Loop>& loops) {
  std::vector<detail::Outline> outlines;
  for (const Loop& loop : loops) {
    outlines.emplace_back();
    for (const int v : loop) outlines.back().push_back(vertices[at(v)].point);
  }
  return outlines;
}

int lumps_of(const Solid& solid) {
  int lumps = 0;
  for (const Shell& shell : solid.shells) lumps = std::max(lumps, shell.lump + 1);
  return lumps;
}

class CellRemover {
 public:
  CellRemover(const Solid& solid, const Segmentation& segmentation, const Remainder& remainder,
              const Judge& is_valid, double unseen_m, const SegmentOptions& options)
      : solid_(solid),
        segmentation_(segmentation),
        is_valid_(is_valid),
        unseen_m_(unseen_m),
        options_(options),
        complex_(cell_complex(segmentation, options.tolerances)),
        footprint_m2_(measures_of(remainder.solid).footprint_m2),
        facets_of_face_(complex_.faces().size()) {
    for (const FeatureId id : remainder.removed)
      if (!is_carried(id, remainder.removed)) gone_.push_back(id);
  }

  /// What is left of the solid if as many of these go as can, with those that are gone already or,
  /// if that made no valid solid, with as many of them as can.
  std::optional<Solid> run(Ids more, bool is_sound) {
    if (!is_sound) {
      more.insert(more.end(), gone_.begin(), gone_.end());
      std::ranges::sort(more);
      gone_.clear();
    }
    add(more);
    return std::move(best_);
  }
  /// Why a feature cannot go that was tried on its own; null if that is not known.
  [[nodiscard]] const Refusal* fault_of(FeatureId id) const {
    const auto found = faults_.find(id);
    return found == faults_.end() ? nullptr : &found->second;
  }
  [[nodiscard]] const Ids& gone() const { return gone_; }

 private:
  [[nodiscard]] const Feature& feature(FeatureId id) const {
    return segmentation_.features[id.index()];
  }
  [[nodiscard]] bool is_carried(FeatureId id, const Ids& by) const {
    const auto is_in = [&](FeatureId carrier) {
      return carrier.is_valid() && std::ranges::find(by, carrier) != by.end();
    };
    return is_in(feature(id).parent) || is_in(feature(id).host);
  }

  /// All of them if they can go together, else those of either half that can.
  void add(const Ids& more) {
    if (more.empty() || attempt(more) || more.size() == 1) return;
    const auto middle = more.begin() + std::ssize(more) / 2;
    add({more.begin(), middle});
    add({middle, more.end()});
  }

  /// Keeps what comes of it if it is a closed solid.
  bool attempt(const Ids& more) {
    Ids all = gone_;
    all.insert(all.end(), more.begin(), more.end());
    std::ranges::sort(all);
    auto made = without(all, more);
    if (!made) return false;
    gone_ = std::move(all);
    best_ = std::move(made);
    return true;
  }

  /// What becomes of each feature's cells: material, air, or (nothing) what they were.
  [[nodiscard]] std::vector<std::optional<bool>> fates_of(const Ids& all) const {
    std::vector<std::optional<bool>> fates(segmentation_.features.size());
    for (const FeatureId id : all) fates[id.index()] = feature(id).sense != Sense::protrusion;
    const Ids gone = with_what_sits_on(segmentation_, all);
    const auto fate_of = [&](FeatureId carrier) {
      return carrier.is_valid() ? fates[carrier.index()] : std::optional<bool>();
    };
    // Carriers come before or after what they carry: as often as there are features on each other.
    for (bool has_changed = true; has_changed;) {
      has_changed = false;
      for (const FeatureId id : gone) {
        const auto of_parent = fate_of(feature(id).parent);
        const auto fate = of_parent ? of_parent : fate_of(feature(id).host);
        if (!fate || fate == fates[id.index()]) continue;
        fates[id.index()] = fate;
        has_changed = true;
      }
    }
    return fates;
  }

  [[nodiscard]] std::vector<CellId> cells_without(const Ids& all) const {
    const auto fates = fates_of(all);
    std::vector<CellId> cells;
    for (int c = 0; c < std::ssize(segmentation_.cells); ++c) {
      const Cell& cell = segmentation_.cells[at(c)];
      const auto fate =
          cell.feature.is_valid() ? fates[cell.feature.index()] : std::optional<bool>();
      if (fate.value_or(cell.sign > 0)) cells.push_back({c});
    }
    return cells;
  }

  /// What the complex says of the building without some features.
  struct Draft {
    Building shell;  ///< polygon i is of face i
    std::vector<BoundaryFace> faces;
    double volume_m3 = 0;
    double area_m2 = 0;
  };

  [[nodiscard]] Draft draft_without(const Ids& all) const {
    Draft draft;
    std::map<int, int> numbers;  // vertices that no face uses may lie anywhere
    const auto number = [&](int v) {
      const auto [entry, is_new] = numbers.emplace(v, static_cast<int>(numbers.size()));
      if (is_new) draft.shell.vertices.push_back(complex_.vertices()[at(v)].point);
      return entry->second;
    };
    draft.faces = complex_.boundary(cells_without(all));
    for (const BoundaryFace& part : draft.faces) {
      const Face& face = complex_.face(part.face);
      Polygon polygon;
      polygon.rings.assign(face.loops.begin(), face.loops.end());
      for (auto& ring : polygon.rings) {
        if (part.is_reversed) std::ranges::reverse(ring);
        for (int& v : ring) v = number(v);
      }
      polygon.source = static_cast<int>(draft.shell.polygons.size());
      draft.shell.polygons.push_back(std::move(polygon));
      draft.volume_m3 += (part.is_reversed ? -1 : 1) * face.area_m2 *
                         segmentation_.planes[face.plane.index()].offset_m / 3;
      draft.area_m2 += face.area_m2;
    }
    return draft;
  }

  /// The solid without these features; nothing if it would not do. `last`: what is new of them.
  std::optional<Solid> without(const Ids& all, const Ids& last) {
    const Ids gone = with_what_sits_on(segmentation_, all);
    const Draft draft = draft_without(all);
    std::optional<Refusal> fault;
    for (const double coarser : kCoarser) {
      Tolerances tolerances = options_.tolerances;
      tolerances.weld_m *= coarser;
      auto made = solidify(draft.shell, tolerances, {Closing::planar, kSlit_m2});
      if (!made.value || !is_closed(*made.value) ||
          std::abs(volume_m3(*made.value) - draft.volume_m3) > tolerances.weld_m * draft.area_m2)
        continue;
      name_polygons(*made.value, draft.faces, gone);
      fault = fault_of(*made.value, gone, tolerances);
      if (!fault) return std::move(made.value);
    }
    if (fault && last.size() == 1) faults_.insert_or_assign(last[0], *fault);
    return std::nullopt;
  }

  /// Why a solid made of the complex does not do: it falls apart, filled holes reach out of the
  /// building's box, the footprint changes by more than what goes covers, more has changed than the
  /// features hold, it is not valid, or what stays has no surface.
  [[nodiscard]] std::optional<Refusal> fault_of(const Solid& made, const Ids& gone,
                                                const Tolerances& tolerances) const {
    if (lumps_of(made) > lumps_of(solid_))
      return Refusal{{}, "the building would fall apart", "G411"};
    // The planes are found anew, and a vertex may lie so far off its own.
    const double slack_m = tolerances.weld_m + tolerances.plane_offset_m + unseen_m_;
    if (reaches_out(box_of(solid_), box_of(made), slack_m))
      return Refusal{{}, "the building would reach further than it did", "G412"};
    const double footprint_m2 = measures_of(made).footprint_m2;
    double most_m3 = tolerances.weld_m * surface_m2(solid_);
    for (const FeatureId id : gone) most_m3 += feature(id).volume_m3;
    if (std::abs(footprint_m2 - footprint_m2_) >
            kFootprint * footprint_m2_ + ground_below_m2(gone) ||
        std::abs(volume_m3(made) - volume_m3(solid_)) > most_m3 || !is_valid_(made) ||
        detail::loses_what_stays(made, segmentation_, gone))
      return Refusal{{}, "what is left would be no valid solid"};
    return std::nullopt;
  }

  /// How much of the ground these features cover at most.
  [[nodiscard]] double ground_below_m2(const Ids& gone) const {
    const double ground_m = box_of(solid_).min.z + kGroundReach_m;
    double area_m2 = 0;
    for (const FeatureId id : gone) {
      const Vec3 size = feature(id).box.max - feature(id).box.min;
      if (feature(id).box.min.z <= ground_m) area_m2 += size.x * size.y;
    }
    return area_m2;
  }

  /// Facets of the solid made name faces of the complex; then the input polygons of the facets of
  /// the solid that these lie in, but for those of features that are gone.
  void name_polygons(Solid& made, const std::vector<BoundaryFace>& faces, const Ids& gone) {
    std::set<int> lost;
    for (const FeatureId id : gone)
      lost.insert(feature(id).source_polygons.begin(), feature(id).source_polygons.end());
    for (Facet& facet : made.facets) {
      std::set<int> polygons;
      for (const int i : facet.polygons)
        for (const int f : facets_around(faces[at(i)]))
          for (const int polygon : solid_.facets[at(f)].polygons)
            if (!lost.contains(polygon)) polygons.insert(polygon);
      facet.polygons.assign(polygons.begin(), polygons.end());
    }
  }

  /// The facet of the solid that the face lies in; none if it is new.
  const std::vector<int>& facets_around(BoundaryFace part) {
    auto& known = facets_of_face_[part.face.index()];
    if (known) return *known;
    known.emplace();
    const Face& face = complex_.face(part.face);
    const Plane& plane = segmentation_.planes[face.plane.index()];
    const auto shape = outlines_of(complex_.vertices(), face.loops);
    const auto point = detail::interior_point(shape, plane.normal);
    if (!point) return *known;
    for (int f = 0; f < std::ssize(solid_.facets); ++f) {
      const Plane& its = solid_.planes[solid_.facets[at(f)].plane.index()];
      if (!are_parallel(its, plane) ||
          std::abs(dot(its.normal, *point) - its.offset_m) > options_.tolerances.weld_m)
        continue;
      if (detail::contains(outlines_of(solid_.vertices, solid_.facets[at(f)].loops), its.normal,
                           *point))
        known->push_back(f);
    }
    return *known;
  }
  /// Exact: planes of the segmentation are those of the solid.
  static bool are_parallel(const Plane& p, const Plane& q) {
    return p.coefficients == q.coefficients || p.coefficients == exact::opposite(q).coefficients;
  }

  const Solid& solid_;
  const Segmentation& segmentation_;
  const Judge& is_valid_;
  double unseen_m_;
  const SegmentOptions& options_;
  CellComplex complex_;
  double footprint_m2_;
  /// By face of the complex, once asked for.
  std::vector<std::optional<std::vector<int>>> facets_of_face_;
  std::map<FeatureId, Refusal> faults_;
  Ids gone_;  ///< in order; without what goes along
  std::optional<Solid> best_;
};

}  // namespace

Remainder remove_cells(const Solid& solid, const Segmentation& segmentation, Remainder remainder,
                       const Judge& is_valid, double unseen_m, const SegmentOptions& options) {
  Ids refused;
  for (const Refusal& refusal : remainder.refused) {
    const Feature& feature = segmentation.features[refusal.feature.index()];
    if (feature.node.is_valid() && feature.sense != Sense::imprint)
      refused.push_back(refusal.feature);
  }
  if (refused.empty()) return remainder;  // judging takes longer than cutting: whoever writes does
  const bool is_sound = remainder.solid.facets.empty() || is_valid(remainder.solid);
  CellRemover remover(solid, segmentation, remainder, is_valid, unseen_m, options);
  auto made = remover.run(std::move(refused), is_sound);
  for (Refusal& refusal : remainder.refused)
    if (const Refusal* fault = remover.fault_of(refusal.feature); fault && fault->code != "G401")
      refusal = {refusal.feature, fault->reason, fault->code};
  if (!made) return remainder;
  remainder.solid = std::move(*made);
  const Ids asked = std::move(remainder.removed);
  remainder.removed = with_what_sits_on(segmentation, remover.gone());
  for (const FeatureId id : asked)
    if (!std::ranges::binary_search(remainder.removed, id))
      remainder.refused.push_back({id, "what is left would be no valid solid"});
  std::ranges::sort(remainder.refused, {}, &Refusal::feature);
  std::erase_if(remainder.refused, [&](const Refusal& refusal) {
    return std::ranges::binary_search(remainder.removed, refusal.feature);
  });
  return remainder;
}

}  // namespace oriel
