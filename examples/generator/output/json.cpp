#include "examples/generator/output/json.h"

#include <array>
#include <cstdlib>

namespace oriel::generator {

void append_metres(Json& json, Um length) {
  if (length < 0) json.push_back('-');
  const Um size = std::abs(length);
  append_number(json, size / 1'000'000);
  Um rest = size % 1'000'000;
  if (rest == 0) return;
  int digits = 6;
  for (; rest % 10 == 0; rest /= 10) --digits;
  append_format(json, ".{:0{}}", rest, digits);
}

void append_metres(Json& json, Point point) {
  append_list(json, std::array{point.x, point.y, point.z},
              [&](Um length) { append_metres(json, length); });
}

void append_metres(Json& json, const Extent& extent) {
  const auto [low, high] = extent;
  append_list(json, std::array{low.x, low.y, low.z, high.x, high.y, high.z},
              [&](Um length) { append_metres(json, length); });
}

}  // namespace oriel::generator
