#pragma once

#include "kernel/io/gltf/flat_mesh.h"
#include "kernel/io/gltf/glb_buffers.h"

#include <set>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace oriel::detail {

/// The extension EXT_structural_metadata of a file: the schema, and the table of the features,
/// whose columns go to `buffers`. The enumerations name `labels` and `surfaces`, which have all of
/// the features.
nlohmann::ordered_json structural_metadata(const std::vector<FlatFeature>& features,
                                           const std::set<std::string>& labels,
                                           const std::set<std::string>& surfaces,
                                           GlbBuffers& buffers);

}  // namespace oriel::detail
