#pragma once

/// Rule-based interpretation of 3D buildings: read → label → generalise / series / repair → write,
/// each one function, and what is asked of the results: explain, score, validate. docs/library.md
/// shows them at work.

// From solids to half-edge meshes and back, and what is measured on meshes.
#include "kernel/mesh/collapse.h"  // IWYU pragma: export
#include "kernel/mesh/measures.h"  // IWYU pragma: export
#include "kernel/mesh/mesh.h"      // IWYU pragma: export
#include "oriel/corrections.h"     // IWYU pragma: export
#include "oriel/energy.h"          // IWYU pragma: export
#include "oriel/explain.h"         // IWYU pragma: export
#include "oriel/generalise.h"      // IWYU pragma: export
#include "oriel/interpret.h"       // IWYU pragma: export
#include "oriel/label.h"           // IWYU pragma: export
#include "oriel/learn.h"           // IWYU pragma: export
#include "oriel/neighbours.h"      // IWYU pragma: export
#include "oriel/options.h"         // IWYU pragma: export
#include "oriel/paper_count.h"     // IWYU pragma: export
#include "oriel/picture.h"         // IWYU pragma: export
#include "oriel/read.h"            // IWYU pragma: export
#include "oriel/repair.h"          // IWYU pragma: export
#include "oriel/result.h"          // IWYU pragma: export
#include "oriel/rules.h"           // IWYU pragma: export
#include "oriel/score.h"           // IWYU pragma: export
#include "oriel/segment.h"         // IWYU pragma: export
#include "oriel/series.h"          // IWYU pragma: export
#include "oriel/stage.h"           // IWYU pragma: export
#include "oriel/stored_samples.h"  // IWYU pragma: export
#include "oriel/tiles.h"           // IWYU pragma: export
#include "oriel/validate.h"        // IWYU pragma: export
#include "oriel/write.h"           // IWYU pragma: export
