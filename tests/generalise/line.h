#pragma once

#include "generalise/generalise.h"
#include "interpret/pack/rule_base.h"
#include "io/document.h"
#include "kernel/describe/describe.h"
#include "model/building.h"
#include "model/interpretation.h"

#include <string>
#include <vector>

namespace oriel::test {

/// The default pack.
const RuleBase& residential();

/// A building that came down the whole line with the default pack, as the command runs it.
struct Line {
  Document document;
  Solid solid;
  Segmentation segmentation;
  Description description;
  Interpretation interpretation;
  LabelledBuilding labelled;

  [[nodiscard]] const Building& building() const { return document.buildings.at(0); }
  [[nodiscard]] const FeatureTable& table() const { return description.table; }
  [[nodiscard]] const std::string& label(FeatureId id) const {
    return interpretation.verdicts[id.index()].label;
  }
  /// Features with that label.
  [[nodiscard]] std::vector<FeatureId> features(const std::string& label) const;
  /// To redraw it. Refers to the line.
  [[nodiscard]] RedrawContext context(Invariants invariants = {}) const;
  /// What a pack asks of it at 1 : scale.
  [[nodiscard]] Plan plan_at(double scale, const RuleBase& pack = residential()) const;
};

/// The first building of the file; it must be fit for the line.
Line line_of_file(const std::string& path);
/// The same of the text of a CityJSON file.
Line line_of_text(const std::string& text);
/// The same of a building that was made in code (without a document to write).
Line line_of(Building building);

/// examples/samples/NAME.stripped.city.json.
Line line_of_sample(const std::string& name);
/// The names of all samples.
const std::vector<std::string>& samples();

/// What generalising to 1 : scale made of it.
struct Coarser {
  double scale = 0;
  Plan plan;
  Generalised generalised;
  Redrawn redrawn;
  std::vector<Issue> issues;
};

/// Requires that something is left.
Coarser generalised(const Line& line, double scale);

/// The CityJSON text that the command would write.
std::string written(const Line& line, const Coarser& coarser);

}  // namespace oriel::test
