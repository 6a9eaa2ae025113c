#pragma once

#include "io/records/record_columns.h"
#include "kernel/base/issue.h"
#include "model/description/feature_graph.h"
#include "model/vec3.h"

#include <string>
#include <vector>

namespace oriel {

/// Reads feature records (see feature_records.h) as what rules ask for: attributes and relations,
/// one building after the other in the order of the file. Interpreting them gives the verdicts that
/// the building itself would get. A building's records stand together.
///
/// Issues beside those of read_feature_records: E111 for a second record of the same id in a
/// building, which is left out; E121 (warning) for each building whose relations lead to features
/// that are not in the file. Throws InputError as read_feature_records does. `columns` becomes what
/// the table has: what a pack reads and the table lacks is missing in every feature. `boxes`
/// become, building by building, those of its rows (aabb_m): in the input's coordinates, in metres;
/// all 0 where the record has none, and E111 where it has no box there.
Checked<std::vector<DescribedBuilding>> read_feature_tables(
    const std::string& path, RecordColumns* columns = nullptr,
    std::vector<std::vector<Box>>* boxes = nullptr);

}  // namespace oriel
