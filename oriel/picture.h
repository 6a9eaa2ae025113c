#pragma once

#include "interpret/pack/rule_base.h"
#include "io/document.h"
#include "io/picture/picture.h"  // IWYU pragma: export
#include "io/records/truth.h"
#include "kernel/base/ids.h"
#include "kernel/base/issue.h"
#include "oriel/generalise.h"
#include "oriel/label.h"
#include "oriel/result.h"

#include <cstddef>
#include <string>
#include <vector>

/// What picture() shows of results, panel by panel. In all of these `result` is what label() said
/// of `building` with the same rules and options.
namespace oriel {

/// Adds a building with its labels; of one without surfaces its bare faces.
void append_labelled(PicturePanel& panel, const Building& building, const PipelineResult& result,
                     const RuleBase& rules, const LabelOptions& options);

/// How many labels agree with a truth.
struct ComparedCounts {
  std::size_t right = 0, wrong = 0, missed = 0;
  /// Those of the missed objects that have no polygon in the building, so that none is marked.
  std::size_t without_polygons = 0;

  ComparedCounts& operator+=(const ComparedCounts& other);
  /// "20 right, 1 wrong, 2 missed (1 of them without polygons)".
  [[nodiscard]] std::string text() const;
};

/// The same, with marks of what is right, wrong and missed by a truth (match_features()); what was
/// missed is shown as the truth names it.
ComparedCounts append_compared(PicturePanel& panel, const Building& building,
                               const PipelineResult& result, const RuleBase& rules,
                               const LabelOptions& options, const GroundTruth& truth);

/// Makes two panels of a feature of a building that is_done(): in its building, and alone with what
/// is marked there: what it is part of, and what is in it, around, beside and above it. Their
/// captions say what it is and why it has its label.
std::vector<PicturePanel> explained_panels(const Building& building, const PipelineResult& result,
                                           const RuleBase& rules, const LabelOptions& options,
                                           FeatureId feature);

/// Makes a panel of a building and one of its drawing for each target, all in one frame of this
/// number, with captions of openings and of what was done. `issues` gets what generalise() found,
/// each sentence once.
std::vector<PicturePanel> target_panels(const Document& document, const Building& building,
                                        const PipelineResult& result, const RuleBase& rules,
                                        const std::vector<Targets>& targets,
                                        const LabelOptions& options, int frame,
                                        std::vector<Issue>& issues);

/// Marks in panels that follow the first one what is not there, lies elsewhere or has another
/// label; of two panels in both.
void mark_changes(std::vector<PicturePanel>& panels);

}  // namespace oriel
