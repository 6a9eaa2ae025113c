#include "kernel/segment/planes/planes.h"

#include "kernel/base/index.h"
#include "kernel/geometry/exact.h"

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <tuple>

namespace oriel::detail {

PlaneTable::PlaneTable(const std::vector<Plane>& oriented) : sides_(oriented.size()) {
  struct Turned {
    Plane plane;
    bool is_flipped;
  };
  std::vector<Turned> turned;
  turned.reserve(oriented.size());
  for (const Plane& given : oriented) {
    const auto leading =
        std::ranges::find_if(given.coefficients, [](std::int64_t n) { return n != 0; });
    const bool is_flipped = *leading < 0;
    turned.push_back({is_flipped ? exact::opposite(given) : given, is_flipped});
  }
  std::vector<int> order(oriented.size());
  std::iota(order.begin(), order.end(), 0);
  std::ranges::sort(order, [&](int i, int j) {
    const Plane &p = turned[at(i)].plane, &q = turned[at(j)].plane;
    return std::tie(p.coefficients, p.offset, i) < std::tie(q.coefficients, q.offset, j);
  });
  planes_.reserve(oriented.size());
  for (const int i : order) add(turned[at(i)].plane, turned[at(i)].is_flipped, PlaneId{i});
}

void PlaneTable::add(const Plane& plane, bool is_flipped, PlaneId id) {
  const bool is_new_class =
      planes_.empty() || planes_.back().plane.coefficients != plane.coefficients;
  if (is_new_class) classes_.emplace_back();
  ParallelPlanes& c = classes_.back();
  if (is_new_class || planes_.back().plane.offset != plane.offset) {
    TablePlane& entry = planes_.emplace_back();
    entry.normal_class = class_count() - 1;
    entry.rank = 2 * static_cast<int>(c.planes.size()) + 1;
    c.planes.push_back(size() - 1);
    c.offsets_m.emplace_back();
  }
  planes_.back().plane = plane;
  planes_.back().ids[is_flipped ? 1 : 0] = id;
  c.normal = plane.normal;
  c.offsets_m.back() = plane.offset_m;
  sides_[id.index()] = 2 * (size() - 1) + (is_flipped ? 1 : 0);
}

std::optional<PlaneSide> PlaneTable::find(const Plane& plane) const {
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
