#pragma once

#include "io/files/output_file.h"
#include "kernel/base/issue.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace oriel {

/// Makes a GeoPackage (OGC 12-128r18, version 1.3) of what gpkg_rows() gives of records, in their
/// order: the tables `buildings`, `surfaces` and `features`, each with a MultiPolygon Z and typed
/// columns. Rows wait in a file, so that memory holds one record, and the names of all columns. The
/// same rows give the same bytes.
///
/// Failures throw OutputError E601.
class GpkgWriter {
 public:
  /// `output` is the file that it is made for: the two files that it needs lie beside it, without a
  /// name, and together are about as large.
  explicit GpkgWriter(std::string output);
  ~GpkgWriter();
  GpkgWriter(const GpkgWriter&) = delete;
  GpkgWriter& operator=(const GpkgWriter&) = delete;

  /// The next record's rows; `crs` is the reference system that its file names, or empty.
  void take(std::string_view rows, std::string_view crs);

  /// Appends the database to `file`; nothing may be taken after it. Returns what was found: E165
  /// (warning) for attributes whose columns are text because their values differ in type.
  std::vector<Issue> end(OutputFile& file);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace oriel
