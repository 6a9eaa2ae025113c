#pragma once

#include <string>
#include <vector>

namespace oriel::test {

/// Whether what was printed is what a page shows: there a line `…` stands for any number of lines,
/// `…` within a line for any characters. Spaces at the end of a line do not matter.
bool fits(const std::vector<std::string>& shown, const std::vector<std::string>& printed);

/// What the page is to show instead, so that it fits: lines that are alike stay where they were and
/// say what was printed, and `…` stays between them. If nothing is alike, the whole of it, a long
/// text without its middle.
std::vector<std::string> shown_again(const std::vector<std::string>& shown,
                                     const std::vector<std::string>& printed);

}  // namespace oriel::test
