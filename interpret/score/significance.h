#pragma once

#include "model/description/feature_table.h"

#include <optional>
#include <string>

namespace oriel {

/// Sizes below which a part of a building is not drawn (paper 5.1). They belong together: c ≤ b < a
/// and a² > area > a · b; is_chain() says whether they do.
struct Thresholds {
  double a_m = 0;
  double b_m = 0;
  double c_m = 0;
  double area_m2 = 0;

  /// The paper prints "a*a > A > a*b", which cannot hold if A is a · b: it is read with the lost
  /// subscripts of the thresholds.
  [[nodiscard]] bool is_chain() const {
    return 0 < c_m && c_m <= b_m && b_m < a_m && a_m * a_m > area_m2 && area_m2 > a_m * b_m;
  }
};

/// Thresholds of a map at 1 : scale on which `map_mm` millimetres are the least that is seen:
/// a = that length in nature, b = a / 2, c = a / 4, area = a · √(a · b).
Thresholds map_thresholds(double map_mm, double scale);

/// What a part is at given thresholds.
enum class Significance {
  keep,   ///< large enough in all directions
  point,  ///< the paper's 0D: short in all
  line,   ///< 1D: long, and thin in two
  small,  ///< long and wide enough, and its silhouette is too small
  sheet   ///< 2D: long and wide, and thin in one
};

/// Of a part whose minimum box standing on the z-axis has the edges a ≥ b ≥ c, in metres. The tests
/// in the paper's order: c > x_c, a < x_a, b < x_b, a · b < x_A, else a sheet.
Significance significance(double a_m, double b_m, double c_m, const Thresholds& thresholds);

/// How a sheet lies to the part it touches (paper 5.1, Figure 7; our reading of it: design of the
/// generalisation). It decides what can be done to it.
enum class SheetPlace {
  lamina,   ///< flat on its facet: a plate, a shallow niche
  cap,      ///< flat on its facet and reaching beyond it: an overhang
  fin,      ///< on edge: a slab, a canopy, a parapet
  enclosed  ///< within the box of what it touches: a slot, a groove, a cavity, an inner wall
};

/// Of a sheet with the attributes of describe(): flat on its facet is what is no deeper than c
/// along its normal, a cap if it reaches more than c sideways out of the box of the part it
/// touches. Of the others, what reaches no more than c out of that box is enclosed.
SheetPlace sheet_place(const FeatureTable& table, FeatureId id, double c_m);

/// "keep", "point", "line", "small", "sheet".
std::string to_string(Significance significance);
/// "lamina", "cap", "fin", "enclosed".
std::string to_string(SheetPlace place);
/// What a text of to_string() says.
std::optional<Significance> significance_of(const std::string& text);
std::optional<SheetPlace> sheet_place_of(const std::string& text);
/// True of both: it is a verdict of size, not one of a list of classes.
bool is_verdict_of_size(const std::string& text);

}  // namespace oriel
