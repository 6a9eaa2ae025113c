#pragma once

#include "cli/batch/inputs/input_reader.h"
#include "kernel/base/issue.h"
#include "model/labelled_building.h"
#include "oriel/result.h"
#include "oriel/write.h"

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace oriel::cli {

/// What a record adds to: the file of buildings (-o), --features, the listing on stdout, --explain,
/// --metrics, the tables of --table.
enum class OutputPart { buildings, features, listing, changes, metrics, energy, envelope };
inline constexpr std::size_t kParts = 7;

/// Where an output of the command is: its path, and its size at the moment. No path: it is not
/// asked for.
struct PartPlace {
  std::string path;
  std::uint64_t size = 0;
};
using PartPlaces = std::array<PartPlace, kParts>;

/// What a record adds to the outputs of a command.
struct Product {
  /// The bytes for each OutputPart; empty: nothing.
  std::array<std::string, kParts> bytes;
  /// In place of bytes for buildings, of outputs that are written when all records are there (OBJ,
  /// OFF, STL).
  std::vector<LabelledBuilding> labelled{};
  /// In place of bytes for buildings, of a CityJSON file: written piece by piece when it is taken.
  std::shared_ptr<RecordText> file{};
  /// To be reported after those of the buildings; an error says that a building was set aside.
  std::vector<Issue> issues{};
  /// Counts of the command, to be added to its own.
  std::map<std::string, int> counts{};

  /// Puts the text of `file` into its place among the bytes.
  void flatten();

  std::string& operator[](OutputPart part) { return bytes[static_cast<std::size_t>(part)]; }
  const std::string& operator[](OutputPart part) const {
    return bytes[static_cast<std::size_t>(part)];
  }
};

/// What came of one building, for status and summary.
struct BuildingOutcome {
  bool is_passed_over = false;
  /// It came as far as the command asks for.
  bool is_done = false;
  bool is_open = false;
  bool has_features = false;
  std::map<std::string, int> labels{};  ///< features, by label ("" = unknown)
  std::vector<Issue> issues{};
};

/// What came of a record that could be read.
struct RecordOutcome {
  std::vector<BuildingOutcome> buildings{};  ///< in their order
  Product product{};
};

/// What came of a record but for the bytes of its parts, there and back. What `labelled` has is not
/// in it.
nlohmann::ordered_json to_json(const RecordOutcome& outcome);
RecordOutcome outcome_of(const nlohmann::ordered_json& json);

/// A piece of the input on its way through the command; of a record with the work on it.
struct WorkItem {
  InputEvent event{};
  /// With --reuse: the hash of header and line, with which the outcome is kept for later runs.
  std::string source_sha256{};
  /// The outcome is that of an earlier run: there is nothing to work on.
  bool is_reused = false;
  /// With --isolate, of the record's buildings by number: working on it ended a worker.
  std::map<std::size_t, Issue> lost{};
  RecordOutcome outcome{};
  /// The buildings after the pipeline, in their order, for commands that visit them.
  std::vector<PipelineResult> results{};
  /// What this record has taken so far.
  Timings timings{};

  explicit WorkItem(InputEvent read) : event(std::move(read)) {
    if (const Record* one = record()) timings = one->timings;
  }
  /// Null: it is no record.
  [[nodiscard]] Record* record() { return std::get_if<Record>(&event); }
  [[nodiscard]] const Record* record() const { return std::get_if<Record>(&event); }
  /// A record that could be read and that no earlier run has worked on.
  [[nodiscard]] bool needs_work() const {
    const Record* one = record();
    return one != nullptr && one->document.value && !one->was_done && !is_reused;
  }
};

}  // namespace oriel::cli
