#include "tests/fuzz/support/mutations.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oriel::fuzz {

namespace {

/// Beyond that nothing is added: bodies stay small enough for a second.
constexpr std::size_t kMostMutatedPolygons = 160;

/// From tenths of the grid of solids to metres: where tolerances begin and end.
double distance_m(ByteSource& bytes) {
  constexpr double kUnits[] = {1e-3, 1e-3, 5e-4, 2e-3, 1e-2, 0.1, 0.25, 1};
  const double unit_m = kUnits[bytes.below(std::size(kUnits))];
  return unit_m * bytes.step() / 16;
}

std::vector<int>& any_ring(Building& building, ByteSource& bytes) {
  Polygon& polygon = building.polygons[bytes.below(building.polygons.size())];
  return polygon.rings[bytes.below(polygon.rings.size())];
}

Vec3& any_corner(Building& building, ByteSource& bytes) {
  const std::vector<int>& ring = any_ring(building, bytes);
  return building.vertices[static_cast<std::size_t>(ring[bytes.below(ring.size())])];
}

int add_vertex(Building& building, Vec3 p) {
  building.vertices.push_back(p);
  return static_cast<int>(building.vertices.size()) - 1;
}

Vec3 point(const Building& building, int v) {
  return building.vertices[static_cast<std::size_t>(v)];
}

Vec3 normal_of(const Building& building, const std::vector<int>& ring) {
  Vec3 sum;
  for (std::size_t i = 0; i < ring.size(); ++i)
    sum = sum + cross(point(building, ring[i]), point(building, ring[(i + 1) % ring.size()]));
  const double size = length(sum);
  return size > 0 ? (1 / size) * sum : Vec3{0, 0, 1};
}

void move_corner(Building& building, ByteSource& bytes) {
  Vec3& p = any_corner(building, bytes);
  const double x = distance_m(bytes), y = distance_m(bytes), z = distance_m(bytes);
  p = p + Vec3{x, y, z};
}

/// Out of the plane of one of its polygons: two planes where there was one, or nearly so.
void fold(Building& building, ByteSource& bytes) {
  const std::vector<int> ring = any_ring(building, bytes);
  Vec3& p = building.vertices[static_cast<std::size_t>(ring[bytes.below(ring.size())])];
  p = p + distance_m(bytes) * normal_of(building, ring);
}

void move_all_of_a_polygon(Building& building, ByteSource& bytes) {
  const std::vector<int> ring = any_ring(building, bytes);
  const Vec3 by = distance_m(bytes) * normal_of(building, ring);
  for (const int v : ring) building.vertices[static_cast<std::size_t>(v)] = point(building, v) + by;
}

void merge_corners(Building& building, ByteSource& bytes) {
  const Vec3 target = any_corner(building, bytes);
  any_corner(building, bytes) = target;
}

void drop_polygon(Building& building, ByteSource& bytes) {
  if (building.polygons.size() > 1)
    building.polygons.erase(building.polygons.begin() +
                            static_cast<std::ptrdiff_t>(bytes.below(building.polygons.size())));
}

void turn_polygon(Building& building, ByteSource& bytes) {
  for (std::vector<int>& ring : building.polygons[bytes.below(building.polygons.size())].rings)
    std::ranges::reverse(ring);
}

void double_polygon(Building& building, ByteSource& bytes) {
  Polygon copy = building.polygons[bytes.below(building.polygons.size())];
  if (bytes.flag())
    for (std::vector<int>& ring : copy.rings) std::ranges::reverse(ring);
  building.polygons.push_back(std::move(copy));
}

/// Along a diagonal; the parts may overlap where the ring is not convex.
void cut_polygon(Building& building, ByteSource& bytes) {
  Polygon& polygon = building.polygons[bytes.below(building.polygons.size())];
  const std::vector<int> ring = polygon.rings[0];
  if (ring.size() < 4 || polygon.rings.size() > 1) return;
  const std::size_t first = bytes.below(ring.size() - 2);
  const std::size_t most = ring.size() - first - (first == 0 ? 3 : 2);
  const std::size_t last = first + 2 + (most > 0 ? bytes.below(most) : 0);
  Polygon part = polygon;
  const auto at = [&](std::size_t i) { return ring.begin() + static_cast<std::ptrdiff_t>(i); };
  part.rings[0].assign(at(first), at(last + 1));
  polygon.rings[0].erase(polygon.rings[0].begin() + static_cast<std::ptrdiff_t>(first) + 1,
                         polygon.rings[0].begin() + static_cast<std::ptrdiff_t>(last));
  building.polygons.push_back(std::move(part));
}

/// In an edge of one polygon, on it or a little beside.
void add_t_vertex(Building& building, ByteSource& bytes) {
  Polygon& polygon = building.polygons[bytes.below(building.polygons.size())];
  std::vector<int>& ring = polygon.rings[bytes.below(polygon.rings.size())];
  const std::size_t i = bytes.below(ring.size());
  const Vec3 p = point(building, ring[i]), q = point(building, ring[(i + 1) % ring.size()]);
  const double share = bytes.below(33) / 32.0, beside_m = bytes.flag() ? distance_m(bytes) : 0;
  const Vec3 on = p + share * (q - p) + Vec3{0, 0, beside_m};
  ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(i) + 1, add_vertex(building, on));
}

