#pragma once

#include "kernel/base/issue.h"
#include "kernel/base/work.h"
#include "kernel/solidify/shells/shell_mesh.h"
#include "kernel/solidify/soup/soup.h"
#include "model/repair.h"
#include "model/tolerances.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel::detail {

/// A closed shell of all polygons of an open one, but for doubles, and of the faces that are
/// missing from it.
struct FilledShell {
  Soup soup;  ///< missing faces have no source: -1
  ShellMesh mesh;
  /// What was done. Nothing is dangling or inner; open edges are those that were filled.
  RepairReport report;
  /// E308 if polygons were turned round.
  std::vector<Issue> issues;
};

/// Fills the holes of a welded soup with the faces that are missing, if they close it and none of
/// them runs through another polygon or lies on one. Nothing once `work` is used up.
std::optional<FilledShell> fill_missing_faces(const Soup& welded, const std::string& building,
                                              const Tolerances& tolerances, Work& work);

}  // namespace oriel::detail
