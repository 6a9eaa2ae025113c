#pragma once

#include "kernel/geometry/box_tree.h"
#include "kernel/neighbours/footprint_union.h"
#include "model/vec3.h"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace oriel {

/// Ground that no block may cover, such as roads and parcels, in the coordinates of the input.
class KeptGround {
 public:
  /// Before finish(): an area, outer outline counter-clockwise, holes clockwise, z = 0.
  void add(detail::PlanArea area);
  /// All were added; then several threads may ask.
  void finish();

  [[nodiscard]] bool is_empty() const { return areas_.empty(); }
  /// Around all of it.
  [[nodiscard]] const Box& box() const { return box_; }
  /// All that results depend on, as hexadecimal SHA-256.
  [[nodiscard]] const std::string& sha256() const { return sha256_; }

  /// How much of it a figure of the plan, outlines as of add(), covers, m2: the figure's own frame
  /// has its origin at `origin_m`.
  [[nodiscard]] double under_m2(std::span<const Outline> figure, Vec3 origin_m) const;

 private:
  std::vector<detail::PlanArea> areas_;
  std::optional<BoxTree> tree_;
  Box box_;
  std::string sha256_;
};

}  // namespace oriel
