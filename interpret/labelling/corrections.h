#pragma once

#include "interpret/score/score.h"
#include "kernel/base/issue.h"
#include "model/correction.h"
#include "model/interpretation.h"
#include "model/vec3.h"

#include <cstddef>
#include <map>
#include <set>
#include <span>
#include <string>
#include <vector>

namespace oriel {

/// A feature as corrections find it.
struct PlacedFeature {
  std::string id;
  /// In the input's coordinates.
  Box box;
};

/// A feature, by its place in what was given, and what it is corrected to.
struct CorrectedFeature {
  std::size_t feature = 0;
  const Correction* correction = nullptr;
};

/// Drops corrections to classes that are none of `labels`: a warning E153 for each, with the
/// nearest label.
std::vector<Issue> drop_unknown_classes(std::vector<Correction>& corrections,
                                        const std::vector<std::string>& labels);

/// The corrections of a file, for every building that may come.
class Corrections {
 public:
  Corrections() = default;
  explicit Corrections(const std::vector<Correction>& corrections);

  [[nodiscard]] bool empty() const { return by_building_.empty(); }
  /// Of all that they say, wherever they stand in the file.
  [[nodiscard]] const std::string& sha256() const { return sha256_; }

  /// The features of a building that are corrected, in their order, each once. An id counts before
  /// a point; a point finds the feature with the smallest box that it is in, or no further from
  /// than a few centimetres. Warnings are added with file and line: E153 for one that finds
  /// nothing, E154 for those that give a feature different classes, of which none is used, E155
  /// where the id is not there and the point is. The result points into this.
  [[nodiscard]] std::vector<CorrectedFeature> find(const std::string& building,
                                                   std::span<const PlacedFeature> features,
                                                   std::vector<Issue>& issues) const;

  /// A warning E153 for each building that is none of `seen`.
  [[nodiscard]] std::vector<Issue> unknown_buildings(const std::set<std::string>& seen) const;

 private:
  std::map<std::string, std::vector<Correction>> by_building_;
  std::string sha256_;
};

/// What the rule of a corrected verdict is called.
inline constexpr const char* kCorrectedRule = "corrected";

/// Puts the right classes into the verdicts: the score and the margin are 1, the rule is
/// "corrected", and the runner-up is the label that the rules gave, where it is another one. Groups
/// lose the features whose label changes. Other features keep their labels.
void correct(std::span<const CorrectedFeature> corrected, Interpretation& interpretation);

/// The true objects that corrections are for one building, to be added to `truth` of it: an object
/// at each corrected feature that no true object is at (IoU >= min_iou), unless it is corrected to
/// "unknown". If `truth` is empty, nothing is known of the other features: each of them becomes an
/// object that is left out, so that what is found there counts neither way.
std::vector<ExpectedObject> objects_of_corrections(const std::string& building,
                                                   std::span<const PlacedFeature> features,
                                                   std::span<const CorrectedFeature> corrected,
                                                   std::span<const ExpectedObject> truth,
                                                   const ScoreOptions& options = {});

}  // namespace oriel
