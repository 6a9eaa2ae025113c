#include "kernel/validate/validate.h"
#include "oriel/segment.h"
#include "tests/fuzz/support/bodies.h"
#include "tests/fuzz/support/nef.h"
#include "tests/fuzz/support/promises.h"
#include "tests/fuzz/support/retold.h"
#include "tests/fuzz/targets.h"
#include "tests/support/changed.h"

#include <algorithm>
#include <cmath>

namespace oriel::fuzz {

namespace {

PipelineResult segmented(const Building& building, Order order) {
  PipelineOptions options;
  options.order = order;
  PipelineResult result = oriel::segment(building, options);
  promise_no_fault(result.issues);
  promise(result.is_done() || has_errors(result.issues), "features or an error");
  return result;
}

/// The cells with their signs are the solid, in either order of cuts; of solids that do not run
/// through themselves.
void check_rebuilt(const PipelineResult& result) {
  if (!result.is_done() || result.is_open()) return;
  double sum = 0, size = 0;
  for (const Cell& cell : result.segmentation->cells) {
    sum += cell.sign * cell.volume_m3;
    size += std::abs(cell.volume_m3);
  }
  constexpr double kRounding = 1e-9;
  promise(std::abs(sum - volume_m3(*result.solid)) <= kRounding * size,
          "cells with their signs have the volume of the solid");
  const TreeComparison trees = compare_trees(result);
  promise(trees.is_same_body(), "balanced and merged trees are the same body");
  (void)cell_complex(result);
}

/// What must be the same however an exact body is told: how many leaves, and of each sense how many
/// features with which volume.
void check_same_tree(const PipelineResult& result, const Building& other, const char* how) {
  const PipelineResult again = segmented(other, Order::natural);
  promise(again.is_done(), "a valid body told differently is segmented", how);
  promise(again.segmentation->features.size() == result.segmentation->features.size(),
          "a valid body told differently has as many features", how);
}

}  // namespace

/// Segmentation in both orders, description included. Turning, moving and shuffling must change no
/// number of features on bodies that are valid and exact.
void trees(std::string_view input) {
  ByteSource bytes(input);
  const Body body = changed_body(bytes);
  const PipelineResult natural = segmented(body.building, Order::natural);
  const PipelineResult paper = segmented(body.building, Order::paper);
  ValidateOptions as_solid;
  as_solid.primitive = ValidateOptions::Primitive::solid;
  if (validate(body.building, as_solid).empty()) {
    check_rebuilt(natural);
    check_rebuilt(paper);
  }
  if (!body.is_valid) return;
  promise(natural.is_done() && !natural.is_open(), "a valid body is segmented");
  for (const PipelineResult* result : {&natural, &paper})
    promise(is_solid_by_nef(*result->segmentation, *result->solid).value_or(true),
            "the tree is the solid to another judge");
  check_same_tree(natural, turned_by_right_angle(body.building), "turned");
  check_same_tree(natural, moved_by_metres(body.building), "moved");
  check_same_tree(natural, test::shuffled(body.building, 1), "shuffled");
}

}  // namespace oriel::fuzz
