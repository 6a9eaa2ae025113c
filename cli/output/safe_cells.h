#pragma once

#include <string>
#include <string_view>

namespace oriel::cli {

/// Lines of CSV (RFC 4180) as a spreadsheet may open them (OWASP, "CSV Injection"): a cell that
/// begins with = + - @, a tab, CR or LF, or with one of the first four in full width, which a
/// spreadsheet may run as a formula, gets a ' before it and stands in quotes. Numbers such as -1.5
/// and lists of them stay as they are. Cells with a ; or a tab stand in quotes, so that a
/// spreadsheet that parts cells at these finds no formula behind one. What is read back has the '
/// in it.
std::string with_safe_cells(std::string_view csv);

}  // namespace oriel::cli
