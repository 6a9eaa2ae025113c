#pragma once

#include "kernel/base/issue.h"
#include "model/solid.h"

#include <span>
#include <string>
#include <vector>

namespace oriel {

/// What the input says of a connected component of facets.
struct ComponentHint {
  /// Which solid of the input it belongs to.
  int body = 0;
  /// Exterior (0) or interior (> 0) shell of that solid; -1 if the input does not say.
  int shell = -1;
};

/// Orders the loops of every facet (outer loop first), turns every shell so that outer shells
/// enclose volume and cavities exclude it, and assigns cavities to lumps: fills Solid::shells. A
/// component that is turned round is a warning (E308); one without volume an error (E310, val3dity
/// 401…405 have none that fits); a cavity outside every lump of its body an error (E305, val3dity
/// 403).
void arrange_shells(Solid& solid, std::span<const int> component,
                    std::span<const ComponentHint> hints, const std::string& building,
                    std::vector<Issue>& issues);

/// Drops planes without a facet and sorts the others and the loops, as a Solid has them.
void arrange_planes_and_loops(Solid& solid);

}  // namespace oriel
