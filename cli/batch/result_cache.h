#pragma once

#include "cli/batch/outcome.h"
#include "io/files/output_file.h"
#include "kernel/base/issue.h"

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace oriel::cli {

/// The results of an earlier run, of which a record with the same source is one (--reuse), and the
/// notes for later runs. STEM.records.jsonl has what came of each record of a stream, by the hash
/// of its source, and where it stands in the outputs (docs/formats.md). Of the records of the
/// earlier run 16 bytes each are held in memory.
class ResultCache {
 public:
  /// `status` is the STEM.status.json of the earlier run; STEM.records.jsonl stands next to it, and
  /// its outputs where it says. What was removed or changed since, or came of another recipe, is of
  /// no use: then `fault` says so, a warning E124. `recipe_sha256` says all that a result depends
  /// on besides the source. Notes of this run go to `stem`.
  ResultCache(const std::string& status, const std::string& stem, const std::string& recipe_sha256);
  ~ResultCache();
  ResultCache(const ResultCache&) = delete;
  ResultCache& operator=(const ResultCache&) = delete;

  [[nodiscard]] const std::optional<Issue>& fault() const { return fault_; }
  /// What came of a record with this source; nothing if there was none. Several threads may call
  /// it.
  [[nodiscard]] std::optional<RecordOutcome> find(const std::string& source_sha256) const;

  /// Notes a result of this run. `places` are those before the record was put there.
  void add(const std::string& source_sha256, const PartPlaces& places,
           const RecordOutcome& outcome);
  void commit() { new_notes_.commit(); }

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
  OutputFile new_notes_;
};

}  // namespace oriel::cli
