#include "io/picture/faces.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace oriel::detail {

namespace {

/// A face that is turned away from the viewer as far as this is a line.
constexpr double kEdgeOn = 1e-6;

/// The light comes over the viewer's left shoulder: what it meets squarely keeps its colour.
Colour shade(Colour colour, Vec3 normal, const Camera& camera) {
  const Vec3 light =
      normalised(camera.towards + 0.9 * camera.up + -0.6 * camera.right + Vec3{0, 0, 0.4});
  const double lit = 0.70 + 0.34 * std::max(0.0, dot(normal, light));
  Colour out;
  for (std::size_t i = 0; i < out.size(); ++i)
    out[i] = static_cast<std::uint8_t>(std::clamp(std::lround(colour[i] * lit), 0L, 255L));
  return out;
}

/// True if each edge of the mesh is met as often in one direction as in the other.
bool is_closed(const MeshSource& mesh) {
  std::map<std::pair<int, int>, int> balance;
  for (const MeshPolygon& polygon : mesh.polygons)
    for (const auto& ring : polygon.rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const int from = ring[i], to = ring[(i + 1) % ring.size()];
        balance[std::minmax(from, to)] += from < to ? 1 : -1;
      }
  return std::ranges::all_of(balance, [](const auto& edge) { return edge.second == 0; });
}

void set_bounds(PictureFace& face) {
  const PictureRing& outer = face.rings.front();
  const auto [left, right] = std::ranges::minmax_element(outer, {}, &PicturePoint::x);
  const auto [top, bottom] = std::ranges::minmax_element(outer, {}, &PicturePoint::y);
  face.left = left->x;
  face.right = right->x;
  face.top = top->y;
  face.bottom = bottom->y;
}

/// The plane of a polygon, as nearness over the picture.
std::array<double, 3> nearness_of(const MeshSource& mesh, const MeshPolygon& polygon, Vec3 normal,
                                  const Camera& camera, const Placing& placing) {
  Vec3 middle;
  for (const int v : polygon.rings.front()) middle = middle + mesh.points[at(v)];
  middle = (1.0 / static_cast<double>(polygon.rings.front().size())) * middle;
  const double facing = dot(normal, camera.towards);
  const double along_x = -dot(normal, camera.right) / facing / placing.pixels_per_m;
  const double along_y = dot(normal, camera.up) / facing / placing.pixels_per_m;
  const PicturePoint at = placing.at(camera, middle);
  return {dot(middle - placing.origin, camera.towards) - along_x * at.x - along_y * at.y, along_x,
          along_y};
}

}  // namespace

std::vector<PictureFace> faces_of(const MeshSource& mesh, const Camera& camera,
                                  const Placing& placing, bool hides_backs) {
  hides_backs = hides_backs || is_closed(mesh);
  std::vector<PictureFace> faces;
  for (std::size_t i = 0; i < mesh.polygons.size(); ++i) {
    const MeshPolygon& polygon = mesh.polygons[i];
    const double facing = dot(polygon.normal, camera.towards);
    if (polygon.rings.empty() || std::abs(facing) < kEdgeOn || (hides_backs && facing < 0))
      continue;
    PictureFace face;
    for (const auto& ring : polygon.rings) {
      PictureRing& points = face.rings.emplace_back();
      for (const int v : ring) points.push_back(placing.at(camera, mesh.points[at(v)]));
    }
    face.polygon = i;
    face.normal = facing < 0 ? -polygon.normal : polygon.normal;
    face.near = nearness_of(mesh, polygon, face.normal, camera, placing);
    face.feature = polygon.feature;
    const std::string label =
        polygon.feature < 0 ? std::string() : mesh.features[at(polygon.feature)].label;
    face.is_part = is_label_of_part(label);
    face.colour = colour_of_label(label);
    face.shaded = shade(face.colour, face.normal, camera);
    set_bounds(face);
    faces.push_back(std::move(face));
  }
  return faces;
}

}  // namespace oriel::detail
