#pragma once

#include "interpret/labelling/corrections.h"
#include "interpret/pack/rule_base.h"
#include "interpret/surfaces/untyped.h"  // IWYU pragma: export
#include "model/building.h"
#include "model/labelled_building.h"
#include "oriel/options.h"
#include "oriel/result.h"

#include <memory>
#include <string>

namespace oriel {

/// How a building is labelled and what is written of it.
struct LabelOptions : PipelineOptions {
  /// Which codes installations get, one of RuleBase::codelists().
  std::string codelist = "sig3d";
  /// Every surface and installation gets its reason in one line, `oriel_why`.
  bool has_reasons = false;
  /// All attributes of all surfaces are measured. False: only what naming them needs.
  bool measures_surfaces = false;
  /// All attributes and relations of features are measured. False: only what the rules read, which
  /// is enough for labels, but not for records of features.
  bool measures_features = true;
  /// PipelineResult::output is made. False: it stays empty, and annotate() makes it later if it is
  /// needed; report_untyped() then says which labels have no type there.
  bool has_output = true;
  /// What people say that features are, against the rules: their verdicts are corrected, other
  /// features keep theirs. Null: nobody says anything.
  std::shared_ptr<const Corrections> corrections;
  /// The buildings of the city, so that it is known what stands beside this one: its features and
  /// surfaces then have the attributes `party_wall`, `exposed`, `faces_street` and `faces_yard`,
  /// and what is written names its neighbours. Null: nothing is known. It is finished.
  std::shared_ptr<const NeighbourSearch> neighbours{};
};

/// All that a result depends on besides input and rules, with the corrections.
std::string configuration(const LabelOptions& options);

/// Names the features and the surfaces of a building by the rules of a pack (load_pack_file).
///
/// It does what segment() does, then runs the rules over the features (docs/rules.md) and names the
/// surfaces. `interpretation.verdicts` has one verdict for each feature; a label that is empty
/// means "unknown". Each class without `emit:`, whose features have no type in `output`, is a
/// warning R258 (report_untyped). Never throws: a fault of oriel's own is an error E901 of the
/// building. The result depends on the building, the pack and the options only: the command gives
/// the same bytes. What write() makes of it gets the same labels again if the semantics that it has
/// now are left aside (PipelineOptions::ignores_semantics): names of surfaces delimit imprints.
PipelineResult label(const Building& building, const RuleBase& rules,
                     const LabelOptions& options = {});

/// The same of a building of which segment() with the same options gave `segmented`: nothing is
/// segmented or measured again. Only the order of issues may differ.
PipelineResult label(const Building& building, PipelineResult segmented, const RuleBase& rules,
                     const LabelOptions& options = {});

/// What is to be written of a building: PipelineResult::output. `result` is what label() said of
/// `building` with the same rules; it has_surfaces().
LabelledBuilding annotate(const Building& building, const PipelineResult& result,
                          const RuleBase& rules, const LabelOptions& options);

}  // namespace oriel
