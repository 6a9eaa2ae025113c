#pragma once

#include "interpret/experiment/parallel.h"
#include "interpret/experiment/results.h"
#include "kernel/base/issue.h"
#include "oriel/experiments/feature_store.h"
#include "oriel/options.h"

#include <vector>

namespace oriel {

/// Two tables for each building of the files: what count_as_paper() counts in the first recursion,
/// and in all. A building that is no solid has none: its first error is added to `issues` as a
/// warning. Throws InputError for a file that cannot be read.
std::vector<ReportTable> paper_tables(const std::vector<HashedFile>& files,
                                      const PipelineOptions& options, const ForEachShare& for_each,
                                      std::vector<Issue>& issues);

}  // namespace oriel
