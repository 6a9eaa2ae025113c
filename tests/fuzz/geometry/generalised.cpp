#include "interpret/plan/profile.h"
#include "oriel/generalise.h"
#include "oriel/write.h"
#include "tests/fuzz/support/pack.h"
#include "tests/fuzz/support/promises.h"
#include "tests/fuzz/targets.h"

#include <algorithm>

namespace oriel::fuzz {

namespace {

/// A scale of maps, or a level of detail.
Targets targets_of(ByteSource& bytes) {
  constexpr double kScales[] = {500, 1000, 2500, 5000, 10000};
  const std::size_t choice = bytes.below(std::size(kScales) + 3);
  if (choice < std::size(kScales)) return at_scale(kScales[choice]);
  constexpr const char* kLevels[] = {"lod:1.2", "lod:1.3", "lod:2.0"};
  Targets targets;
  targets.profiles.push_back(load_profile_file(kLevels[choice - std::size(kScales)]).value.value());
  return targets;
}

bool came_invalid(const std::vector<Issue>& issues) {
  return std::ranges::any_of(issues, [](const Issue& issue) { return issue.code == Code::G413; });
}

}  // namespace

/// generalise: what it writes is valid, unless it says that it came as no valid solid (G413).
void generalised(std::string_view input) {
  ByteSource bytes(input);
  const Targets targets = targets_of(bytes);
  const auto document = changed_document(bytes);
  if (!document) return;
  const Building& building = document->buildings[0];
  GeneraliseOptions options;
  options.reports_changes = options.reports_figures = true;
  const PipelineResult result = oriel::label(building, default_pack(), options);
  promise_no_fault(result.issues);
  GeneralisedBuilding drawn =
      oriel::generalise(*document, building, result, default_pack(), targets, options);
  promise_no_fault(drawn.issues);
  if (drawn.levels.empty() || came_invalid(drawn.issues)) return;
  OutputRecord output;
  add(std::move(drawn), output);
  promise_valid(write(*document, output), "generalise");
}

}  // namespace oriel::fuzz
