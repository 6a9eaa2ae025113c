#pragma once

#include "model/building.h"
#include "tests/fuzz/support/byte_source.h"

namespace oriel::fuzz {

/// Changes a building in one of the ways in which published ones are wrong: a corner moved far, a
/// little or out of its plane, corners made one, a polygon left out, doubled, turned round or cut
/// in two, a corner put into an edge of one of its polygons only, noise, a second body that
/// touches, overlaps or equals the first, a shell inside, an inner ring, a ring that crosses
/// itself, a ring, a polygon, a shell or a solid without anything in it. Polygons stay above 0, of
/// one ring or more; rings that are not empty have three corners or more.
void mutate(Building& building, ByteSource& bytes);

}  // namespace oriel::fuzz
