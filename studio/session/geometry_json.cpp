#include "studio/session/geometry_json.h"

#include <cmath>

namespace oriel::studio {

namespace {

/// A picture needs no more than millimetres.
constexpr double kMillimetres = 1000;

void add_mm(const Vec3& p, StudioJson& list) {
  for (const double metres : {p.x, p.y, p.z}) list.push_back(whole_millimetres(metres));
}

}  // namespace

std::int64_t whole_millimetres(double metres) { return std::llround(kMillimetres * metres); }

StudioJson box_mm_json(const Box& box, const Vec3& origin_m) {
  StudioJson list = StudioJson::array();
  add_mm(box.min - origin_m, list);
  add_mm(box.max - origin_m, list);
  return list;
}

StudioJson vertices_mm_json(const std::vector<Vec3>& vertices, const Frame& frame,
                            const Vec3& origin_m) {
  StudioJson list = StudioJson::array();
  for (const Vec3& vertex : vertices) add_mm(vertex + (frame.origin_m - origin_m), list);
  return list;
}

StudioJson point_json(const Vec3& p) {
  return StudioJson::array({rounded(p.x, 3), rounded(p.y, 3), rounded(p.z, 3)});
}

}  // namespace oriel::studio
