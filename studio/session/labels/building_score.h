#pragma once

#include "oriel/corrections.h"
#include "oriel/score.h"
#include "studio/session/open_buildings.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace oriel::studio {

/// What people and files say of the buildings; it never changes.
struct TruthOfSession {
  /// Counts up whenever it becomes another one.
  std::uint64_t number = 0;
  Corrections corrections;

  /// The true objects of a building, those of corrections among them; nothing if nobody says
  /// anything of it.
  [[nodiscard]] std::optional<std::vector<ExpectedObject>> of(const OpenBuilding& building) const;
};

/// One comparison of a label with the truth.
struct ComparedFeature {
  /// Names of classes; "-" stands for nothing there, nothing found.
  std::string truth;
  std::string label;
  /// -1: no feature is there.
  int feature = -1;
  /// The id of the true object that was not found; else empty.
  std::string object;
};

/// How well one building is labelled.
struct BuildingScore {
  Score score;
  std::vector<ComparedFeature> compared;
  /// By rule, how many of its labels are right and wrong.
  std::map<std::string, std::pair<std::size_t, std::size_t>> rules;
};

/// Compares labels with the truth as score() does.
BuildingScore score_building(const OpenBuilding& building, const Interpretation& interpretation,
                             const std::vector<ExpectedObject>& truth);

}  // namespace oriel::studio
