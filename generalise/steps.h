#pragma once

#include "generalise/carry_out.h"

namespace oriel::detail {

/// Carries out steps without looking at invariants: first all features of all steps are taken off
/// at once, then those operators that leave something put it in their place, in the order of the
/// features; what moves facets (flatten) and outlines last. What cannot be taken off (G401) or put
/// back (G403) is left as it was, and the rest is done anew without it: no feature is ever half
/// changed. Steps for groups are carried out together or not at all. `judge` as omit() takes it.
CarriedOut carry_out_steps(const Solid& solid, const Segmentation& segmentation, const Plan& plan,
                           const SegmentOptions& options, const Judge& judge);

}  // namespace oriel::detail
