#pragma once

#include "cli/streams/shards.h"
#include "kernel/base/issue.h"
#include "kernel/io/files/partial_files.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel::cli {

/// Nothing if `file`, whose bytes are `mark`, was made of the whole shard: by the hashes in
/// NAME.status.json next to it (the file is its output, its input is the shard) or over several
/// such files in `through`, and as many lines as the shard has but those that a stage refused or
/// did not select. Without a status file: if it has as many lines as the shard. Else an error E118.
std::optional<Issue> check_provenance(const Shard& shard, const std::string& file,
                                      const FileMark& mark,
                                      const std::vector<std::string>& through);

}  // namespace oriel::cli
