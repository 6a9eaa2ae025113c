#include "kernel/segment/cuts/kept_sections.h"

#include "kernel/base/index.h"
#include "kernel/segment/sections/edge_index.h"

#include <algorithm>
#include <array>

namespace oriel::detail {

namespace {

/// A point inside a region lies this near to its plane.
constexpr double kNearPlane_m = 1e-6;  // tolerance of doubles

std::vector<Box> boxes_of_regions(const Section& section) {
  std::vector<Box> of_loops(section.loops.size());
  for (const Crossing& c : section.crossings)
    if (c.loop >= 0) of_loops[at(c.loop)].grow(c.at);
  std::vector<Box> boxes;
  boxes.reserve(section.regions.size());
  for (const Region& region : section.regions)
    boxes.push_back(grown(of_loops[at(region.loops[0])], kNearPlane_m));
  return boxes;
}

bool holds(const Box& box, Vec3 p) {
  return box.min.x <= p.x && p.x <= box.max.x && box.min.y <= p.y && p.y <= box.max.y &&
         box.min.z <= p.z && p.z <= box.max.z;
}

}  // namespace

void KeptSections::make(const Boundary& body, KeptSection& kept) const {
  Section& section = kept.section;
  EdgeIndex edges(body, std::array{section.plane});
  section_at(body, section, edges.edges_at(0, section.direction), options_);
  kept.boxes = boxes_of_regions(section);
}

std::optional<FoundCut> KeptSections::find(const Boundary& body, int plane, int direction,
                                           bool is_material, Vec3 point) {
  const auto [entry, is_new] = sections_.try_emplace({plane, direction});
  KeptSection& kept = entry->second;
  if (is_new) {
    kept.section.plane = plane;
    kept.section.direction = direction;
    make(body, kept);
  }
  return cut_in(body, kept, is_material, point);
}

std::optional<FoundCut> KeptSections::cut_in(const Boundary& body, const KeptSection& kept,
                                             bool is_material, Vec3 point) const {
  const Section& section = kept.section;
  const auto region = region_around(body, kept, is_material, point);
  if (!region) return std::nullopt;
  FoundCut cut{&section, LumpFinder(body, section).find(*region)};
  if (!cut.lump.is_finite || !cut.lump.is_sound) return cut;
  cut.caps = bare_caps(body, section, cut.lump);
  return cut;
}

/// The first that has the point inside.
std::optional<int> KeptSections::region_around(const Boundary& body, const KeptSection& kept,
                                               bool is_material, Vec3 point) const {
  const Section& section = kept.section;
  const Vec3 normal = body.world().planes.plane(section.plane).normal;
  for (int r = 0; r < std::ssize(section.regions); ++r) {
    const Region& region = section.regions[at(r)];
    if (region.is_material != is_material || !holds(kept.boxes[at(r)], point)) continue;
    std::vector<Outline> shape;
    for (const int l : region.loops) shape.push_back(outline_of(section, l));
    if (contains(shape, normal, point)) return r;
  }
  return std::nullopt;
}

}  // namespace oriel::detail
