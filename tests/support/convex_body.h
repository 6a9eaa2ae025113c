#pragma once

#include "model/building.h"
#include "model/vec3.h"

#include <string>
#include <vector>

namespace oriel::test {

/// normal · p ≤ offset; the normal need not have length 1.
struct HalfSpace {
  Vec3 normal;
  double offset;
};

/// The six half-spaces of a box.
std::vector<HalfSpace> box(Vec3 min, Vec3 max);

/// A body made of convex pieces in code: each piece (an intersection of half-spaces) is added or
/// taken away, later ones override earlier ones. Its polygons are the faces between the cells of
/// the arrangement of all planes: slow (n³ cells), simple, and free of T-vertices.
class ConvexBody {
 public:
  ConvexBody& add(std::vector<HalfSpace> piece) { return put(std::move(piece), true); }
  ConvexBody& remove(std::vector<HalfSpace> piece) { return put(std::move(piece), false); }
  [[nodiscard]] Building build(const std::string& id = "body") const;

 private:
  struct Piece {
    std::vector<HalfSpace> half_spaces;
    bool is_solid;
  };
  ConvexBody& put(std::vector<HalfSpace> piece, bool is_solid);
  [[nodiscard]] bool is_solid_at(Vec3 p) const;

  std::vector<Piece> pieces_;
};

}  // namespace oriel::test
