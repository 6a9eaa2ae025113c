#pragma once

#include <string>

namespace oriel::cli {

/// Prints lines to stdout: for people printable_lines(), for programs (JSON, packs) the bytes as
/// they are, unless stdout is a terminal: that shows printable_lines() of everything.
void print_out(const std::string& text, bool is_for_programs = false);

/// The errno of the first print_out() of which not all arrived, 0 if there was none.
int print_failure();

}  // namespace oriel::cli
