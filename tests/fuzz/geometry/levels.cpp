#include "generalise/series/level_state.h"
#include "io/levels/level_file.h"
#include "io/records/operation_log.h"
#include "oriel/series.h"
#include "oriel/write.h"
#include "tests/fuzz/support/pack.h"
#include "tests/fuzz/support/promises.h"
#include "tests/fuzz/support/scratch_file.h"
#include "tests/fuzz/targets.h"

#include <algorithm>

#include <fmt/format.h>

namespace oriel::fuzz {

namespace {

constexpr double kFine = 1000, kMiddle = 3000, kCoarse = 10000;

/// Files of the same level may have their vertices in another order.
LevelState state_in(const std::string& text) {
  const auto states = read_level(text, "a.city.json", {"a"});
  promise(states.value.has_value(), "a level that was written can be read",
          states.issues.empty() ? "" : to_string(states.issues.front()));
  return states.value->at(0);
}

/// The files of a series, from which levels between are made.
void check_files(const Document& document, const Series& series) {
  static const ScratchFile fine("s.1-1000.city.json");
  const std::string folder = fine.path().substr(0, fine.path().rfind('/'));
  std::string text;
  for (const SeriesOperation& operation : series.operations()) text += operation_line(operation);
  if (text.empty()) return;
  write_file(folder + "/s.oplog.jsonl", text);
  for (const double scale : {kFine, kCoarse})
    write_file(fmt::format("{}/s.1-{}.city.json", folder, scale),
               write(document, at(series, scale)));
  std::string level;
  const LevelFromFiles made =
      at(folder + "/s", kMiddle, [&](std::string_view bytes) { level += bytes; });
  promise(made.is_complete, "a level can be made from the files of a series",
          made.issues.empty() ? "" : to_string(made.issues.front()));
  promise(state_in(level) == state_in(write(document, at(series, kMiddle))),
          "a level made from files is the level of the series");
}

}  // namespace

/// A series: its levels replay, in memory and from files, and are valid; so is the building as it
/// came, unless there is a warning that it is not (G410, G413).
void levels(std::string_view input) {
  ByteSource bytes(input);
  const auto document = changed_document(bytes);
  if (!document) return;
  const SeriesOptions options;
  std::vector<PipelineResult> results;
  results.push_back(oriel::label(document->buildings[0], default_pack(), options));
  promise_no_fault(results[0].issues);
  const Series series =
      oriel::series(*document, results, default_pack(), {kFine, kMiddle, kCoarse}, options);
  promise_no_fault(series.issues);
  if (series.buildings.empty()) return;
  check_files(*document, series);
  // The building as it came need not be valid if it says so; its levels are.
  const bool is_finest_valid = std::ranges::none_of(series.issues, [](const Issue& issue) {
    return issue.place.feature.empty() && (issue.code == Code::G410 || issue.code == Code::G413);
  });
  if (is_finest_valid) promise_valid(write(*document, at(series, 1)), "series");
  for (const double scale : {kFine, kMiddle, kCoarse})
    promise_valid(write(*document, at(series, scale)), "series");
}

}  // namespace oriel::fuzz
