#pragma once

#include <string>

namespace oriel::cli {

/// What `--version` prints, without an end of line: the version, the commit of the sources
/// ("unknown" if they are no git tree), the compiler, and the libraries that this program was built
/// with. Nothing of it but the version is in any output but reports of experiments.
std::string version_text();

/// Of it "oriel 0.1.0 (commit 0123456789ab)".
std::string program_name();

}  // namespace oriel::cli
