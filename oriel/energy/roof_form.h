#pragma once

#include "kernel/model/solid.h"
#include "oriel/energy.h"

#include <vector>

namespace oriel {

/// The form of the roof that these facets of a solid are: docs/energy.md#roof-form.
RoofForm roof_form_of(const Solid& solid, const std::vector<FacetId>& roof);

}  // namespace oriel
