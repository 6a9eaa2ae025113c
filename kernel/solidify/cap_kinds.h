#pragma once

#include "kernel/base/index.h"
#include "kernel/base/work.h"
#include "kernel/geometry/planar.h"
#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup.h"
#include "model/repair.h"

#include <span>
#include <vector>

namespace oriel::detail {

/// Tells what faces that close holes of a soup stand for, by where they lie and what is around
/// them.
///
/// A wall is upright within 5°. A ground is level within 5°; along more than half of its rim, by
/// length, polygons of the input rise from it by more than 5°; and nothing lies beneath it, `reach`
/// (grid units) lower: no polygon or other closing face below the middle of it, and none that has
/// its own middle below it. All else is a hole.
class CapKinds {
 public:
  using CapRings = std::vector<std::vector<int>>;

  /// The soup, whose polygons without source close holes, with `faces` that would as well. All must
  /// outlive it. Polygons that are looked at are counted in `work`.
  CapKinds(const Soup& soup, std::span<const PolygonShape> shapes, std::span<const AddedFace> faces,
           double reach, Work& work);

  /// Of a face of the soup's points, whether or not it is in the soup. Takes time as the soup has
  /// polygons if it is level, else as the face has corners.
  [[nodiscard]] CapKind kind_of(const CapRings& rings) const;

 private:
  /// What is not upright.
  struct LevelSheet {
    std::vector<Outline> outlines;
    Vec3 normal;
    double level = 0;  ///< along the normal, on average
    Box box;

    [[nodiscard]] double height_at(Vec3 point) const {
      return (level - normal.x * point.x - normal.y * point.y) / normal.z;
    }
  };

  [[nodiscard]] Vec3 place(int point) const { return exact::to_metres(soup_.points[at(point)], 1); }
  [[nodiscard]] LevelSheet sheet_of(const CapRings& rings) const;
  void collect_sheets() const;
  void keep_sheet(LevelSheet sheet) const;
  [[nodiscard]] bool is_risen_from(const CapRings& rings) const;
  [[nodiscard]] bool has_beneath(const LevelSheet& face) const;
  [[nodiscard]] bool lies_beneath(const LevelSheet& other, const LevelSheet& face,
                                  Vec3 middle) const;

  const Soup& soup_;
  std::span<const PolygonShape> shapes_;
  std::span<const AddedFace> faces_;
  double reach_;
  Work& work_;
  mutable std::vector<LevelSheet> sheets_;  ///< made for the first face that asks for them
};

}  // namespace oriel::detail
