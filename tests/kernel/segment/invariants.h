#pragma once

#include "tests/support/segmented.h"

namespace oriel::test {

/// How exact the body is whose segmentation is checked.
struct Exactness {
  double area_rel = 1e-9;
  /// How far vertices may lie from their planes: those of valence above three which are rounded.
  double planarity_m = 1e-6;
  int samples = 200;
  /// False for surveyed models: cells may be slivers that the tolerances turn inside out.
  bool has_sound_cells = true;
};

/// Everything that holds for every segmentation, whatever the body and the order: see segment().
void check_segmentation(const Segmented& s, const Exactness& exactness = {});

/// The balanced tree, and what merging touching parts makes of it, are the same body with no more
/// levels. Returns how many merges there were.
std::size_t check_balanced(const Segmentation& segmentation);

}  // namespace oriel::test
