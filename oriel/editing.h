#pragma once

/// What an editor asks of the text of a rule pack while it is written: completion, what a word
/// means, where it is stated, other names for it, findings with changes that mend them, an outline,
/// canonical form (EditedPack). Places in the text are byte offsets; TextPlaces converts them to
/// lines and columns.
#include "interpret/editing/edited_pack.h"  // IWYU pragma: export
#include "interpret/editing/text_places.h"  // IWYU pragma: export
