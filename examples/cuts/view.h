#pragma once

#include "examples/cuts/steps.h"

#include <vector>

namespace oriel::cuts {

/// A parallel projection: a point is at (right · p, up · p), `towards` points to the viewer.
struct Camera {
  Vec3 right, up, towards;
};

/// From the south, turned by the azimuth to the east, looking down by the elevation; degrees.
Camera camera(double azimuth_deg, double elevation_deg);

/// A rectangle of the projection: its middle, and samples a metre.
struct Window {
  double x = 0, y = 0, scale = 1;
};

/// A plane that is seen, by its normal towards the viewer.
struct Surface {
  Vec3 normal;
  double offset_m = 0;
  /// It bounds what the node's cut takes off: material of a protrusion, walls around a hole.
  bool is_part = false;
};

/// What each sample shows, in rows from the top: 0 nothing, else surface number + 1.
struct Image {
  int width = 0, height = 0;
  std::vector<int> labels;
  std::vector<Surface> surfaces;

  [[nodiscard]] int label(int x, int y) const {
    const bool is_inside = x >= 0 && x < width && y >= 0 && y < height;
    return is_inside ? labels[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                              static_cast<std::size_t>(x)]
                     : 0;
  }
};

/// The box of the pieces in the projection: z is 0.
Box extent_of(const Segmentation& segmentation, const std::vector<Piece>& pieces,
              const Camera& camera);

/// The body that the pieces make, cells that are taken away and all. No body is built for it: along
/// the ray of a sample the signs of the cells that it is in are added up, and the first point where
/// they make 1 is seen.
Image view(const Segmentation& segmentation, const std::vector<Piece>& pieces, const Camera& camera,
           const Window& window, int width, int height);

}  // namespace oriel::cuts
