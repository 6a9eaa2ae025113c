#pragma once

#include "examples/generator/english/english_plan.h"
#include "examples/generator/house/house.h"

namespace oriel::generator {

/// The bare row: walls and roof, and what the roof offers to party walls.
struct EnglishShell {
  House house;
  /// Inner face of the parapet before a town roof; kNewFacet if there is none.
  FacetId parapet = kNewFacet;
};

EnglishShell build_english_shell(Draft& draft, const EnglishPlan& plan);

}  // namespace oriel::generator
