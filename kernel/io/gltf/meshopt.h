#pragma once

#include <cstddef>
#include <string>
#include <string_view>

namespace oriel::detail {

/// Bytes of vertices, `stride` bytes each (a multiple of four, 256 at most), as the glTF extension
/// EXT_meshopt_compression has them in mode ATTRIBUTES, without a filter: decoders give back the
/// same bytes.
std::string meshopt_vertices(std::string_view bytes, std::size_t stride);

/// Numbers of vertices, of `stride` bytes each (2 or 4), in mode INDICES: decoders give back the
/// same bytes, which mode TRIANGLES does not promise.
std::string meshopt_indices(std::string_view bytes, std::size_t stride);

}  // namespace oriel::detail
