#pragma once

#include "interpret/pack/rule_base.h"
#include "io/document.h"
#include "model/building.h"
#include "model/labelled_building.h"
#include "oriel/generalise.h"
#include "oriel/result.h"

namespace oriel {

/// Of a building as it was read, all but FoundAgain.
DrawingQuality quality_before(const Building& building, const PipelineResult& result,
                              const RuleBase& rules, const LabelOptions& options, double least_m);

/// Of what is drawn in its place, which has a geometry: it is labelled as it will be read again, by
/// the same rules, alone (without LabelOptions::neighbours and corrections). Sets `again`.
DrawingQuality quality_after(const Document& document, const Building& building,
                             const LabelledBuilding& drawn, const RuleBase& rules,
                             const LabelOptions& options, double least_m,
                             std::map<std::string, FoundAgain>& again);

}  // namespace oriel
