#pragma once

#include "io/mesh/label_colours.h"
#include "io/picture/camera.h"

#include <array>
#include <optional>
#include <vector>

namespace oriel::detail {

/// Faces that one place has at nearly the same depth lie in one plane.
inline constexpr double kSameDepth_m = 1e-4;
inline constexpr Colour kLineColour{0x2b, 0x2a, 0x28};

/// A polygon of a mesh as it lies in a picture.
struct PictureFace {
  /// The outer ring first; even-odd.
  std::vector<PictureRing> rings;
  double left = 0, right = 0, top = 0, bottom = 0;
  /// How near to the viewer the face is, in metres, at (x, y): near[0] + near[1] x + near[2] y.
  std::array<double, 3> near{};
  Vec3 normal;
  /// The polygon of the mesh.
  std::size_t polygon = 0;
  /// Index into MeshSource::features, or -1.
  int feature = -1;
  /// The feature has a label that is no plain surface.
  bool is_part = false;
  /// That of its label.
  Colour colour{};
  /// The same, lighter or darker by the face's slope.
  Colour shaded{};
  /// That of the lines about its feature, if that is marked.
  std::optional<Colour> mark{};

  [[nodiscard]] double nearness(double x, double y) const {
    return near[0] + near[1] * x + near[2] * y;
  }
};

/// Gives the faces of a mesh that can be seen from the camera if nothing hides them: those of
/// closed bodies that look towards it, and both sides of others, unless their backs are hidden,
/// too. In the order of the polygons.
std::vector<PictureFace> faces_of(const MeshSource& mesh, const Camera& camera,
                                  const Placing& placing, bool hides_backs = false);

}  // namespace oriel::detail
