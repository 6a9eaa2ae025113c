#pragma once

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

/// "keep", "point", "line", "small", "sheet".
std::string to_string(Significance significance);
/// What a text of to_string() says.
std::optional<Significance> significance_of(const std::string& text);

}  // namespace oriel
