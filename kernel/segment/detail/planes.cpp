#include "kernel/segment/detail/planes.h"

#include "kernel/geometry/exact.h"

#include <algorithm>
#include <tuple>

namespace oriel::detail {

PlaneTable::PlaneTable(const std::vector<Plane>& oriented) : sides_(oriented.size()) {
  // One entry per geometric plane, in the order of normals and offsets.
  struct Given {
    Plane plane;
    int id;
    int flip;
    [[nodiscard]] auto key() const { return std::tie(plane.coefficients, plane.offset); }
  };
  std::vector<Given> given;
  given.reserve(oriented.size());
  for (const Plane& plane : oriented) {
    const auto leading =
        std::ranges::find_if(plane.coefficients, [](std::int64_t n) { return n != 0; });
    const bool is_flipped = *leading < 0;
    given.push_back({is_flipped ? exact::opposite(plane) : plane, static_cast<int>(given.size()),
                     is_flipped ? 1 : 0});
  }
  std::ranges::stable_sort(given, {}, &Given::key);
  planes_.reserve(given.size());
  const Given* last = nullptr;
  for (const Given& next : given) {
    const bool is_new_class =
        last == nullptr || last->plane.coefficients != next.plane.coefficients;
    if (is_new_class) classes_.emplace_back().normal = next.plane.normal;
    if (is_new_class || last->plane.offset != next.plane.offset) add(next.plane);
    planes_.back().ids[static_cast<std::size_t>(next.flip)] = PlaneId{next.id};
    sides_[static_cast<std::size_t>(next.id)] = 2 * (size() - 1) + next.flip;
    last = &next;
  }
}

/// To the last class.
void PlaneTable::add(const Plane& plane) {
  Class& c = classes_.back();
  Entry& entry = planes_.emplace_back();
  entry.plane = plane;
  entry.normal_class = class_count() - 1;
  entry.rank = 2 * static_cast<int>(c.planes.size()) + 1;
  c.planes.push_back(size() - 1);
  c.offsets_m.push_back(plane.offset_m);
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
