#pragma once

#include "model/building.h"

#include <map>
#include <string>
#include <vector>

namespace oriel {

/// A feature or a true object with its polygons (Polygon::source).
struct LabelledFaces {
  std::string id;
  std::string label;
  std::vector<int> faces;
};

/// What a labelling says of the polygons of a building, and what they are.
struct FacesOfBuilding {
  std::vector<LabelledFaces> predictions;
  std::vector<LabelledFaces> truth;
  /// Polygons that are not compared.
  std::vector<int> left_out;
  /// Pane and niche of true openings, by id, in the input's coordinates.
  std::map<std::string, Box> niches;
};

/// How a class was found, by area. Ratios without a denominator are NaN.
struct ClassArea {
  double both_m2 = 0;
  double predicted_m2 = 0;
  double expected_m2 = 0;

  [[nodiscard]] double precision() const { return both_m2 / predicted_m2; }
  [[nodiscard]] double recall() const { return both_m2 / expected_m2; }
  [[nodiscard]] double f1() const { return 2 * both_m2 / (predicted_m2 + expected_m2); }
};

struct AreaScore {
  /// Of the labels of the truth that are scored, and those that were predicted.
  std::map<std::string, ClassArea> classes;
  /// What was compared, whatever it is.
  double compared_m2 = 0;

  /// The mean F1 of the classes that the truth has; NaN if it has none.
  [[nodiscard]] double macro_f1() const;
};

/// Compares the polygons of a building that a true object has, and adds their areas. Reveals are
/// left out, which some count to the opening and some to the wall: what no true object has, or
/// another one than the opening in whose niche it lies. A polygon is what the object with the
/// fewest polygons among those that have it is, of equal ones the one with the smallest id; so are
/// predictions without an empty label. `not_scored` are labels of the truth that nothing is
/// expected to be called.
void compare_areas(const Building& building, const FacesOfBuilding& faces,
                   const std::vector<std::string>& not_scored, AreaScore& score);

/// For a terminal, a line a class; and `"area":{…}` for to_json of a Score (docs/formats.md).
std::string to_text(const AreaScore& score);
std::string area_json(const AreaScore& score);

}  // namespace oriel
