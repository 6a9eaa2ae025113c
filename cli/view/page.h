#pragma once

#include "io/cityjson/carried_labels.h"
#include "model/building.h"
#include "oriel/result.h"
#include "oriel/rules.h"

#include <memory>
#include <string>

namespace oriel::cli {

/// What a page of `view` knows (docs/formats.md): of each model its buildings with their polygons,
/// the features these lie in, and for every feature and surface the reasons as `explain` gives
/// them. A model is what one run has read: the buildings as they are, or generalised.
class PageData {
 public:
  explicit PageData(const RuleBase& rules);
  ~PageData();
  PageData(const PageData&) = delete;
  PageData& operator=(const PageData&) = delete;

  /// What is added from here on belongs to a further model.
  void begin_model(const std::string& name);
  /// Adds a building to the model at hand, also one that did not come to the end of the line: it
  /// has its polygons and what was told of it, but no features.
  void add(const Building& building, const PipelineResult& line);
  /// Adds a building with the labels that its file has. A feature with the id and the rule of one
  /// of the first model's has the reasons that are given there; `line` tells what was found wrong.
  void add(const Building& building, const PipelineResult& line, const CarriedLabels& carried);

  /// How many buildings the model at hand has.
  [[nodiscard]] std::size_t buildings() const;

  /// One JSON object without any `<`, so that it may stand in HTML.
  [[nodiscard]] std::string json() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// One HTML file that shows `data` (PageData::json) and loads nothing: the page of the studio
/// without its editor (studio/page/view.html).
std::string page_of(const std::string& data);

}  // namespace oriel::cli
