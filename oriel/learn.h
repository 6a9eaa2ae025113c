#pragma once

/// Rules that learn from samples (docs/learn.md): read_samples, join_samples, folds_of,
/// learn_params, learnt_pack, open_questions, propose, to_yaml; and how well variants of a pack
/// label samples: count_variants.
#include "interpret/labelling/corrections.h"  // IWYU pragma: export
#include "interpret/learn/ask.h"              // IWYU pragma: export
#include "interpret/learn/count_variants.h"   // IWYU pragma: export
#include "interpret/learn/folds.h"            // IWYU pragma: export
#include "interpret/learn/learn_params.h"     // IWYU pragma: export
#include "interpret/learn/learnt_pack.h"      // IWYU pragma: export
#include "interpret/learn/objective.h"        // IWYU pragma: export
#include "interpret/learn/proposal_yaml.h"    // IWYU pragma: export
#include "interpret/learn/propose.h"          // IWYU pragma: export
#include "interpret/learn/sample.h"           // IWYU pragma: export
#include "interpret/pack/rule_base.h"
#include "io/records/truth.h"
#include "kernel/base/issue.h"

#include <span>
#include <string>
#include <vector>

namespace oriel {

/// Samples of stored features, in the order of their buildings' names, with the truth of the same
/// buildings. `records` are files of feature records, `truths` are `*.truth.json` and
/// `*.truth.jsonl` files. Issues are those of reading them, and R284: an error if no building has
/// both features and truth, or a building occurs twice; else a warning about buildings without
/// truth, which are left out, and about those without features, whose objects count as missed; and
/// a warning E151 for each file that lacks columns which `rules` read, or boxes. Throws InputError
/// for a file that cannot be read.
///
/// `corrections` (null: none) add to the truth (add_corrections): of a building without other truth
/// they are all that is known. Issues are then also those of Corrections::find, and E153 for
/// buildings that the records do not have.
Checked<std::vector<Sample>> read_samples(std::span<const std::string> records,
                                          std::span<const std::string> truths,
                                          const RuleBase& rules,
                                          const Corrections* corrections = nullptr);

/// The same with truth that was read before.
Checked<std::vector<Sample>> read_samples(std::span<const std::string> records,
                                          std::span<const GroundTruth> truths,
                                          const RuleBase& rules,
                                          const Corrections* corrections = nullptr);

/// The same of features that are at hand, each sample without truth.
Checked<std::vector<Sample>> join_samples(std::vector<Sample> features,
                                          std::span<const GroundTruth> truths,
                                          const Corrections* corrections = nullptr);

/// A warning R286 for each file of records that was written before one of the models was. Records
/// say nothing of what they were made from: the dates of the files are all that is known.
/// Throws InputError E101 for a model that cannot be read.
std::vector<Issue> report_old_records(std::span<const std::string> records,
                                      std::span<const std::string> models);

/// read_costs() of a file. Throws InputError E101 if it cannot be read.
Checked<Objective::Costs> read_costs_file(const std::string& path);

}  // namespace oriel
