#include "io/picture/camera.h"

#include "kernel/base/index.h"
#include "kernel/geometry/directions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

namespace oriel::detail {

namespace {

/// Of a panel, on each side.
constexpr double kMargin = 0.04;
/// A facade belongs to the side that it looks to most.
constexpr double kSide_deg = 45;

double turn_between_deg(double a, double b) {
  const double turn = std::fmod(std::abs(a - b), 360.0);
  return std::min(turn, 360 - turn);
}

double area_m2(const MeshSource& mesh, const MeshPolygon& polygon) {
  double sum = 0;
  for (const auto& ring : polygon.rings)
    sum += dot(polygon.normal,
               area_vector(ring.size(), [&](std::size_t i) { return mesh.points[at(ring[i])]; }));
  return sum;
}

/// The azimuth, in whole degrees, of the walls with most area on a side.
std::optional<double> facade_azimuth_deg(const MeshSource& mesh, double side_deg) {
  std::map<int, double> area_of;
  for (const MeshPolygon& polygon : mesh.polygons) {
    if (!looks_aside(polygon.normal)) continue;
    const double azimuth = azimuth_deg(polygon.normal);
    if (turn_between_deg(azimuth, side_deg) <= kSide_deg)
      area_of[static_cast<int>(std::lround(azimuth)) % 360] += area_m2(mesh, polygon);
  }
  if (area_of.empty()) return std::nullopt;
  return std::ranges::max_element(area_of, {}, [](const auto& of) { return of.second; })->first;
}

}  // namespace

Camera camera_at(double azimuth_deg, double elevation_deg) {
  const double a = azimuth_deg * kDegree_rad, e = elevation_deg * kDegree_rad;
  Camera camera;
  camera.towards = {std::sin(a) * std::cos(e), std::cos(a) * std::cos(e), std::sin(e)};
  camera.right = {-std::cos(a), std::sin(a), 0};
  camera.up = cross(camera.towards, camera.right);
  return camera;
}

std::optional<Camera> camera_of(const MeshSource& mesh, const PictureOptions& options) {
  if (options.view == PictureView::plan) return Camera{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  if (options.view == PictureView::oblique)
    return camera_at(options.azimuth_deg, options.elevation_deg);
  const auto azimuth = facade_azimuth_deg(mesh, options.azimuth_deg);
  if (!azimuth) return std::nullopt;
  return camera_at(*azimuth, 0);
}

Placing placing_in(const MeshSource& mesh, const Camera& camera, const PictureBox& box,
                   Vec3 origin) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  std::array<double, 2> least{kFar, kFar}, most{-kFar, -kFar};
  for (const MeshPolygon& polygon : mesh.polygons)
    for (const auto& ring : polygon.rings)
      for (const int v : ring) {
        const Vec3 point = mesh.points[at(v)] - origin;
        const std::array<double, 2> p{dot(point, camera.right), dot(point, camera.up)};
        for (std::size_t i = 0; i < 2; ++i) {
          least[i] = std::min(least[i], p[i]);
          most[i] = std::max(most[i], p[i]);
        }
      }
  Placing placing{.origin = origin, .box = box};
  if (least[0] > most[0]) return placing;
  for (std::size_t i = 0; i < 2; ++i) {
    placing.middle[i] = (least[i] + most[i]) / 2;
    placing.size_m[i] = std::max(most[i] - least[i], 1e-3);
  }
  placing.pixels_per_m =
      (1 - 2 * kMargin) * std::min(box.width / placing.size_m[0], box.height / placing.size_m[1]);
  return placing;
}

}  // namespace oriel::detail
