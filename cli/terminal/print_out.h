#pragma once

#include <string>

namespace oriel::cli {

/// Prints lines to stdout: for people printable_lines(), for programs (JSON) the bytes as they are,
/// for the format has escaped them.
void print_out(const std::string& text, bool is_for_programs = false);

}  // namespace oriel::cli
