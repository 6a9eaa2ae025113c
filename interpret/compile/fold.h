#pragma once

#include "interpret/pack/pack.h"

#include <optional>

namespace oriel::rules {

/// The value of a constant number at the params' values: NaN if it has none (0 / 0). Nothing if it
/// depends on a feature, or on the map's scale and no `scale` is given.
std::optional<double> fold(const Pack& pack, ExprId expr, std::optional<double> scale = {});

}  // namespace oriel::rules
