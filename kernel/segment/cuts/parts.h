#pragma once

#include "kernel/segment/cuts/carve.h"
#include "kernel/segment/cuts/choice.h"
#include "kernel/segment/cuts/cut_candidates.h"

#include <cstddef>
#include <vector>

namespace oriel::detail {

/// Of each lump of a choice the last one that is the same pocket, moved: what becomes of
/// the one is known from the other. Itself, if there is none; nothing if that is not known of one.
std::vector<std::size_t> models_of(const Choice& choice);

/// A lump of a choice is a pocket that comes off without a body, as the leaf that it is. `models`:
/// those of the choice.
bool is_leaf(const Choice& choice, const Lump& lump, const std::vector<std::size_t>& models);

/// The vertices of a body, sorted.
std::vector<int> points_of(const Boundary& body);

/// What a cut that took a part off has changed of the rest.
/// `size`: about how many vertices the part has.
RestChange change_of(const Carved& carved, const std::vector<Cap>& caps, std::size_t size);

/// What filling a pocket has changed of the rest. `points`: the vertices of the pocket.
RestChange change_of_pocket(const Cap& cap, std::vector<int> points);

double area_of(World& world, const Cap& cap);

/// What a part's own body tells of it: adds to its surface, and sets its volume.
void measure(Feature& feature, const Boundary& body);

}  // namespace oriel::detail
