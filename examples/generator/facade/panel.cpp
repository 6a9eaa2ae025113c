#include "examples/generator/facade/panel.h"

#include <algorithm>

namespace oriel::generator {
namespace {

bool is_free_of(const std::vector<Rect>& reserved, const Rect& rect, Um distance) {
  return std::none_of(reserved.begin(), reserved.end(),
                      [&](const Rect& other) { return other.overlaps(rect.grown(distance)); });
}

}  // namespace

bool Panel::is_free(const Rect& rect, Um distance) const {
  return usable.contains(rect) && is_free_of(reserved, rect, distance);
}

bool RoofPlane::is_free(const Rect& rect, Um distance) const {
  return usable.contains(rect) && is_free_of(reserved, rect, distance);
}

std::vector<Rect> Panel::free_parts(const Rect& room, Um v0, Um v1, Um distance) const {
  std::vector<Rect> blocks;
  for (const Rect& other : reserved)
    if (other.grown(distance).overlaps({room.u0, room.u1, v0, v1}))
      blocks.push_back(other.grown(distance));
  std::sort(blocks.begin(), blocks.end(), [](const Rect& a, const Rect& b) { return a.u0 < b.u0; });
  std::vector<Rect> parts;
  Um start = room.u0;
  for (const Rect& block : blocks) {
    if (block.u0 > start) parts.push_back({start, block.u0, v0, v1});
    start = std::max(start, block.u1);
  }
  if (start < room.u1) parts.push_back({start, room.u1, v0, v1});
  return parts;
}

}  // namespace oriel::generator
