#pragma once

#include "cli/output/label_outputs.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/logging.h"
#include "oriel/rules.h"

#include <optional>
#include <string>
#include <vector>

namespace oriel::cli {

/// `generalise --series`: NAME.1-N.city.json, of streams NAME.1-N.city.jsonl, for each scale, which
/// ascend, and NAME.oplog.jsonl, for all inputs (SeriesFiles).
ExitCode write_series(const LabellingArguments& arguments, const std::vector<double>& scales,
                      std::optional<Profile> profile, const RuleBase& rules, Report& report);

/// `generalise --at 1:N --from NAME`: the level at a scale, from the stored level that is nearest
/// and the log. E101 (InputError) if there is no log or no level; G409 and exit code 5 if they do
/// not fit each other.
ExitCode write_level_at(const std::string& name, double scale, const std::string& out,
                        Report& report);

/// `generalise --check --from NAME`: proves a stored series (check_series()) and says what it has.
/// InputError and exit codes as of write_level_at().
ExitCode check_stored_series(const std::string& name, Report& report);

}  // namespace oriel::cli
