#pragma once

#include <nlohmann/json.hpp>

namespace oriel::studio {

/// JSON whose members stay in the order in which they are added.
using JsonValue = nlohmann::ordered_json;

}  // namespace oriel::studio
