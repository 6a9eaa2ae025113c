#pragma once

#include "kernel/base/issue.h"
#include "kernel/io/tiles/earth.h"
#include "kernel/io/tiles/tile_building.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel::detail {

/// Where a tileset stands: a frame in whose middle it is, east, north and up.
class TilesetFrame {
 public:
  /// For buildings at these places. `crs` as TilesetOptions has it. No value: E160, E163.
  static Checked<TilesetFrame> of(const std::vector<const TileEntry*>& entries,
                                  const std::string& crs);

  /// From the frame to the earth, or to the coordinates of the input.
  [[nodiscard]] const Placement& placement() const { return placement_; }
  /// From the frame of a building to this one; nothing if the earth has no such place.
  [[nodiscard]] std::optional<Placement> placement_of(const TileEntry& entry) const;

 private:
  [[nodiscard]] std::optional<Vec3> local(Vec3 point) const;

  std::optional<Earth> earth_;
  Placement placement_;
};

}  // namespace oriel::detail
