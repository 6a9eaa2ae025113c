#pragma once

#include "generalise/context.h"
#include "generalise/operators/host.h"
#include "interpret/plan/operators.h"
#include "kernel/segment/remove.h"
#include "model/plan.h"
#include "model/segmentation.h"
#include "model/solid.h"

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

// The operators that a pack can ask for. Each is one function, a row in the table of
// interpret/plan/operators.h, and a section in docs/generalisation.md.

namespace oriel {

/// What an operator that redraws features works on: the solid from which they were taken off
/// already, and the steps for them, which have one rule and so the same arguments. Groups
/// (aggregate, typify) have all members, ordered along their wall; those of which some may stay
/// (OperatorScope::wall) have all of one wall plane; other operators have one step.
struct Redrawing {
  const Solid& solid;
  const Segmentation& segmentation;
  std::vector<Step> steps;
  double scale = 0;
  /// Of a refusal it is to be told what would let the operator act (Placed::LeftMember::hindrance).
  bool tells_needs = false;

  [[nodiscard]] const Feature& feature(std::size_t member = 0) const {
    return segmentation.features[steps[member].feature.index()];
  }
  /// An argument in metres or a ratio; `fallback` if the pack does not say.
  [[nodiscard]] double number(const char* name, double fallback) const {
    const auto found = steps[0].numbers.find(name);
    return found == steps[0].numbers.end() ? fallback : found->second;
  }
  [[nodiscard]] std::string word(const char* name, const char* fallback) const {
    const auto found = steps[0].words.find(name);
    return found == steps[0].words.end() ? fallback : found->second;
  }
  /// The least distance to what is beside, unless the pack says `gap`.
  [[nodiscard]] double gap_m() const { return number("gap", kGapOnMap_m * scale); }
  /// The least size, unless the pack says `to`.
  [[nodiscard]] double to_m() const { return number("to", kToOnMap_m * scale); }
  /// The host of a member on the solid as it is; what stood on something that belongs to it, such
  /// as its frame, is on what that stood on.
  [[nodiscard]] std::optional<detail::Host> host(std::size_t member = 0) const;
};

/// The operator `omit`: features leave the building (paper 5.1, "omission").
///
/// Precondition: the feature's cut can be made again on the solid, and takes no feature along that
/// is to stay; of a building no part of more than half its volume goes: which of two parts is the
/// feature and which the rest is up to the segmentation (under a roof that juts out all around, the
/// walls are a feature of the roof). Touches: the cells of the feature and of all that sits on it;
/// of the rest, the facets of its split planes. Inverse: the solid before, which the caller still
/// has; the removed cells stand in the segmentation. A feature that cannot be omitted is refused
/// with its reason and stays whole. With a judge, features without a cut of their own go as cells
/// (remove_cells).
Remainder omit(const RedrawContext& context, const Plan& plan);

/// True of `{aggregate: {into: block}}`, which is for single features.
bool becomes_block(const Step& step);

/// How many of n stay.
std::size_t typified_count(std::size_t n, double ratio);

/// Each draws what takes the place of features that were taken off; what it asks for, touches and
/// refuses stands at its definition.
#define ORIEL_DECLARE(name, ...) detail::Placed name(const Redrawing& task);
ORIEL_OPERATORS(ORIEL_DECLARE)
#undef ORIEL_DECLARE

/// What carrying out a plan has to know of an operator.
struct Operator {
  std::string_view name;
  detail::Placed (*redraw)(const Redrawing&);  ///< null: features only leave (omit)
  OperatorScope scope;
  OperatorTurn turn;
};

/// Throws std::out_of_range if there is none: loading a pack checks the names.
const Operator& operator_named(std::string_view name);

}  // namespace oriel
