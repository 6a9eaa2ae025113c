#include "kernel/segment/cuts/kept_sections.h"

#include "kernel/base/index.h"
#include "kernel/segment/sections/edge_index.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>

namespace oriel::detail {

namespace {

/// A point inside a region lies this near to its plane.
constexpr double kNearPlane_m = 1e-6;  // tolerance of doubles

/// True if the region's outlines are those of the body still.
bool is_alive(const Boundary& body, const Section& section, const Region& region) {
  return std::ranges::all_of(region.loops, [&](int l) {
    const int first = section.loops[at(l)].first;
    int c = first;
    do {
      if (!body.is_alive_edge(section.crossings[at(c)].edge)) return false;
      c = section.crossings[at(c)].next;
    } while (c != first);
    return true;
  });
}

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

/// Ranks in a normal class, from the lowest to the highest.
struct RanksBetween {
  int low = std::numeric_limits<int>::max(), high = std::numeric_limits<int>::min();
  void grow(int rank) {
    low = std::min(low, rank);
    high = std::max(high, rank);
  }
};

/// What a change leaves of a section at a plane.
enum class Leaves { all, loops, nothing };

Leaves left_of(const Boundary& body, int plane, int direction, std::span<const PointId> touched,
               std::span<const CutCap> bare) {
  World& world = body.world();
  const auto ranks = world.points.ranks(world.planes.class_of(plane));
  const int rank = world.planes.rank_of(plane);
  RanksBetween all, rim;
  for (const PointId p : touched) all.grow(ranks[p]);
  if (all.high < rank || rank < all.low) return Leaves::all;
  for (const CutCap& cap : bare)
    for (const CapLoop& loop : cap.loops)
      for (const CapEdge& edge : loop.edges) rim.grow(ranks[edge.from]);
  // The part of a cut along edges whose rim is on one side was met in whole loops or not at all.
  const auto is_beyond = [&](int other) { return (other - rank) * direction > 0; };
  const bool has_rim = rim.low <= rim.high;
  return has_rim && is_beyond(rim.low) == is_beyond(rim.high) ? Leaves::loops : Leaves::nothing;
}

}  // namespace

void KeptSections::make(const Boundary& body, KeptSection& kept) const {
  Section& section = kept.section;
  EdgeIndex edges(body, std::array{section.plane});
  section_at(body, section, edges.edges_at(0, section.direction), options_);
  kept.boxes = boxes_of_regions(section);
  kept.is_fresh = true;
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
  auto cut = cut_in(body, kept, is_material, point);
  if (kept.is_fresh || (cut && cut->caps)) return cut;
  make(body, kept);
  return cut_in(body, kept, is_material, point);
}

std::optional<FoundCut> KeptSections::cut_in(const Boundary& body, const KeptSection& kept,
                                             bool is_material, Vec3 point) const {
  const Section& section = kept.section;
  const auto region = region_around(body, kept, is_material, point);
  if (!region || !is_alive(body, section, section.regions[at(*region)])) return std::nullopt;
  FoundCut cut{&section, LumpFinder(body, section).find(*region)};
  if (!cut.lump.is_finite || !cut.lump.is_sound) return cut;
  const bool is_whole = std::ranges::all_of(
      cut.lump.regions, [&](int r) { return is_alive(body, section, section.regions[at(r)]); });
  if (is_whole) cut.caps = bare_caps(body, section, cut.lump);
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

void KeptSections::take_note(const Boundary& body, std::span<const PointId> touched,
                             std::span<const CutCap> bare) {
  for (auto entry = sections_.begin(); entry != sections_.end();) {
    auto& [place, kept] = *entry;
    const Leaves leaves = left_of(body, place.first, place.second, touched, bare);
    if (leaves != Leaves::all) kept.is_fresh = false;
    entry = leaves == Leaves::nothing ? sections_.erase(entry) : std::next(entry);
  }
}

}  // namespace oriel::detail
