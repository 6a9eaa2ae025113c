#pragma once

#include "generalise/operators/host.h"
#include "kernel/model/plan.h"
#include "kernel/model/segmentation.h"
#include "kernel/model/solid.h"

#include <vector>

namespace oriel {

/// What an operator that redraws features works on: the solid from which they were taken off
/// already, and the steps for them, which have one rule and so the same arguments. Groups
/// (aggregate, typify) have all members, ordered along their wall; other operators have one step.
struct Redrawing {
  const Solid& solid;
  const Segmentation& segmentation;
  std::vector<Step> steps;
  double scale = 0;

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
  /// The host of a member on the solid as it is.
  [[nodiscard]] std::optional<detail::Host> host(std::size_t member = 0) const {
    const Feature& f = feature(member);
    if (f.planes.empty()) return std::nullopt;
    return detail::host_at(solid, segmentation.planes[f.planes[0].index()], f.cap_point);
  }
};

}  // namespace oriel
