#pragma once

#include "io/document.h"
#include "io/files/format.h"
#include "kernel/base/issue.h"

#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// A record as CityGML 2.0 or 3.0 (`format`). `text` is what write_cityjson() made of `document`,
/// with its labels. What several records give, one behind the other and with citygml_end() behind
/// the last, is a file: a whole file, and the header of a stream, gives the start of a CityModel
/// and its buildings, a line of a stream its building. Of one record nothing depends on another.
///
/// - Buildings with their parts, installations and (3.0) constructive elements; in 2.0 the latter
///   are installations. Other objects are left out, and `issues` gets a warning E168.
/// - Openings lie in the surface that they have as parent, and in a WallSurface without polygons
///   where they have none. Polygons of surfaces that are neither a boundary surface of CityGML nor
///   an opening are written without them.
/// - With `closes_installations` an installation that shares polygons of its building's solid is a
///   solid of its own where plane faces can close both; else `issues` gets a warning E166.
/// - A polygon is written once; solids, and installations that share polygons of their building,
///   link to it.
/// - Levels are those of CityGML, 0 to 3: of several geometries of one level (2.1 and 2.2) the one
///   that oriel has named surfaces of is written, else the finest. In 2.0, openings are of level 3
///   and up: a building that has some at level 2, and nothing at level 3, is written at level 3;
///   where level 3 is taken, openings of level 2 are part of their surface. 2.0 has no surfaces at
///   levels 0 and 1, and installations from level 2 on.
/// - A MultiSolid becomes a CompositeSolid: a solid property allows no other geometry of several.
/// - Attributes have their elements where there is one, and are generic attributes otherwise.
/// - Ids that no gml:id can be are written by other characters, and read back by oriel as they
/// were.
std::string citygml_text(std::string_view text, const Document& document, Format format,
                         bool closes_installations, std::vector<Issue>& issues);

/// What stands behind the last record.
std::string citygml_end();

}  // namespace oriel
