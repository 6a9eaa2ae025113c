#pragma once

#include "io/gltf/flat_mesh.h"

#include <string>
#include <string_view>

namespace oriel::detail {

/// A mesh as bytes of this program's own, there and back. `flat_mesh_of` throws std::runtime_error
/// for bytes that are no mesh.
std::string to_bytes(const FlatMesh& mesh);
FlatMesh flat_mesh_of(std::string_view bytes);

}  // namespace oriel::detail
