#pragma once

#include "kernel/base/index.h"
#include "kernel/segment/sections/section.h"

namespace oriel::detail {

/// Visits the crossings of a loop in their order.
template <class Visit>
void for_each_crossing(const Section& section, int loop, Visit visit) {
  const int first = section.loops[at(loop)].first;
  int c = first;
  do {
    visit(section.crossings[at(c)]);
    c = section.crossings[at(c)].next;
  } while (c != first);
}

/// Makes the regions of a section of its loops, which do not cross. Loops nest by turns: around
/// material, around air in it, around material in that. Each loop belongs to the region inside it
/// and is a hole in the region that its parent bounds. `axis`: the plane's normal.
void nest_loops(Section& section, Vec3 axis);

}  // namespace oriel::detail
