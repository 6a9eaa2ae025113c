#pragma once

#include "cli/batch/outcome.h"

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace oriel::cli {

/// What came of a record but for the bytes of its parts, there and back. What `labelled` has is not
/// in it.
nlohmann::ordered_json to_json(const RecordOutcome& outcome);
RecordOutcome outcome_of(const nlohmann::ordered_json& json);

}  // namespace oriel::cli
