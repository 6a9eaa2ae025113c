#pragma once

#include "kernel/segment/sections/section.h"

namespace oriel::detail {

/// Where no vertex lies between two planes of a class, the section just in front of the one and
/// that just behind the other have the same chords and differ in size only. So of `section`, which
/// all living edges of its gap cross (section_at), it is known what it is at the other end of the
/// gap, at `plane`: the area by which the smallest region there is too large to be cut, infinite if
/// nothing could be. At most 0: not known, or something may be cut.
double margin_across_gap(const Boundary& body, const Section& section, int plane);

}  // namespace oriel::detail
