#pragma once

#include "cli/terminal/report.h"
#include "generalise/invariants/invariants.h"
#include "interpret/pack/rule_base.h"
#include "interpret/plan/profile.h"
#include "kernel/io/document.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel::cli {

/// What is to be made of every building: redrawn for a scale, or at levels of detail.
struct Targets {
  std::optional<double> scale;
  /// One for each level of detail; for a scale at most one.
  std::vector<Profile> profiles;

  [[nodiscard]] bool has_lods() const { return !scale; }
  /// All that the products depend on.
  [[nodiscard]] std::string recipe() const;
  /// "1:5000", "LoD 2.0, 1.2".
  [[nodiscard]] std::string text() const;
};

/// What the options of a command ask for.
struct TargetArguments {
  bool has_scale = false;
  std::string scale;
  std::vector<std::string> lods;
  std::string profile;
  double edge_min_m = 0;  ///< 0: what the profile says
};

/// What --scale or else --to-lod asks for, with --profile; with neither of them the level of the
/// profile. Nothing if a profile cannot be used, which is told. Throws CLI::ValidationError for a
/// scale or level that is none.
std::optional<Targets> targets_of(const TargetArguments& arguments, const RuleBase& rules,
                                  Report& report);

/// The least length that a target shows: the profile's, or its c, else 0.125 mm on the map.
double least_edge_m(const Profile* profile, std::optional<double> scale);

/// What must not change at a target, by the profile and the pack; without a validator and party
/// walls.
Invariants invariants_of(const Profile* profile, const RuleBase& rules,
                         std::optional<double> scale);

/// The same of a building, with the walls of the document's other buildings that it stands against
/// if they matter.
Invariants beside_others(Invariants invariants, const Document& document, const Building& building,
                         const Solid& solid);

}  // namespace oriel::cli
