#pragma once

#include "kernel/solidify/soup/soup.h"

namespace oriel::detail {

/// For each polygon 1 if an earlier one of the same body has the same rings, either way round. Of
/// equal polygons the first in the soup's order is no duplicate.
std::vector<char> find_duplicates(const Soup& soup);

/// The soup without duplicates. Adds their sources, sorted.
Soup without_duplicates(const Soup& soup, std::vector<int>& duplicates);

/// For each polygon 1 if another one of the same body has the same rings the other way round: they
/// go in pairs, what is left of equal polygons runs one way.
std::vector<char> find_opposites(const Soup& soup);

}  // namespace oriel::detail
