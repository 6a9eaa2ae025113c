#pragma once

#include "experiments/plan/experiment_plan.h"
#include "kernel/base/issue.h"

#include <string>
#include <vector>

namespace oriel {

/// The files that the patterns name, relative to the folder of `plan_file`: pattern by pattern,
/// sorted by the bytes of their paths, each file once. `*`, `?` and `[ab]` stand for characters of
/// one name. An error R280 for each pattern that matches no regular file.
std::vector<std::string> files_of(const std::vector<FilePattern>& patterns,
                                  const std::string& plan_file, std::vector<Issue>& issues);

/// `path` as it is shown: relative to the folder of `plan_file` if it stands in or beside it.
std::string path_in_plan(const std::string& path, const std::string& plan_file);

}  // namespace oriel
