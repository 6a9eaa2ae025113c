#pragma once

#include <string>
#include <string_view>

namespace oriel {

/// The bytes as a gzip archive (RFC 1952), as small as zlib makes it. It names no time, no file and
/// no system, so that the same bytes give the same archive. Throws std::bad_alloc.
std::string gzip(std::string_view bytes);

}  // namespace oriel
