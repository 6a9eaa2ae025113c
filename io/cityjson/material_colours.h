#pragma once

#include "io/document.h"
#include "kernel/mesh/mesh.h"

#include <optional>
#include <vector>

namespace oriel {

/// For each building of the document the colours that its polygons have by the materials of a
/// CityJSON file (`diffuseColor`, `transparency`), by Polygon::source; a list may be shorter than
/// the polygons. Of several themes it is `default-theme-material`, else the first. Nothing for
/// polygons without a material, for materials without a colour, and for documents that were not
/// read from CityJSON.
std::vector<FaceColours> material_colours(const Document& document);

}  // namespace oriel
