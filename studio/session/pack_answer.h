#pragma once

#include "kernel/base/issue.h"
#include "oriel/rules.h"
#include "studio/session/labelled_buildings.h"
#include "studio/session/request_body.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::studio {

/// {code, severity, sentence} of a finding about a building or a file.
StudioJson issue_json(const Issue& issue);
StudioJson issues_json(const std::vector<Issue>& issues);

/// The findings of a pack, each with its place in `text`, the pack's own text: lines from 1,
/// columns from 1 in UTF-16 units. Findings in packs that it extends stand at their `extends:`,
/// with the place in the sentence.
StudioJson findings_json(const std::vector<Issue>& issues, const std::string& file,
                         std::string_view text);

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
