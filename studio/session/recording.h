#pragma once

#include "io/cityjson/carried_labels.h"
#include "model/building.h"
#include "oriel/result.h"
#include "oriel/rules.h"

#include <cstddef>
#include <memory>
#include <string>

namespace oriel::studio {

/// The replies of a session that a page without a server needs (`oriel view`), of buildings that a
/// run has read and labelled, and what became of them (docs/formats.md).
class Recording {
 public:
  explicit Recording(const RuleBase& rules);
  ~Recording();
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  /// Adds a building, also one that did not come to the end of the line: it has its polygons and
  /// what was told of it, but no features.
  void add(const Building& building, const PipelineResult& line);
  /// From here on the recording has a second picture, if only of no building.
  void begin_after();
  /// Adds what became of the building of that id. A feature keeps the number and the reasons of the
  /// one of that id; `carried` are the labels that its file has, null: those of `line`.
  void add_after(const Building& building, const PipelineResult& line,
                 const CarriedLabels* carried);

  /// One JSON object without any `<`, so that it may stand in HTML.
  [[nodiscard]] std::string json() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace oriel::studio
