#include "io/gpkg/gpkg_geometry.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <set>

namespace oriel::detail {

namespace {

/// Where the number of the reference system stands: behind "GP", version and flags.
constexpr std::size_t kReferencePlace = 4;
/// Little-endian, with a box of x, y and z.
constexpr char kFlags = 0b0000'0101;
constexpr std::uint32_t kPolygonZ = 1003, kMultiPolygonZ = 1006;

template <class Number>
std::array<char, sizeof(Number)> little_endian(Number number) {
  static_assert(std::endian::native == std::endian::little);
  return std::bit_cast<std::array<char, sizeof(Number)>>(number);
}

template <class Number>
void append_binary(std::string& out, Number number) {
  const auto bytes = little_endian(number);
  out.append(bytes.data(), bytes.size());
}

void append_wkb_head(std::string& out, std::uint32_t type, std::size_t parts) {
  out += '\1';
  append_binary(out, type);
  append_binary(out, static_cast<std::uint32_t>(parts));
}

/// Simple features have no rings of fewer than three corners, at three places.
bool is_drawable(const std::vector<int>& ring, const std::vector<Vec3>& points) {
  std::set<std::array<double, 3>> places;
  for (const int v : ring) places.insert({points[at(v)].x, points[at(v)].y, points[at(v)].z});
  return places.size() >= 3;
}

void append_ring(std::string& wkb, const std::vector<int>& ring, const std::vector<Vec3>& points,
                 Box& box) {
  append_binary(wkb, static_cast<std::uint32_t>(ring.size() + 1));
  for (std::size_t i = 0; i <= ring.size(); ++i) {
    const Vec3 p = points[at(ring[i % ring.size()])];
    box.grow(p);
    for (const double x : {p.x, p.y, p.z}) append_binary(wkb, x);
  }
}

}  // namespace

std::string gpkg_geometry(std::span<const std::vector<std::vector<int>>* const> polygons,
                          const std::vector<Vec3>& points, Box& box) {
  std::string wkb;
  std::size_t count = 0;
  const auto is_good = [&](const std::vector<int>& ring) { return is_drawable(ring, points); };
  for (const auto* rings : polygons) {
    if (rings->empty() || !is_good(rings->front())) continue;
    ++count;
    append_wkb_head(wkb, kPolygonZ,
                    static_cast<std::size_t>(std::ranges::count_if(*rings, is_good)));
    for (const std::vector<int>& ring : *rings)
      if (is_good(ring)) append_ring(wkb, ring, points, box);
  }
  if (count == 0) return {};
  std::string out{'G', 'P', '\0', kFlags};
  append_binary(out, std::int32_t{0});
  for (const double x : {box.min.x, box.max.x, box.min.y, box.max.y, box.min.z, box.max.z})
    append_binary(out, x);
  append_wkb_head(out, kMultiPolygonZ, count);
  return out + wkb;
}

void set_reference_system(std::string& geometry, std::int32_t number) {
  const auto bytes = little_endian(number);
  geometry.replace(kReferencePlace, bytes.size(), bytes.data(), bytes.size());
}

}  // namespace oriel::detail
