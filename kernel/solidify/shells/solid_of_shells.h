#pragma once

#include "kernel/base/work.h"
#include "kernel/solidify/shells/shell_mesh.h"
#include "kernel/solidify/solidify.h"
#include "kernel/solidify/soup/soup.h"
#include "model/building.h"
#include "model/tolerances.h"

namespace oriel::detail {

/// Fills the solid that closed shells bound, or adds an error: planes, facets, vertices where the
/// planes meet, shells. `mesh` is that of the soup and closed.
/// `keeps_caps_apart`: RepairOptions.
void add_solid(const Building& building, const Soup& soup, const ShellMesh& mesh,
               const Tolerances& tolerances, Solidified& out, Work& work,
               bool keeps_caps_apart = false);

}  // namespace oriel::detail
