#pragma once

#include "kernel/base/issue.h"

namespace oriel::cli {

/// The same issue about a file that cannot be read or written (E101, E106, E601), with what helps:
/// the file with a name like it, the folder that is missing, the command or option that takes such
/// a file. Other issues stay as they are.
Issue with_file_advice(Issue issue);

}  // namespace oriel::cli
