#pragma once

#include "kernel/validate/defects.h"
#include "kernel/validate/polygons/polygon_checks.h"

#include <span>
#include <vector>

namespace oriel::detail {

/// A polygon of a shell, and what it was judged to be.
struct ShellPolygon {
  const SnappedPolygon* polygon = nullptr;
  std::vector<std::array<int, 3>> triangles;
};

/// The polygons of a shell, all good.
struct JudgedShell {
  int body = 0;
  int shell = 0;
  std::vector<ShellPolygon> polygons;
};

/// Judges a shell: val3dity 301, then 303 and 307 at edges, 303 at vertices, 305, 302, 303 at
/// diagonals, 306; the first of these that fails ends it. A surface that `may_be_open` is not
/// judged for 301 and 302.
bool judge(const SnappedBuilding& building, const JudgedShell& shell, bool may_be_open,
           FindingList& findings);

}  // namespace oriel::detail
