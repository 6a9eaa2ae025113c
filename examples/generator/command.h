#pragma once

#include <iosfwd>

namespace oriel::generator {

/// The program oriel-generate: reads its arguments, writes what they ask for (docs/generator.md),
/// says what went wrong on `err`. `out` takes help and, for "-o -", the stream. Returns the exit
/// code: 0, 1 for a fault of the generator, 2 for wrong arguments, 3 if no house has room for what
/// was to be added, 6 if the output could not be written.
int run_command(int argc, const char* const* argv, std::ostream& out, std::ostream& err);

}  // namespace oriel::generator
