#pragma once

#include "model/building.h"
#include "model/vec3.h"

#include <string>
#include <vector>

namespace oriel::test {

/// A body made of boxes in code: each box is added or taken away, later ones override earlier ones.
/// Its polygons are the faces between cells of the grid that all boxes span; solidify makes facets
/// of them.
class BoxBody {
 public:
  BoxBody& add(Vec3 min, Vec3 max) { return put(min, max, true); }
  BoxBody& remove(Vec3 min, Vec3 max) { return put(min, max, false); }
  [[nodiscard]] Building build(const std::string& id = "body") const;

 private:
  struct Part {
    Vec3 min, max;
    bool is_solid;
  };
  BoxBody& put(Vec3 min, Vec3 max, bool is_solid) {
    parts_.push_back({min, max, is_solid});
    return *this;
  }
  [[nodiscard]] bool is_solid_at(Vec3 p) const;

  std::vector<Part> parts_;
};

/// A building of polygons given by their points, outer rings only.
Building building_of(const std::vector<std::vector<Vec3>>& polygons,
                     const std::string& id = "body");

}  // namespace oriel::test
