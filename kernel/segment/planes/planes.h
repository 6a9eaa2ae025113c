#pragma once

#include "kernel/base/assert.h"
#include "model/solid.h"

#include <array>
#include <optional>
#include <span>
#include <vector>

namespace oriel::detail {

/// One orientation of a geometric plane: 2 · plane + flip. Turning it round is `side ^ 1`.
using PlaneSide = int;

/// The split planes of a solid, sorted into classes of one normal. Within a class a plane is an
/// offset, and its rank is 2·i + 1 for the i-th offset; what lies between two planes has the even
/// rank between.
class PlaneTable {
 public:
  explicit PlaneTable(std::span<const Plane> oriented);

  struct ParallelPlanes {
    Vec3 normal;
    std::vector<int> planes;  ///< by ascending offset
    std::vector<double> offsets_m;
  };

  [[nodiscard]] int size() const { return static_cast<int>(planes_.size()); }
  [[nodiscard]] int class_count() const { return static_cast<int>(classes_.size()); }
  [[nodiscard]] const ParallelPlanes& normal_class(int k) const {
    return classes_[static_cast<std::size_t>(k)];
  }
  [[nodiscard]] int class_of(int plane) const { return entry(plane).normal_class; }
  [[nodiscard]] int rank_of(int plane) const { return entry(plane).rank; }
  /// The plane as its class has it (side 2·plane).
  [[nodiscard]] const Plane& plane(int plane) const { return entry(plane).plane; }
  [[nodiscard]] Vec3 normal(PlaneSide side) const {
    const Vec3 n = entry(side >> 1).plane.normal;
    return (side & 1) != 0 ? -n : n;
  }
  [[nodiscard]] double offset_m(PlaneSide side) const {
    const double d = entry(side >> 1).plane.offset_m;
    return (side & 1) != 0 ? -d : d;
  }
  /// The side that an oriented plane of the solid is.
  [[nodiscard]] PlaneSide side_of(PlaneId id) const { return sides_[id.index()]; }
  /// The side that a plane is, in either orientation; nothing if the solid has no such plane.
  [[nodiscard]] std::optional<PlaneSide> find(const Plane& plane) const;
  /// The id of a side among the solid's planes, invalid if no facet of the solid had it.
  [[nodiscard]] PlaneId id_of(PlaneSide side) const {
    return entry(side >> 1).ids[static_cast<std::size_t>(side & 1)];
  }

 private:
  struct TablePlane {
    Plane plane;
    int normal_class = 0;
    int rank = 0;
    std::array<PlaneId, 2> ids;
  };
  /// Planes come by their coefficients, then offsets, and have the sign that classes have.
  void add(const Plane& plane, bool is_flipped, PlaneId id);
  [[nodiscard]] const TablePlane& entry(int plane) const {
    ORIEL_ASSERT(plane >= 0 && plane < size(), "no plane of the table");
    return planes_[static_cast<std::size_t>(plane)];
  }

  std::vector<TablePlane> planes_;
  std::vector<ParallelPlanes> classes_;
  std::vector<PlaneSide> sides_;
};

}  // namespace oriel::detail
