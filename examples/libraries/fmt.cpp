// fmt: text from values. Numbers are written so that reading them gives the same double.
// Trap: "{:.6g}" and the C++ streams' default cut UTM coordinates off; "{}" writes the shortest
// text that reads back equal, "{:.17g}" always enough.
#include <cstdlib>
#include <string>

#include <fmt/format.h>

int main() {
  const double northing_m = 5403766.115;
  const std::string shortest = fmt::format("{}", northing_m);
  const std::string cut = fmt::format("{:.6g}", northing_m);
  fmt::print("shortest {}, cut {}, fixed {:.3f}\n", shortest, cut, northing_m);
  return std::strtod(shortest.c_str(), nullptr) == northing_m &&
                 std::strtod(cut.c_str(), nullptr) != northing_m
             ? 0
             : 1;
}
