#pragma once

#include "oriel/experiments/part_runner.h"

namespace oriel {

/// `learn` on a set: what is learnt from the buildings outside each part of its split is measured
/// on that part, all parts together; with tables of what was learnt from all of them.
MeasuredPart run_learning(const SampleSet& set, const PartContext& context);

/// `learning_curve` on a set: for each part of its split params are learnt from so many of the
/// other buildings, which are drawn, and measured on the part.
MeasuredPart run_learning_curve(const SampleSet& set, const PartContext& context);

}  // namespace oriel