void add_noise(Building& building, ByteSource& bytes) {
  const double size_m = 1e-3 * (1 + bytes.below(12));
  for (Vec3& p : building.vertices) {
    const double x = bytes.step() / 128.0, y = bytes.step() / 128.0, z = bytes.step() / 128.0;
    p = p + size_m * Vec3{x, y, z};
    if (bytes.is_empty()) return;
  }
}

/// All of it once more, moved, smaller, or inside out.
void add_body(Building& building, ByteSource& bytes) {
  if (building.polygons.size() > kMostMutatedPolygons / 2) return;
  const int first = static_cast<int>(building.vertices.size());
  const double scale = bytes.flag() ? 0.5 : 1;
  const bool is_turned = bytes.flag(), is_other_body = bytes.flag(), is_shell = bytes.flag();
  const double x = distance_m(bytes), y = distance_m(bytes), z = distance_m(bytes);
  const std::vector<Vec3> vertices = building.vertices;
  for (const Vec3 p : vertices) building.vertices.push_back(scale * p + Vec3{x, y, z});
  const std::vector<Polygon> polygons = building.polygons;
  for (Polygon copy : polygons) {
    for (std::vector<int>& ring : copy.rings) {
      for (int& v : ring) v += first;
      if (is_turned) std::ranges::reverse(ring);
    }
    if (is_other_body)
      ++copy.body;
    else if (is_shell)
      ++copy.shell;
    building.polygons.push_back(std::move(copy));
  }
}

/// A small copy of the outer ring, about its middle.
void add_inner_ring(Building& building, ByteSource& bytes) {
  Polygon& polygon = building.polygons[bytes.below(building.polygons.size())];
  const std::vector<int> outer = polygon.rings[0];
  Vec3 middle;
  for (const int v : outer)
    middle = middle + (1.0 / static_cast<double>(outer.size())) * point(building, v);
  const double share = (1 + bytes.below(18)) / 16.0, aside_m = distance_m(bytes);
  std::vector<int> ring;
  for (const int v : outer)
    ring.push_back(
        add_vertex(building, middle + share * (point(building, v) - middle) + Vec3{aside_m, 0, 0}));
  if (!bytes.flag()) std::ranges::reverse(ring);
  polygon.rings.push_back(std::move(ring));
}

void cross_ring(Building& building, ByteSource& bytes) {
  std::vector<int>& ring = any_ring(building, bytes);
  std::swap(ring[bytes.below(ring.size())], ring[bytes.below(ring.size())]);
}

void repeat_corner(Building& building, ByteSource& bytes) {
  std::vector<int>& ring = any_ring(building, bytes);
  const int v = ring[bytes.below(ring.size())];
  ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(bytes.below(ring.size())), v);
}

void flatten(Building& building, ByteSource& bytes) {
  const int axis = bytes.below(3);
  const double factor = bytes.flag() ? 1.0 / 1024 : 0.125;
  for (Vec3& p : building.vertices) (axis == 0 ? p.x : axis == 1 ? p.y : p.z) *= factor;
}

void say_surfaces(Building& building, ByteSource& bytes) { building.is_solid = bytes.flag(); }

/// Takes all out of a ring, of a polygon, of a shell or of a solid; one polygon stays.
void empty_list(Building& building, ByteSource& bytes) {
  Polygon& polygon = building.polygons[bytes.below(building.polygons.size())];
  const int body = polygon.body, shell = polygon.shell, what = bytes.below(4);
  const auto is_emptied = [&](const Polygon& other) {
    return other.body == body && (what == 3 || other.shell == shell);
  };
  if (what == 0)
    polygon.rings[bytes.below(polygon.rings.size())].clear();
  else if (what == 1)
    polygon.rings = {{}};
  else if (!std::ranges::all_of(building.polygons, is_emptied))
    std::erase_if(building.polygons, is_emptied);
}

bool has_empty_ring(const Building& building) {
  return std::ranges::any_of(building.polygons, [](const Polygon& polygon) {
    return std::ranges::any_of(polygon.rings, &std::vector<int>::empty);
  });
}

/// Bytes from here on empty a list: further ones are as they were before that was a change.
constexpr int kEmpties = 240;

}  // namespace

void mutate(Building& building, ByteSource& bytes) {
  const int choice = bytes.byte();
  // The others need corners.
  if (choice >= kEmpties || has_empty_ring(building)) return empty_list(building, bytes);
  void (*const ways[])(Building&, ByteSource&) = {
      move_corner,    fold,          move_all_of_a_polygon,
      merge_corners,  drop_polygon,  turn_polygon,
      double_polygon, cut_polygon,   add_t_vertex,
      add_noise,      add_body,      add_inner_ring,
      cross_ring,     repeat_corner, flatten,
      say_surfaces};
  ways[static_cast<std::size_t>(choice) % std::size(ways)](building, bytes);
}

}  // namespace oriel::fuzz
