#pragma once

#include "io/picture/picture.h"
#include "model/vec3.h"

#include <array>
#include <optional>
#include <vector>

namespace oriel::detail {

/// A point of a picture: pixels from its left upper corner, y down.
struct PicturePoint {
  double x = 0, y = 0;
};
using PictureRing = std::vector<PicturePoint>;

/// A part of a picture, in pixels.
struct PictureBox {
  double left = 0, top = 0, width = 0, height = 0;
};

/// A parallel projection: unit vectors that look right and up in the picture, and towards the
/// viewer.
struct Camera {
  Vec3 right, up, towards;
};

/// Looks at the origin from an azimuth, clockwise from north, and an elevation.
Camera camera_at(double azimuth_deg, double elevation_deg);

/// Makes the camera that `options` ask for; none if no wall looks to the side of a facade.
std::optional<Camera> camera_of(const MeshSource& mesh, const PictureOptions& options);

/// Where a camera's picture lies: what is `middle` (metres along right and up from the origin) is
/// in the middle of the box.
struct Placing {
  /// Near what is shown: coordinates of a country have too many digits for a depth buffer.
  Vec3 origin;
  std::array<double, 2> middle{};
  std::array<double, 2> size_m{};
  double pixels_per_m = 1;
  PictureBox box;

  [[nodiscard]] PicturePoint at(const Camera& camera, Vec3 point) const {
    const Vec3 from = point - origin;
    return {box.left + box.width / 2 + (dot(from, camera.right) - middle[0]) * pixels_per_m,
            box.top + box.height / 2 - (dot(from, camera.up) - middle[1]) * pixels_per_m};
  }
};

/// Puts all of the mesh into the box, with a margin.
Placing placing_in(const MeshSource& mesh, const Camera& camera, const PictureBox& box,
                   Vec3 origin = {});

}  // namespace oriel::detail
