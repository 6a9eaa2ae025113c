#include "kernel/segment/removal/feature_cut.h"

#include "kernel/base/index.h"

#include <vector>

namespace oriel::detail {

namespace {

/// The first region of the kind that has the point inside, if any.
RegionId region_around(const Boundary& body, const Section& section, bool is_material, Vec3 point) {
  const Vec3 normal = body.world().planes.plane(section.plane).normal;
  for (const RegionId r : section.regions.ids()) {
    const Region& region = section.regions[r];
    if (region.is_material != is_material) continue;
    std::vector<Outline> shape;
    for (const SectionLoopId l : region.loops) shape.push_back(outline_of(section, l));
    if (contains(shape, normal, point)) return r;
  }
  return {};
}

/// One half-edge of each edge that has one end in front of the plane and one not.
std::vector<EdgeId> edges_across(const Boundary& body, int plane, int direction) {
  const auto ranks = body.world().points.ranks(body.world().planes.class_of(plane));
  const int limit = body.world().planes.rank_of(plane) * direction;
  std::vector<EdgeId> edges;
  for (const EdgeId e : body.half_edge_ids()) {
    const auto& half = body.edge(e);
    if (half.next.is_valid() && e < half.twin &&
        (ranks[half.origin] * direction > limit) !=
            (ranks[body.origin(half.twin)] * direction > limit))
      edges.push_back(e);
  }
  return edges;
}

}  // namespace

std::optional<FeatureCut> find_feature_cut(const Boundary& body, int plane, int direction,
                                           bool is_material, Vec3 point,
                                           const SectionOptions& options) {
  FeatureCut cut{{plane, direction}, {}};
  section_at(body, cut.section, edges_across(body, plane, direction), options);
  const auto region = region_around(body, cut.section, is_material, point);
  if (!region.is_valid()) return std::nullopt;
  cut.lump = LumpFinder(body, cut.section).find(region);
  if (cut.lump.is_finite && cut.lump.is_sound) cut.caps = bare_caps(body, cut.section, cut.lump);
  return cut;
}

}  // namespace oriel::detail
