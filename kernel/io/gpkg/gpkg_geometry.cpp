#include "kernel/io/gpkg/gpkg_geometry.h"

#include "kernel/base/index.h"

#include <array>
#include <bit>
#include <cstddef>

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

}  // namespace

std::string gpkg_geometry(std::span<const std::vector<std::vector<int>>* const> polygons,
                          const std::vector<Vec3>& points, Box& box) {
  if (polygons.empty()) return {};
  std::string wkb;
  append_wkb_head(wkb, kMultiPolygonZ, polygons.size());
  for (const auto* rings : polygons) {
    append_wkb_head(wkb, kPolygonZ, rings->size());
    for (const std::vector<int>& ring : *rings) {
      append_binary(wkb, static_cast<std::uint32_t>(ring.size() + 1));
      for (std::size_t i = 0; i <= ring.size(); ++i) {
        const Vec3 p = points[at(ring[i % ring.size()])];
        box.grow(p);
        for (const double x : {p.x, p.y, p.z}) append_binary(wkb, x);
      }
    }
  }
  std::string out{'G', 'P', '\0', kFlags};
  append_binary(out, std::int32_t{0});
  for (const double x : {box.min.x, box.max.x, box.min.y, box.max.y, box.min.z, box.max.z})
    append_binary(out, x);
  return out + wkb;
}

void set_reference_system(std::string& geometry, std::int32_t number) {
  const auto bytes = little_endian(number);
  geometry.replace(kReferencePlace, bytes.size(), bytes.data(), bytes.size());
}

}  // namespace oriel::detail
