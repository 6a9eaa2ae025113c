#include "kernel/segment/detail/planes.h"

#include "kernel/geometry/exact.h"

#include <algorithm>
#include <map>
#include <utility>

namespace oriel::detail {

PlaneTable::PlaneTable(const std::vector<Plane>& oriented) : sides_(oriented.size()) {
  // One entry per geometric plane, keyed so that classes and offsets come out sorted.
  std::map<std::array<std::int64_t, 3>, std::map<std::int64_t, Entry>> by_normal;
  for (std::size_t i = 0; i < oriented.size(); ++i) {
    const Plane& given = oriented[i];
    const auto leading =
        std::ranges::find_if(given.coefficients, [](std::int64_t n) { return n != 0; });
    const bool is_flipped = *leading < 0;
    const Plane plane = is_flipped ? exact::opposite(given) : given;
    Entry& entry = by_normal[plane.coefficients][plane.offset];
    entry.plane = plane;
    entry.ids[is_flipped ? 1 : 0] = PlaneId{static_cast<int>(i)};
  }
  for (auto& [coefficients, offsets] : by_normal) {
    Class c;
    for (auto& [offset, entry] : offsets) {
      const int plane = static_cast<int>(planes_.size());
      entry.normal_class = static_cast<int>(classes_.size());
      entry.rank = 2 * static_cast<int>(c.planes.size()) + 1;
      for (int flip = 0; flip < 2; ++flip)
        if (entry.ids[static_cast<std::size_t>(flip)].is_valid())
          sides_[entry.ids[static_cast<std::size_t>(flip)].index()] = 2 * plane + flip;
      c.normal = entry.plane.normal;
      c.planes.push_back(plane);
      c.offsets_m.push_back(entry.plane.offset_m);
      planes_.push_back(entry);
    }
    classes_.push_back(std::move(c));
  }
}

std::optional<Side> PlaneTable::find(const Plane& plane) const {
  const Plane turned = exact::opposite(plane);
  const auto is_same = [](const Plane& p, const Plane& q) {
    return p.offset == q.offset && p.coefficients == q.coefficients;
  };
  for (int i = 0; i < size(); ++i) {
    if (is_same(planes_[static_cast<std::size_t>(i)].plane, plane)) return 2 * i;
    if (is_same(planes_[static_cast<std::size_t>(i)].plane, turned)) return 2 * i + 1;
  }
  return std::nullopt;
}

}  // namespace oriel::detail
