#pragma once

#include "io/document.h"
#include "io/reader.h"
#include "io/records/log_seal.h"
#include "io/records/operation_log.h"
#include "kernel/base/issue.h"
#include "model/scale_series.h"

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace oriel {

/// NAME.oplog.jsonl.
std::string log_of_series(const std::string& name);

/// The files NAME.1-N.city.json, or of a series of streams NAME.1-N.city.jsonl, by N. Throws
/// InputError: E101 there is none, G409 there are levels of two series.
std::map<double, std::string> levels_of_series(const std::string& name);

/// Throws InputError E132 if the level 1 : scale is not the file that was written with the log.
void check_hash(const LogSeal& seal, const std::string& log, double scale,
                const std::string& level);

/// Of a log without checks, whose changes nobody would notice: the warning E133.
Issue unsealed(const std::string& log);

/// The operations of one record, by building.
using OperationsOfRecord = std::map<std::string, std::vector<SeriesOperation>>;

/// Those that come next in the log and are of the document's buildings: a log has them in the
/// order of the records.
OperationsOfRecord operations_of(OperationReader& log, const Document& document);

std::vector<std::string> ids_in(const OperationsOfRecord& operations);

/// One level of a stored series, record by record.
class LevelRecords {
 public:
  /// `lod`: the level of detail that the series is made of; empty: the highest. Throws InputError
  /// E101 if the file cannot be read.
  LevelRecords(std::string file, std::string lod);

  /// The next record; nothing after the last one. No value if it cannot be read, and the issues say
  /// why.
  std::optional<Checked<Document>> next() { return reader_.next(); }

  /// The states of the buildings `ids` in `document`, the record that next() gave last. E120 and no
  /// value if one is not there (read_level).
  Checked<std::vector<LevelState>> states(const Document& document,
                                          const std::vector<std::string>& ids);

  [[nodiscard]] const std::string& file() const { return file_; }

 private:
  std::string file_, lod_;
  Reader reader_;
  std::string header_;  ///< of a stream
};

}  // namespace oriel
