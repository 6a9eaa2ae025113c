#include "kernel/solidify/planes/known_planes.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>

namespace oriel::detail {

namespace {

/// Cells for directions that must be the same have a size, too.
constexpr double kLeastCell = 1e-9;
/// A cell and those around it.
constexpr int kCellsAround = 27;

bool is_next_to(const NormalCell& a, const NormalCell& b) {
  return std::abs(a[0] - b[0]) <= 1 && std::abs(a[1] - b[1]) <= 1 && std::abs(a[2] - b[2]) <= 1;
}

}  // namespace

double residual_of(const OffsetSpan& span, std::int64_t offset) {
  return std::max(std::abs(static_cast<double>(span.high - offset)),
                  std::abs(static_cast<double>(offset - span.low)));
}

KnownPlanes::KnownPlanes(double angle_tolerance, std::size_t most)
    : cell_size_(std::max(2 * std::sin(angle_tolerance / 2), kLeastCell)), exact_places_(most) {}

const PlaneClass& KnownPlanes::class_at(int place) const {
  return classes_[at(places_[at(place)].normal_class)];
}

NormalCell KnownPlanes::cell_of(Vec3 u) const {
  const auto cell = [&](double c) { return static_cast<int>(std::floor(c / cell_size_)); };
  return {cell(u.x), cell(u.y), cell(u.z)};
}

int KnownPlanes::exact_place(const IntegerNormal& normal, std::int64_t offset) const {
  return exact_places_.find(table_key(normal, offset), [&](int place) {
    return places_[at(place)].offset == offset && class_at(place).normal == normal;
  });
}

std::vector<int> KnownPlanes::near_classes(Vec3 u) const {
  std::vector<int> found;
  if (classes_.size() < kCellsAround) {  // fewer than there are cells to look into
    for (std::size_t k = 0; k < classes_.size(); ++k)
      if (is_next_to(cell_of(u), classes_[k].cell) || is_next_to(cell_of(-u), classes_[k].cell))
        found.push_back(static_cast<int>(k));
    return found;
  }
  for (const Vec3 v : {u, -u}) {
    const auto [x, y, z] = cell_of(v);
    if (x < -1) continue;  // the normals of classes have x ≥ 0
    for (int n = 0; n < kCellsAround; ++n) {
      const auto cell = cells_.find({x + n % 3 - 1, y + n / 3 % 3 - 1, z + n / 9 - 1});
      if (cell != cells_.end()) found.insert(found.end(), cell->second.begin(), cell->second.end());
    }
  }
  std::ranges::sort(found);
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

std::optional<PlaneFit> KnownPlanes::known_fit(int k, const OffsetSpan& span,
                                               double tolerance) const {
  const PlaneClass& c = classes_[at(k)];
  const double reach = tolerance * c.size;
  std::optional<PlaneFit> best;
  const auto from = static_cast<std::int64_t>(std::ceil(static_cast<double>(span.high) - reach));
  auto o = std::ranges::lower_bound(c.offsets, from, {}, &PlaneClass::Offset::offset);
  for (; o != c.offsets.end(); ++o) {
    if (residual_of(span, o->offset) > reach) break;
    const double residual = residual_of(span, o->offset) / c.size;
    if (!best || residual < best->residual) best = PlaneFit{k, true, o->offset, residual};
  }
  return best;
}

int KnownPlanes::number_of(int k, std::int64_t offset) {
  PlaneClass& c = classes_[at(k)];
  const auto o = std::ranges::lower_bound(c.offsets, offset, {}, &PlaneClass::Offset::offset);
  if (o != c.offsets.end() && o->offset == offset) return o->place;
  const int place = static_cast<int>(places_.size());
  c.offsets.insert(o, {offset, place});
  places_.push_back({k, offset});
  // Of classes with one normal the first one's place is the one that polygons take.
  int& exact = exact_places_.at(table_key(c.normal, offset), [&](int other) {
    return places_[at(other)].offset == offset && class_at(other).normal == c.normal;
  });
  if (exact < 0 || k < places_[at(exact)].normal_class) exact = place;
  return place;
}

int KnownPlanes::add_class(const IntegerNormal& normal) {
  PlaneClass c;
  c.normal = normal;
  c.unit = unit(normal);
  c.size = length({static_cast<double>(normal[0]), static_cast<double>(normal[1]),
                   static_cast<double>(normal[2])});
  c.cell = cell_of(c.unit);
  const int number = static_cast<int>(classes_.size());
  cells_[c.cell].push_back(number);
  classes_.push_back(std::move(c));
  return number;
}

}  // namespace oriel::detail
