#pragma once

#include "cli/batch/outcome.h"
#include "kernel/base/issue.h"
#include "kernel/io/files/output_file.h"

#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace oriel::cli {

/// Where an output of the command is: its path, and its size at the moment. No path: it is not
/// asked for.
struct PartPlace {
  std::string path;
  std::uint64_t size = 0;
};
using PartPlaces = std::array<PartPlace, kParts>;

/// What is noted of a run for --reuse, in STEM.records.jsonl: what came of each record of a stream,
/// by the hash of its source, and where it stands in the outputs. docs/formats.md.
class RecordNotes {
 public:
  /// `recipe_sha256` says all that a result depends on beside the source.
  RecordNotes(const std::string& stem, const std::string& recipe_sha256);

  /// `places` are those before the record was put there.
  void add(const std::string& source_sha256, const PartPlaces& places,
           const RecordOutcome& outcome);
  void commit() { file_.commit(); }

 private:
  OutputFile file_;
};

/// A run that was done before, from which results are taken. Of its records 16 bytes each are held
/// in memory.
class EarlierRun {
 public:
  /// `status` is its STEM.status.json; STEM.records.jsonl stands beside it, and its outputs where
  /// it says. What was removed or changed since, or came of another recipe, is of no use: then
  /// `fault` says so, a warning E124.
  EarlierRun(const std::string& status, const std::string& recipe_sha256);
  ~EarlierRun();
  EarlierRun(const EarlierRun&) = delete;
  EarlierRun& operator=(const EarlierRun&) = delete;

  [[nodiscard]] const std::optional<Issue>& fault() const { return fault_; }
  /// What came of a record with this source; nothing if there was none. Several threads may call
  /// it.
  [[nodiscard]] std::optional<RecordOutcome> find(const std::string& source_sha256) const;

 private:
  struct Note {
    std::uint64_t key = 0;  ///< the first digits of the source's hash
    std::uint64_t at = 0;   ///< in the file of notes
    bool operator<(const Note& other) const { return key < other.key; }
  };

  void load(const std::string& status, const std::string& recipe_sha256);
  [[nodiscard]] std::optional<RecordOutcome> outcome_at(const Note& note,
                                                        const std::string& source_sha256) const;

  std::optional<Issue> fault_;
  std::vector<Note> notes_;           ///< sorted
  std::map<std::string, int> files_;  ///< descriptors of what is read, by path
  std::string notes_path_;
};

}  // namespace oriel::cli
