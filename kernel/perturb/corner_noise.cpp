#include "kernel/perturb/corner_noise.h"

#include "kernel/base/index.h"
#include "kernel/geometry/near_points.h"
#include "kernel/model/tolerances.h"
#include "kernel/perturb/micrometres.h"

#include <algorithm>

namespace oriel::detail {

namespace {

/// Vertices closer than this are one corner: what solidify() welds by default.
constexpr double kCorner_m = Tolerances{}.weld_m;

/// A number without unit: within -1…1, or of standard deviation 1 and within -6…6.
double draw(NoiseKind kind, Random& random) {
  if (kind == NoiseKind::uniform) return 2 * random.unit() - 1;
  double sum = -6;
  for (int i = 0; i < 12; ++i) sum += random.unit();
  return sum;
}

Vec3 draw_offset(double noise_m, NoiseKind kind, Random& random) {
  Vec3 offset;
  offset.x = noise_m * draw(kind, random);
  offset.y = noise_m * draw(kind, random);
  offset.z = noise_m * draw(kind, random);
  return offset;
}

}  // namespace

std::vector<Vec3> corner_noise(const std::vector<Vec3>& vertices, double noise_m, NoiseKind kind,
                               Random random) {
  std::vector<MicrometrePoint> places;
  for (const Vec3 p : vertices) places.push_back(in_micrometres(p));
  std::vector<MicrometrePoint> sorted = places;
  std::ranges::sort(sorted);
  sorted.erase(std::unique(sorted.begin(), sorted.end()), sorted.end());

  // The first of a group comes before its others.
  const Numbers first = group_near_points(sorted, kCorner_m * kMicrometresInMetre);
  std::vector<Vec3> offsets(sorted.size());
  for (std::size_t i = 0; i < sorted.size(); ++i)
    offsets[i] = at(first[i]) == i ? draw_offset(noise_m, kind, random) : offsets[at(first[i])];

  std::vector<Vec3> noise;
  for (const MicrometrePoint& place : places) {
    const auto found = std::ranges::lower_bound(sorted, place);
    noise.push_back(offsets[static_cast<std::size_t>(found - sorted.begin())]);
  }
  return noise;
}

}  // namespace oriel::detail
