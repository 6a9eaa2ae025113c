#include "kernel/solidify/cap_kinds.h"

#include "kernel/base/assert.h"
#include "kernel/solidify/crossings/faces.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

namespace oriel::detail {

namespace {

/// Walls and ground plates are drawn upright and level; surveyed points, and plates that follow the
/// terrain, put them off by less. Roofs that are flatter, or steeper, are held off by what lies
/// beneath them and by their rims.
constexpr double kLean_rad = 5 * std::numbers::pi / 180;

const Vec3 kUp{0, 0, 1};

bool is_upright(Vec3 normal) { return std::abs(normal.z) <= std::sin(kLean_rad); }
bool is_level(Vec3 normal) { return std::abs(normal.z) >= std::cos(kLean_rad); }

}  // namespace

CapKinds::CapKinds(const Soup& soup, std::span<const PolygonShape> shapes,
                   std::span<const AddedFace> faces, double reach, Work& work)
    : soup_(soup), shapes_(shapes), faces_(faces), reach_(reach), work_(work) {
  ORIEL_ASSERT(shapes.size() == soup.polygons.size());
}

CapKind CapKinds::kind_of(const CapRings& rings) const {
  const LevelSheet face = sheet_of(rings);
  if (length(face.normal) == 0) return CapKind::hole;
  if (is_upright(face.normal)) return CapKind::wall;
  const bool is_ground = is_level(face.normal) && is_risen_from(rings) && !has_beneath(face);
  return is_ground ? CapKind::ground : CapKind::hole;
}

/// Of all rings: those of holes run the other way round.
CapKinds::LevelSheet CapKinds::sheet_of(const CapRings& rings) const {
  LevelSheet sheet;
  Vec3 area;
  for (const auto& ring : rings) {
    area = area + area_vector(ring.size(), [&](std::size_t i) { return place(ring[i]); });
    Outline& outline = sheet.outlines.emplace_back();
    for (const int v : ring) {
      outline.push_back(place(v));
      sheet.box.grow(outline.back());
    }
  }
  if (length(area) == 0) return sheet;
  sheet.normal = normalised(area.z < 0 ? -area : area);  // whichever way round it runs
  const Outline& outer = sheet.outlines.front();
  for (const Vec3 point : outer)
    sheet.level += dot(sheet.normal, point) / static_cast<double>(outer.size());
  return sheet;
}

/// Polygons of the input rise from more than half of the rim.
bool CapKinds::is_risen_from(const CapRings& rings) const {
  std::set<PointPair> rim;
  for (const auto& ring : rings)
    for (std::size_t i = 0; i < ring.size(); ++i)
      rim.insert(std::minmax({ring[i], ring[(i + 1) % ring.size()]}));
  double all = 0, rising = 0;
  work_.add(soup_.corner_count());
  for (int p = 0; p < soup_.polygon_count(); ++p) {
    if (soup_.polygons[at(p)].source == kNoSource || !shapes_[at(p)].normal) continue;
    for (const int r : soup_.rings_of(p)) {
      const auto ring = soup_.ring(r);
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const int from = ring[i], to = ring[(i + 1) % ring.size()];
        if (!rim.contains(std::minmax({from, to}))) continue;
        const Vec3 edge = place(to) - place(from);
        const Vec3 inward = cross(shapes_[at(p)].unit, normalised(edge));
        all += length(edge);
        if (inward.z > std::sin(kLean_rad)) rising += length(edge);
      }
    }
  }
  return 2 * rising > all;
}

void CapKinds::collect_sheets() const {
  if (!sheets_.empty()) return;
  for (int p = 0; p < soup_.polygon_count(); ++p)
    if (!is_upright(shapes_[at(p)].unit)) keep_sheet(sheet_of(rings_of(soup_, p)));
  for (const AddedFace& face : faces_) keep_sheet(sheet_of(face.rings));
}

void CapKinds::keep_sheet(LevelSheet sheet) const {
  if (!is_upright(sheet.normal)) sheets_.push_back(std::move(sheet));
}

bool CapKinds::has_beneath(const LevelSheet& face) const {
  const auto middle = interior_point(face.outlines, face.normal);
  if (!middle) return true;  // so thin that it has none: it is no ground
  collect_sheets();
  work_.add(std::ssize(sheets_));
  return std::ranges::any_of(
      sheets_, [&](const LevelSheet& other) { return lies_beneath(other, face, *middle); });
}

bool CapKinds::lies_beneath(const LevelSheet& other, const LevelSheet& face, Vec3 middle) const {
  if (other.box.min.z >= face.box.max.z - reach_ || other.box.min.x >= face.box.max.x ||
      other.box.max.x <= face.box.min.x || other.box.min.y >= face.box.max.y ||
      other.box.max.y <= face.box.min.y)
    return false;
  if (other.height_at(middle) < middle.z - reach_ && contains(other.outlines, kUp, middle))
    return true;
  const auto own = interior_point(other.outlines, other.normal);
  return own && own->z < face.height_at(*own) - reach_ && contains(face.outlines, kUp, *own);
}

}  // namespace oriel::detail
