#pragma once

#include "experiments/report/runs.h"
#include "experiments/results/results.h"

#include <vector>

namespace oriel::report {

/// So many runs of a sweep over several params at once are listed, the best.
inline constexpr std::size_t kMostRunsListed = 20;

/// The tables of one group. Of a sweep of single params: a line a param with the best and the worst
/// value, those that matter most first, and the names of those without effect; of one param alone,
/// a line a value. Of a sweep of several at once: the best runs. Of a comparison, and of what was
/// learnt: a line a class, with each run. Of what else was varied: a line a run; of ablations the
/// one that loses most first, and a table of those without effect.
std::vector<ReportTable> tables_of(const RunGroup& group);

/// The options of an experiment, a line each.
ReportTable table_of_options(const ExperimentResults& results);

}  // namespace oriel::report
