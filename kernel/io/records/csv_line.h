#pragma once

#include <string>
#include <vector>

namespace oriel {

/// Appends a line of CSV (RFC 4180) with an LF at its end: cells with commas, quotes or line ends
/// stand in quotes.
void append_csv_line(std::string& out, const std::vector<std::string>& cells);

}  // namespace oriel
