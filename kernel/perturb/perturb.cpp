#include "kernel/perturb/perturb.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"
#include "kernel/base/random.h"
#include "kernel/geometry/near_points.h"
#include "kernel/perturb/polygon_triangles.h"
#include "model/tolerances.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <utility>

namespace oriel {

namespace {

constexpr double kMicrometresInMetre = 1e6;

/// The nearest whole number of micrometres.
std::int64_t in_micrometres(double metres) { return std::llround(metres * kMicrometresInMetre); }

MicrometrePoint in_micrometres(Vec3 metres) {
  return {{in_micrometres(metres.x), in_micrometres(metres.y), in_micrometres(metres.z)}};
}

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

/// How far noise moves each vertex: those closer than 1 mm, and those that such pairs link, alike.
/// Drawn in the order of the vertices' places, so that their numbers do not matter.
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

/// The triangles of a polygon, each with all that the polygon has besides its rings; the polygon
/// itself if it is a triangle or cannot be cut. Decided on whole micrometres.
std::vector<Polygon> triangulated(const std::vector<Vec3>& vertices, const Polygon& polygon,
                                  Random& random) {
  if (polygon.rings.empty()) return {polygon};
  const auto place_of = [&](int vertex) { return in_micrometres(vertices[at(vertex)]); };
  const auto triangles = detail::polygon_triangles(
      polygon.rings, area_vector(vertices, polygon.rings[0]), place_of, random);
  if (triangles.empty()) return {polygon};
  std::vector<Polygon> out;
  for (const auto& [a, b, c] : triangles) {
    Polygon& piece = out.emplace_back(polygon);
    piece.rings.assign(1, {a, b, c});
  }
  return out;
}

/// What is drawn for one part of a perturbation is a stream of its own.
constexpr std::uint64_t kMissing = 0x6d697373;
constexpr std::uint64_t kCorners = 0x6e6f6973;
constexpr std::uint64_t kTriangles = 0x74726961;

/// FNV-1a.
std::uint64_t hash_of(const std::string& id) {
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char byte : id) hash = (hash ^ static_cast<unsigned char>(byte)) * 0x100000001b3U;
  return hash;
}

/// The nearest multiple of 2^-30 m: sines of two machines may differ in the last digit.
double without_last_digits(double metres) {
  return std::ldexp(std::round(std::ldexp(metres, 30)), -30);
}

Vec3 without_last_digits(Vec3 p) {
  return {without_last_digits(p.x), without_last_digits(p.y), without_last_digits(p.z)};
}

Vec3 middle_of(const std::vector<Vec3>& vertices) {
  Box box;
  for (const Vec3 p : vertices) box.grow(p);
  return box.is_empty() ? Vec3{} : 0.5 * (box.min + box.max);
}

/// Replaces every polygon by those that `make` gives for it.
void replace_polygons(Building& building,
                      const std::function<std::vector<Polygon>(std::size_t)>& make) {
  std::vector<Polygon> polygons;
  std::vector<int> first;  // by old polygon, and the end
  for (std::size_t i = 0; i < building.polygons.size(); ++i) {
    first.push_back(static_cast<int>(polygons.size()));
    for (Polygon& polygon : make(i)) polygons.push_back(std::move(polygon));
  }
  first.push_back(static_cast<int>(polygons.size()));
  for (JoinedInstallation& installation : building.installations)
    installation.first_polygon = at(first[installation.first_polygon]);
  std::erase_if(building.repeats, [&](const RepeatedVertex& repeat) {
    return first[at(repeat.polygon) + 1] - first[at(repeat.polygon)] != 1;
  });
  for (RepeatedVertex& repeat : building.repeats) repeat.polygon = first[at(repeat.polygon)];
  building.polygons = std::move(polygons);
}

void take_out(Building& building, double share, Random random) {
  const std::size_t count = building.polygons.size();
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{0});
  random.shuffle(order);
  const auto taken = static_cast<std::size_t>(std::floor(share * static_cast<double>(count) + 0.5));
  std::vector<char> is_taken(count, 0);
  for (std::size_t i = 0; i < std::min(taken, count); ++i) is_taken[order[i]] = 1;
  replace_polygons(building, [&](std::size_t i) {
    return is_taken[i] != 0 ? std::vector<Polygon>{}
                            : std::vector<Polygon>{std::move(building.polygons[i])};
  });
}

void cut_into_triangles(Building& building, std::vector<int>& source_before, std::uint64_t seed,
                        std::uint64_t id) {
  replace_polygons(building, [&](std::size_t i) {
    const Polygon& polygon = building.polygons[i];
    // A polygon is cut the same way whichever others there are.
    Random random(seed, id + static_cast<std::uint64_t>(polygon.source));
    std::vector<Polygon> triangles = triangulated(building.vertices, polygon, random);
    for (std::size_t t = 1; t < triangles.size(); ++t) {
      triangles[t].source = static_cast<int>(source_before.size());
      source_before.push_back(polygon.source);
    }
    return triangles;
  });
}

/// Turns and shifts the building and moves each vertex by its noise. The turn is done where
/// coordinates are small.
void move(Building& building, const Motion& turn, Vec3 shift_m, const std::vector<Vec3>& noise) {
  Box box;
  for (std::size_t i = 0; i < building.vertices.size(); ++i) {
    Vec3& p = building.vertices[i];
    if (!turn.is_still()) p = without_last_digits(turn.after(p));
    if (!noise.empty()) p = p + noise[i];
    box.grow(p);
  }
  if (box.is_empty()) return;
  const Vec3 origin = building.frame.origin_m + shift_m;
  building.frame = frame_of({origin + box.min}, building.frame.crs);
  const Vec3 off = origin - building.frame.origin_m;
  for (Vec3& p : building.vertices) p = p + off;
}

}  // namespace

Perturbed perturbed(const Building& building, const Perturbation& perturbation) {
  ORIEL_ASSERT(perturbation.noise_m >= 0);
  ORIEL_ASSERT(perturbation.missing_share >= 0 && perturbation.missing_share <= 1);
  Perturbed out{building, {}, {}};
  int sources = 0;
  for (const Polygon& polygon : building.polygons) sources = std::max(sources, polygon.source + 1);
  out.source_before.resize(at(sources));
  std::iota(out.source_before.begin(), out.source_before.end(), 0);

  const std::uint64_t id = hash_of(building.id);
  const std::uint64_t seed = perturbation.seed;
  if (perturbation.missing_share > 0)
    take_out(out.building, perturbation.missing_share, Random(seed ^ kMissing, id));

  const bool has_noise = perturbation.noise_m > 0;
  if (perturbation.triangulates && !has_noise)
    cut_into_triangles(out.building, out.source_before, seed ^ kTriangles, id);
  const Vec3 middle = middle_of(building.vertices);
  out.motion =
      Motion(building.frame.origin_m + middle, perturbation.rotation_deg, perturbation.shift_m);
  std::vector<Vec3> noise;
  if (has_noise)
    noise = corner_noise(building.vertices, perturbation.noise_m, perturbation.noise_kind,
                         Random(seed ^ kCorners, id));
  if (has_noise || !out.motion.is_still())
    move(out.building, Motion(middle, perturbation.rotation_deg, {}), perturbation.shift_m, noise);
  if (perturbation.triangulates && has_noise)
    cut_into_triangles(out.building, out.source_before, seed ^ kTriangles, id);
  return out;
}

}  // namespace oriel
