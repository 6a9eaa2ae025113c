#pragma once

#include "cli/terminal/exit_code.h"
#include "io/cityjson/carried_labels.h"
#include "io/document.h"
#include "oriel/result.h"

#include <string>
#include <vector>

namespace oriel::cli {

/// What `oriel view` gathers buildings in to show them: a page, or a picture.
class Exhibit {
 public:
  Exhibit() = default;
  virtual ~Exhibit() = default;
  Exhibit(const Exhibit&) = delete;
  Exhibit& operator=(const Exhibit&) = delete;

  /// Adds a building that was labelled. Returns what was found when it was drawn for scales.
  virtual std::vector<Issue> add(const Document& document, const Building& building,
                                 const PipelineResult& result) = 0;
  /// Begins with the buildings of a file that are what became of those before.
  virtual void begin_after(const std::string& file) = 0;
  /// Adds one of them, with the labels that its file has; null: those of `result`.
  virtual void add_after(const Building& building, const PipelineResult& result,
                         const CarriedLabels* carried) = 0;
  /// Throws CLI::ValidationError or InputError where what was asked for is not among the buildings
  /// of a run that ended with `code`.
  virtual void check(ExitCode /*code*/) const {}
  /// Makes the bytes of the file. Throws InputError.
  virtual std::string made() = 0;
};

}  // namespace oriel::cli
