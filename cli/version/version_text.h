#pragma once

#include <string>

namespace oriel::cli {

/// What `--version` prints, without an end of line: the version, the commit of the sources
/// ("unknown" if they are no git tree), the compiler, and the libraries that this program was built
/// with. Nothing of it but the version is in any output.
std::string version_text();

}  // namespace oriel::cli
