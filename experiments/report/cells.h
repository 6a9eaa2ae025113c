#pragma once

#include "experiments/results/results.h"

#include <string>

namespace oriel::report {

/// Numbers as the tables of a report have them. What has no value is "–".

/// "0.912"
std::string share_cell(double share);
/// "+0.012", "-0.003", "0.000"
std::string difference_cell(double difference);
/// "0.912 [0.880, 0.941]", without an interval only the first.
std::string f1_cell(const ResultRow& row);
/// "+0.012 [-0.003, +0.027]"; "–" of a row without a difference.
std::string difference_cell(const ResultRow& row);
/// "0.034", "< 0.001"; "–" of a row without a difference.
std::string p_cell(const ResultRow& row);

}  // namespace oriel::report
