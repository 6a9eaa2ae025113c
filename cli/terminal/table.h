#pragma once

#include <string>
#include <vector>

namespace oriel::cli {

/// Rows of texts in columns, the first row as a head; numbers to the right. The texts are made
/// printable().
std::string table(std::vector<std::vector<std::string>> rows);

}  // namespace oriel::cli
