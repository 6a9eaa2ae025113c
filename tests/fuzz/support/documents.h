#pragma once

#include "io/files/format.h"
#include "tests/fuzz/support/scratch_file.h"

#include <string_view>

namespace oriel::fuzz {

/// Reads a file of that format with these bytes to its end, and writes every record with labels and
/// as meshes. Promises: a record has a value or an error, and what write_cityjson() made of it can
/// be read again, with as many buildings, and written again is the same bytes.
void read_and_write(const ScratchFile& file, Format format, std::string_view bytes);

}  // namespace oriel::fuzz
