#pragma once

#include "io/document.h"
#include "io/reader.h"
#include "kernel/base/issue.h"

#include <string>
#include <vector>

namespace oriel {

/// All records of a file (docs/formats.md lists the formats): of CityJSON, OBJ and OFF one, of a
/// CityJSONSeq one for each line, of CityGML one for the header and one for each Building. Records
/// that cannot be read are left out, and `issues` says why; there is no value if none could be
/// read. Throws InputError: E101 the file cannot be opened, E106 its format is unknown.
///
/// The whole file is held in memory. A Reader gives one record after the other.
Checked<std::vector<Document>> read(const std::string& path, const ReadOptions& options = {});

}  // namespace oriel
