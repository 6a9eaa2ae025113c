#pragma once

#include "model/vec3.h"

#include <span>

namespace oriel {

/// How a perturbation turns and shifts a building.
class Motion {
 public:
  /// Stays where it is.
  Motion() = default;
  /// A rotation about the upright axis through `centre`, then a shift. Quarter turns are exact.
  Motion(Vec3 centre, double rotation_deg, Vec3 shift_m);

  [[nodiscard]] bool is_still() const { return is_still_; }
  [[nodiscard]] Vec3 after(Vec3 point) const;
  /// Where a point of the perturbed building was: undoes after().
  [[nodiscard]] Vec3 before(Vec3 point) const;

 private:
  Vec3 centre_, shift_m_;
  double cos_ = 1, sin_ = 0;
  bool is_still_ = true;
};

/// The box of points of a perturbed building where they were before it was moved. Truth stays as it
/// is and found objects are compared with it by these boxes: the box of a turned box is larger than
/// the box of what was in it, so turning the truth's boxes would make good labels look bad.
Box box_before(const Motion& motion, std::span<const Vec3> points);

}  // namespace oriel
