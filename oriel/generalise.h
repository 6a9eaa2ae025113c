#pragma once

#include "generalise/city/city_groups.h"
#include "generalise/generalise.h"
#include "generalise/metrics/facade_quality.h"
#include "generalise/metrics/legibility.h"
#include "interpret/pack/rule_base.h"
#include "interpret/plan/profile.h"
#include "io/document.h"
#include "kernel/base/issue.h"
#include "oriel/label.h"
#include "oriel/result.h"
#include "oriel/write.h"

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oriel {

/// What is to be made of a building: redrawn for a scale, or at levels of detail.
struct Targets {
  /// The denominator of the scale, at least 1. Missing: levels of detail.
  std::optional<double> scale;
  /// One for each level of detail; for a scale at most one (load_profile_file).
  std::vector<Profile> profiles;

  [[nodiscard]] bool has_lods() const { return !scale; }
  /// All that the results depend on.
  [[nodiscard]] std::string recipe() const;
  /// "1:5000", "LoD 2.0, 1.2".
  [[nodiscard]] std::string text() const;
};

/// The target 1 : denominator, without profile.
Targets at_scale(double denominator);

/// How a building is generalised, and what is reported of it.
struct GeneraliseOptions : LabelOptions {
  bool reports_changes = false;  ///< TargetReport::changes
  bool reports_figures = false;  ///< TargetReport::figures
  /// Is asked often while a building is redrawn whether nobody waits for it any longer, with the
  /// stage that is at work: generalise while features are taken off or changed, write while it is
  /// checked as it will be written, solidify while it is repaired. Once it says so, generalise()
  /// soon ends with GeneralisedBuilding::is_given_up. Null: somebody waits.
  std::function<bool(Stage)> is_given_up{};
  /// With `neighbours`: rows and blocks of the city, which become one building each. Null: none do.
  std::shared_ptr<const CityGroups> groups{};
};

/// How well a building can be read, and how its openings stand to each other.
struct DrawingQuality {
  Legibility legibility;
  FacadeQuality facades;
};

/// Of the windows, doors and installations that are drawn with one label, how many get it again if
/// the drawing is labelled.
struct FoundAgain {
  int drawn = 0;
  int found = 0;
};

/// Figures of a building before and after (docs/generalisation.md#quality).
struct TargetFigures {
  /// The least length that the target shows.
  double least_edge_m = 0;
  /// The denominator of the scale; 0 for a level of detail.
  double map_scale = 0;
  SolidFigures before, after;
  double hausdorff_m = 0;
  DrawingQuality quality_before, quality_after;
  /// By label.
  std::map<std::string, FoundAgain> found_again;
};

/// What became of a building at one target.
struct TargetReport {
  /// "1:5000", "LoD 2.0".
  std::string target;
  /// One for each feature, if asked for.
  std::vector<FeatureOutcome> changes;
  /// If asked for, and the building could be drawn.
  std::optional<TargetFigures> figures;
};

/// A building generalised.
struct GeneralisedBuilding {
  /// Building::id.
  std::string building;
  /// One for each target, in their order; empty if the building was rejected.
  std::vector<Redrawn> levels;
  std::vector<TargetReport> reports;
  /// An error says that the building was rejected: G404 it is open, G402, G406, G410.
  std::vector<Issue> issues;
  /// What it was drawn from, if it was open (G420) or its own solid could not be written as a valid
  /// one (G417).
  std::shared_ptr<const PipelineResult> repaired{};
  /// It is one of a group that became one building (GeneraliseOptions::groups): it leads it, and
  /// its one level is the group's block, or it is gone from the file.
  bool leads_group = false, is_gone = false;
  /// Nobody waited for it any longer (GeneraliseOptions::is_given_up): there is nothing else in it.
  bool is_given_up = false;
};

/// Generalises a building for each of the targets: a closed solid with what the target can show
/// (docs/generalisation.md; paper, section 5).
///
/// `building` is one of the document; `result` is what label() said of it with the same rules and
/// options. Of a building that did not come to its features nothing is made; an open one is
/// repaired first as repair() does it (G420). Installations that were joined to it (ReadOptions)
/// stay as they are: the building alone is labelled again and redrawn.
///
/// A building that is one of a group is not drawn: the one that leads it gets the group's block,
/// the others leave, whatever became of them in `result`; notes G421 to G423 and a warning G422 say
/// so.
///
/// The solids are valid as they are written: where one is not, the building is drawn again with
/// each step checked, then from a repaired solid (G417), then without outlines of imprints that are
/// in the way (G410 of the feature). What is valid at no scale stays unchanged, levels of detail
/// are rejected (G410); what was not valid when it was read is rejected (G413). Throws
/// GeometryError for a fault of oriel's own.
GeneralisedBuilding generalise(const Document& document, const Building& building,
                               const PipelineResult& result, const RuleBase& rules,
                               const Targets& targets, const GeneraliseOptions& options = {});

/// Adds a generalised building to what is written of its record. Of several levels of detail the
/// first says what is gone from the building; an installation leaves the file if no level has it.
void add(GeneralisedBuilding building, OutputRecord& output);

/// An error E359 for each part of a building that overlaps an earlier one of its family in what is
/// written of a record, all of it added: redrawn solids as they are read again, and valid solids
/// that stay.
std::vector<Issue> overlaps_as_written(const Document& document, const OutputRecord& output);

}  // namespace oriel
