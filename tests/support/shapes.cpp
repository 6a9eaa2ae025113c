#include "tests/support/shapes.h"

#include <algorithm>
#include <map>
#include <tuple>

namespace oriel::test {

namespace {

/// Numbers points, equal ones alike.
class Numbering {
 public:
  explicit Numbering(Building& building) : building_(building) {}
  int operator()(Vec3 p) {
    const auto [entry, is_new] =
        numbers_.emplace(std::tuple(p.x, p.y, p.z), static_cast<int>(building_.vertices.size()));
    if (is_new) building_.vertices.push_back(p);
    return entry->second;
  }

 private:
  Building& building_;
  std::map<std::tuple<double, double, double>, int> numbers_;
};

std::vector<double> levels(std::vector<double> all) {
  std::ranges::sort(all);
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

}  // namespace

bool BoxBody::is_solid_at(Vec3 p) const {
  bool is_solid = false;
  for (const Part& part : parts_)
    if (p.x > part.min.x && p.x < part.max.x && p.y > part.min.y && p.y < part.max.y &&
        p.z > part.min.z && p.z < part.max.z)
      is_solid = part.is_solid;
  return is_solid;
}

Building BoxBody::build(const std::string& id) const {
  std::vector<double> axis[3];
  for (const Part& part : parts_) {
    axis[0].insert(axis[0].end(), {part.min.x, part.max.x});
    axis[1].insert(axis[1].end(), {part.min.y, part.max.y});
    axis[2].insert(axis[2].end(), {part.min.z, part.max.z});
  }
  for (auto& values : axis) values = levels(values);
  const auto is_solid = [&](int i, int j, int k) {
    const int index[3] = {i, j, k};
    double middle[3];
    for (int a = 0; a < 3; ++a) {
      if (index[a] < 0 || index[a] + 1 >= std::ssize(axis[a])) return false;
      middle[a] = (axis[a][static_cast<std::size_t>(index[a])] +
                   axis[a][static_cast<std::size_t>(index[a]) + 1]) /
                  2;
    }
    return is_solid_at({middle[0], middle[1], middle[2]});
  };
  const auto point = [&](int i, int j, int k) {
    return Vec3{axis[0][static_cast<std::size_t>(i)], axis[1][static_cast<std::size_t>(j)],
                axis[2][static_cast<std::size_t>(k)]};
  };
  std::vector<std::vector<Vec3>> faces;
  for (int i = 0; i + 1 < std::ssize(axis[0]); ++i)
    for (int j = 0; j + 1 < std::ssize(axis[1]); ++j)
      for (int k = 0; k + 1 < std::ssize(axis[2]); ++k) {
        if (!is_solid(i, j, k)) continue;
        const int l = i + 1, m = j + 1, n = k + 1;
        if (!is_solid(i - 1, j, k))
          faces.push_back({point(i, j, k), point(i, j, n), point(i, m, n), point(i, m, k)});
        if (!is_solid(l, j, k))
          faces.push_back({point(l, j, k), point(l, m, k), point(l, m, n), point(l, j, n)});
        if (!is_solid(i, j - 1, k))
          faces.push_back({point(i, j, k), point(l, j, k), point(l, j, n), point(i, j, n)});
        if (!is_solid(i, m, k))
          faces.push_back({point(i, m, k), point(i, m, n), point(l, m, n), point(l, m, k)});
        if (!is_solid(i, j, k - 1))
          faces.push_back({point(i, j, k), point(i, m, k), point(l, m, k), point(l, j, k)});
        if (!is_solid(i, j, n))
          faces.push_back({point(i, j, n), point(l, j, n), point(l, m, n), point(i, m, n)});
      }
  return building_of(faces, id);
}

Building building_of(const std::vector<std::vector<Vec3>>& polygons, const std::string& id) {
  Building building;
  building.id = id;
  building.is_solid = false;  // which shells are cavities is for solidify to find
  Numbering number(building);
  for (const auto& polygon : polygons) {
    Polygon out;
    out.source = static_cast<int>(building.polygons.size());
    out.rings.emplace_back();
    for (const Vec3 p : polygon) out.rings[0].push_back(number(p));
    building.polygons.push_back(std::move(out));
  }
  return building;
}

}  // namespace oriel::test
