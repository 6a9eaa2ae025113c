#include "studio/session/verbs/building_bytes.h"

#include "studio/session/geometry_json.h"
#include "studio/session/storeys.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <utility>

namespace oriel::studio {

namespace {

constexpr std::size_t kAligned = 4;
constexpr std::int64_t kMostShort = std::numeric_limits<std::uint16_t>::max();

using PointMm = std::array<std::int64_t, 3>;

void append_number(std::uint32_t number, std::size_t bytes, std::string& text) {
  for (std::size_t i = 0; i < bytes; ++i) text.push_back(static_cast<char>(number >> (8 * i)));
}

void fill_up(char filling, std::string& text) {
  text.resize((text.size() + kAligned - 1) / kAligned * kAligned, filling);
}

void append_list(std::span<const std::uint32_t> numbers, bool is_short, std::string& text) {
  for (const std::uint32_t number : numbers) append_number(number, is_short ? 2 : 4, text);
  fill_up('\0', text);
}

/// The lists of a building.
struct FlatBuilding {
  PointMm base_mm{};
  bool is_short = true;
  std::vector<std::uint32_t> vertices, ring_ends, corner_ends, corners, owner_ends, owners;

  [[nodiscard]] bool are_few() const {
    const std::size_t most = std::max({vertices.size(), corners.size(), owners.size()});
    return std::cmp_less_equal(most, kMostShort);
  }
};

void flatten_vertices(const OpenBuilding& open, const Vec3& origin_m, FlatBuilding& flat) {
  std::vector<PointMm> points;
  points.reserve(open.building->vertices.size());
  const Vec3 shift_m = open.building->frame.origin_m - origin_m;
  for (const Vec3& vertex : open.building->vertices) {
    const Vec3 p = vertex + shift_m;
    points.push_back({whole_millimetres(p.x), whole_millimetres(p.y), whole_millimetres(p.z)});
  }
  for (std::size_t axis = 0; axis < 3 && !points.empty(); ++axis) {
    const auto along = [axis](const PointMm& p) { return p[axis]; };
    const auto [least, most] = std::ranges::minmax(points, {}, along);
    flat.base_mm[axis] = least[axis];
    flat.is_short = flat.is_short && most[axis] - least[axis] <= kMostShort;
  }
  for (const PointMm& p : points)
    for (std::size_t axis = 0; axis < 3; ++axis)
      flat.vertices.push_back(static_cast<std::uint32_t>(p[axis] - flat.base_mm[axis]));
}

void flatten_polygons(const OpenBuilding& open, FlatBuilding& flat) {
  for (const Polygon& polygon : open.building->polygons) {
    for (const auto& ring : polygon.rings) {
      for (const auto vertex : ring) flat.corners.push_back(static_cast<std::uint32_t>(vertex));
      flat.corner_ends.push_back(static_cast<std::uint32_t>(flat.corners.size()));
    }
    flat.ring_ends.push_back(static_cast<std::uint32_t>(flat.corner_ends.size()));
    for (const int owner : open.owners[static_cast<std::size_t>(polygon.source)])
      flat.owners.push_back(static_cast<std::uint32_t>(owner));
    flat.owner_ends.push_back(static_cast<std::uint32_t>(flat.owners.size()));
  }
}

StudioJson storeys_json(const OpenBuilding& open, const Vec3& origin_m) {
  StudioJson list = StudioJson::array();
  for (const double floor_m : storey_floors(*open.building, open.segmented))
    list.push_back(whole_millimetres(floor_m + open.building->frame.origin_m.z - origin_m.z));
  return list;
}

}  // namespace

std::string building_bytes(const std::vector<NumberedBuilding>& buildings, const Vec3& origin_m) {
  StudioJson entries = StudioJson::array();
  std::string lists;
  for (const auto& [number, open] : buildings) {
    FlatBuilding flat;
    flatten_vertices(*open, origin_m, flat);
    flatten_polygons(*open, flat);
    entries.push_back({{"number", number},
                       {"base_mm", flat.base_mm},
                       {"is_short", flat.is_short},
                       {"are_few", flat.are_few()},
                       {"vertices", flat.vertices.size() / 3},
                       {"polygons", flat.ring_ends.size()},
                       {"rings", flat.corner_ends.size()},
                       {"corners", flat.corners.size()},
                       {"owners", flat.owners.size()},
                       {"storeys_mm", storeys_json(*open, origin_m)}});
    append_list(flat.vertices, flat.is_short, lists);
    for (const auto* list :
         {&flat.ring_ends, &flat.corner_ends, &flat.corners, &flat.owner_ends, &flat.owners})
      append_list(*list, flat.are_few(), lists);
  }
  std::string head = dump({{"buildings", std::move(entries)}});
  fill_up(' ', head);
  std::string bytes;
  bytes.reserve(kAligned + head.size() + lists.size());
  append_number(static_cast<std::uint32_t>(head.size()), kAligned, bytes);
  return bytes.append(head).append(lists);
}

}  // namespace oriel::studio
