#pragma once

#include "kernel/base/issue.h"
#include "oriel/rules.h"
#include "studio/session/labels/labelled_buildings.h"
#include "studio/session/request_body.h"

#include <cstdint>
#include <string>
#include <vector>

namespace oriel::studio {

/// {code, severity, sentence} of a finding about a building or a file.
StudioJson issue_json(const Issue& issue);
StudioJson issues_json(const std::vector<Issue>& issues);

/// A finding of a text of one line, such as a condition; of a param, whose text stands in no file,
/// at its first line.
StudioJson finding_json(const Issue& issue);

/// "0.8 m" for a value of a param, as a pack states it.
std::string value_text(const RuleBase& rules, const std::string& param, double value);

/// What a page is told that has labels up to LabelledBuildings::number `since` (0: none).
struct AskedLabels {
  std::uint64_t since = 0;
  /// Null: there was no good pack before.
  const LabelledBuildings* before = nullptr;
};

/// The members of an answer to `pack` that a good pack has.
void add_labels(const LabelledBuildings& now, const AskedLabels& asked, StudioJson& answer);

}  // namespace oriel::studio
