#pragma once

#include <array>
#include <optional>
#include <string_view>

namespace oriel::detail {

/// The character of each byte of an encoding, as Unicode numbers it; -1 for a byte that has none.
using ByteTable = std::array<int, 256>;

/// The characters of an encoding of one byte a character beyond those that Expat reads itself
/// (UTF-8, UTF-16, ISO-8859-1, US-ASCII): windows-1252 (also cp1252) and ISO-8859-15 (also
/// latin-9), and latin1, l1, cp819 for ISO-8859-1. Upper and lower case, '-' and '_' are the same
/// (IANA's names and aliases). Nothing for any other.
std::optional<ByteTable> byte_table_of(std::string_view encoding);

}  // namespace oriel::detail
