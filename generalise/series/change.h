#pragma once

#include "model/scale_series.h"

#include <string>
#include <vector>

namespace oriel {

/// What turns `before` into `after`. A facet whose outer ring and meaning stay loses and gains
/// holes; else it is taken away and another one put there.
Change difference(const LevelState& before, const LevelState& after);

/// The facets and holes of a change, taken apart into changes that share no edge, in the order of
/// their smallest rings. If a closed solid becomes another one by the whole, it stays closed by any
/// of the parts: at every edge as many facets come as go. Installations and attributes are left
/// out.
std::vector<Change> parts_of(const Change& change);

/// `more` is added to `change`.
void unite(Change& change, Change more);

/// Changes the state; false if it does not have what is to be taken away, or has what is to be
/// added: then the state is of no use any more.
[[nodiscard]] bool apply(LevelState& state, const Change& change);

/// The box of all rings that a change takes away or adds, in the input's coordinates.
Box box_of(const Change& change);

}  // namespace oriel
