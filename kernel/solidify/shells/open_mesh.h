#pragma once

#include "kernel/solidify/shells/shell_mesh.h"
#include "kernel/solidify/soup/soup.h"

namespace oriel::detail {

/// The half-edges of polygons that need not close: never fails, and leaves open (twin -1) what does
/// not pair up. Every point is one vertex.
///
/// Polygons are turned round until neighbours agree; where they cannot, those between them stay
/// open. Each connected patch then looks away from the middle of the building if most of it does
/// so clearly, else as most of its polygons did. Where more than two polygons meet at an edge,
/// those that go on in one plane are paired. The soup's rings are turned round along.
ShellMesh build_open_mesh(Soup& soup);

}  // namespace oriel::detail
