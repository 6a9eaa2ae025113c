#pragma once

#include "kernel/base/issue.h"
#include "model/scale_series.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// One line of `NAME.oplog.jsonl`, with its line end: building, lod, oriel_id, label, operation,
/// rule, scale, with, aabb, forward, inverse (docs/formats.md). Points are in the input's
/// coordinates, to the micrometre; aabb = [xmin, ymin, zmin, xmax, ymax, zmax]. In the file it has
/// a check, too (log_seal.h).
std::string operation_line(const SeriesOperation& operation);

/// The operations of such a text, in their order. E119 for a line that is none, with its number;
/// then there is no value.
Checked<std::vector<SeriesOperation>> read_operations(std::string_view text,
                                                      const std::string& file);

/// The operations of such a file, of which no more than one is held at a time.
class OperationReader {
 public:
  /// Throws InputError: E101 the file cannot be opened, E119 its first line is no operation.
  explicit OperationReader(const std::string& file);
  ~OperationReader();
  OperationReader(const OperationReader&) = delete;
  OperationReader& operator=(const OperationReader&) = delete;

  /// The operation that comes next; null at the end.
  [[nodiscard]] const SeriesOperation* next() const { return next_ ? &*next_ : nullptr; }
  /// Takes it. Throws InputError E119 if the line behind it is no operation.
  SeriesOperation take();

 private:
  void read();

  struct File;
  std::unique_ptr<File> file_;
  std::optional<SeriesOperation> next_;
};

}  // namespace oriel
