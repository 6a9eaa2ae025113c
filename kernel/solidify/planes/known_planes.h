#pragma once

#include "kernel/geometry/exact.h"
#include "kernel/solidify/planes/number_table.h"
#include "kernel/solidify/soup/polygon_shape.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace oriel::detail {

/// The normal or its negative: its first component that is not zero is positive.
inline IntegerNormal unoriented(const IntegerNormal& normal) {
  const bool is_against =
      normal[0] < 0 || (normal[0] == 0 && (normal[1] < 0 || (normal[1] == 0 && normal[2] < 0)));
  return is_against ? IntegerNormal{-normal[0], -normal[1], -normal[2]} : normal;
}

/// A cell of the grid in which unit normals lie.
using NormalCell = std::array<int, 3>;

/// Planes of one direction.
struct PlaneClass {
  IntegerNormal normal{};
  Vec3 unit;
  NormalCell cell{};
  double size = 0;  ///< length of `normal`
  /// An offset, normal · point, and the number of its place.
  struct Offset {
    std::int64_t offset = 0;
    int place = -1;
  };
  std::vector<Offset> offsets;  ///< ascending
};

/// A place for a polygon: a class, and a plane of it or a new offset.
struct PlaneFit {
  int normal_class = -1;
  bool is_known = false;
  std::int64_t offset = 0;
  double residual = 0;  ///< grid units
};

/// How far a polygon is from an offset, in lengths of the normal.
double residual_of(const OffsetSpan& span, std::int64_t offset);

/// The planes that polygons were put on so far: classes of one normal each, found by direction, and
/// their offsets.
class KnownPlanes {
 public:
  /// `angle_tolerance`: within it directions are one, in radians. `most`: no more places
  /// are made.
  KnownPlanes(double angle_tolerance, std::size_t most);

  /// A plane that polygons were put on.
  struct KnownPlane {
    int normal_class = -1;
    std::int64_t offset = 0;
  };
  [[nodiscard]] const std::vector<PlaneClass>& classes() const { return classes_; }
  [[nodiscard]] const std::vector<KnownPlane>& places() const { return places_; }
  [[nodiscard]] const PlaneClass& class_at(int place) const;

  /// The place of the first class with exactly that normal, at that offset; or -1.
  [[nodiscard]] int exact_place(const IntegerNormal& normal, std::int64_t offset) const;
  /// Classes whose normal may be within the tolerance of ±`u`.
  [[nodiscard]] std::vector<int> near_classes(Vec3 u) const;
  /// The place of a class that a polygon fits best, if it fits one within `tolerance` grid units.
  [[nodiscard]] std::optional<PlaneFit> known_fit(int normal_class, const OffsetSpan& span,
                                                  double tolerance) const;

  /// The number of a place; it is made if there is none yet.
  int number_of(int normal_class, std::int64_t offset);
  /// A new class; returns its number.
  int add_class(const IntegerNormal& normal);

 private:
  /// Keys for hashing.
  struct Hash {
    template <class Key>
    std::size_t operator()(const Key& key) const noexcept {
      std::uint64_t h = 0;
      for (const auto c : key) {
        h = (h ^ static_cast<std::uint64_t>(c)) * 0x9E3779B97F4A7C15ULL;
        h ^= h >> 32;
      }
      return h;
    }
  };
  [[nodiscard]] NormalCell cell_of(Vec3 u) const;

  double cell_size_;
  std::vector<PlaneClass> classes_;
  std::vector<KnownPlane> places_;
  std::unordered_map<NormalCell, std::vector<int>, Hash> cells_;  ///< classes by unit normal
  NumberTable exact_places_;
};

}  // namespace oriel::detail
