#pragma once

#include "generalise/generalise.h"
#include "interpret/plan/profile.h"
#include "kernel/base/work.h"
#include "model/tolerances.h"
#include "model/vec3.h"

#include <functional>

namespace oriel {

/// What a building is at a level of detail: what `generalised` left of it, in the form that the
/// profile asks for, to be written with the profile's level.
///
/// As it is: redraw(), with the whole geometry drawn anew. As blocks: kernel/blocks/blocks.h of the
/// solid; each facet is a semantic surface RoofSurface, WallSurface or GroundSurface, and no
/// installation is left. `may_cover` and `is_shared`, of one block: BlockOptions. Note G407 if
/// blocks had to be simpler than asked for, G406 (error) and no value if there are none, or if
/// `work` is used up.
Checked<Redrawn> to_lod(const RedrawContext& context, const Profile& profile,
                        Generalised generalised, Work& work,
                        std::function<bool(const Box& gained)> may_cover = {},
                        std::function<bool(Vec3 from, Vec3 to)> is_shared = {});

}  // namespace oriel
