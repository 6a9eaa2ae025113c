#pragma once

#include <optional>
#include <string>

namespace oriel::rules {

/// The bytes of a file, at most one more than a pack may have; nothing if it cannot be read.
std::optional<std::string> read_file(const std::string& path);

}  // namespace oriel::rules
