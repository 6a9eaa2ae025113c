#include "kernel/validate/part_folded.h"

#include "kernel/base/assert.h"
#include "kernel/base/index.h"
#include "kernel/geometry/exact.h"
#include "kernel/solidify/shells/shells.h"
#include "kernel/validate/polygons/fitted_plane.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <numeric>
#include <set>
#include <utility>

namespace oriel {

namespace {

using Triangle = std::array<int, 3>;
using WrittenEdge = std::pair<int, int>;

/// Half of what validate() takes for folded: what stays together is triangulated anew, otherwise
/// maybe.
constexpr double kTilted_deg = 10;

/// A facet as it is written: its corners once each, and its rings as numbers of corners.
struct WrittenFacet {
  std::vector<Vec3> points;
  std::vector<int> vertices;  ///< of the solid, by corner
  std::vector<std::vector<int>> rings;
};

/// Nothing if two vertices of the facet are written as one.
std::optional<WrittenFacet> written_facet(const Facet& facet, const Building& written,
                                          const Polygon& polygon) {
  WrittenFacet out;
  std::map<int, int> corner_of;  // by vertex as written
  for (std::size_t r = 0; r < facet.loops.size(); ++r) {
    out.rings.emplace_back();
    for (std::size_t i = 0; i < facet.loops[r].size(); ++i) {
      const int vertex = facet.loops[r][i], as_written = polygon.rings[r][i];
      const auto [entry, is_new] =
          corner_of.try_emplace(as_written, static_cast<int>(out.points.size()));
      if (is_new) {
        out.points.push_back(written.vertices[at(as_written)]);
        out.vertices.push_back(vertex);
      } else if (out.vertices[at(entry->second)] != vertex) {
        return std::nullopt;
      }
      out.rings.back().push_back(entry->second);
    }
  }
  return out;
}

Vec3 normal_of(const WrittenFacet& facet, const Triangle& t) {
  const Vec3 a = facet.points[at(t[0])];
  return cross(facet.points[at(t[1])] - a, facet.points[at(t[2])] - a);
}

/// The edges of a triangle as it runs.
std::array<WrittenEdge, 3> edges_of(const Triangle& t) {
  return {{{t[0], t[1]}, {t[1], t[2]}, {t[2], t[0]}}};
}

/// For each triangle 1 if it hangs together with the largest one and none between is tilted.
std::vector<char> find_main(const WrittenFacet& facet, std::span<const Triangle> triangles) {
  std::vector<Vec3> normals;
  for (const Triangle& t : triangles) normals.push_back(normal_of(facet, t));
  std::map<WrittenEdge, int> owner;
  for (int t = 0; t < std::ssize(triangles); ++t)
    for (const WrittenEdge& e : edges_of(triangles[at(t)])) owner[e] = t;
  const auto largest = std::ranges::max_element(normals, {}, length) - normals.begin();
  std::vector<char> is_main(triangles.size(), 0);
  std::vector<int> reached{static_cast<int>(largest)};
  is_main[at(largest)] = 1;
  while (!reached.empty()) {
    const int t = reached.back();
    reached.pop_back();
    for (const auto& [from, to] : edges_of(triangles[at(t)])) {
      const auto beside = owner.find({to, from});
      if (beside == owner.end() || is_main[at(beside->second)]) continue;
      const Vec3 main = normals[at(largest)], other = normals[at(beside->second)];
      const double tilt = std::atan2(length(cross(main, other)), dot(main, other));
      if (tilt * 180 / std::numbers::pi > kTilted_deg) continue;
      is_main[at(beside->second)] = 1;
      reached.push_back(beside->second);
    }
  }
  return is_main;
}

/// The loops round the main triangles; none if they touch themselves in a point.
std::vector<Loop> loops_round(std::span<const Triangle> triangles, std::span<const char> is_main) {
  std::set<WrittenEdge> rim;
  for (std::size_t t = 0; t < triangles.size(); ++t)
    if (is_main[t])
      for (const WrittenEdge& e : edges_of(triangles[t]))
        if (rim.erase({e.second, e.first}) == 0) rim.insert(e);
  std::map<int, int> next;
  for (const auto& [from, to] : rim)
    if (!next.emplace(from, to).second) return {};
  std::vector<Loop> loops;
  while (!next.empty()) {
    Loop& loop = loops.emplace_back();
    for (auto step = next.begin(); step != next.end(); step = next.find(loop.back())) {
      loop.push_back(step->second);
      next.erase(step);
    }
  }
  return loops;
}

class Parter {
 public:
  explicit Parter(Solid solid) : solid_(std::move(solid)) {
    for (std::size_t s = 0; s < solid_.shells.size(); ++s)
      for (const FacetId f : solid_.shells[s].facets) shell_of_[f.index()] = s;
    whole_of_.resize(solid_.facets.size());
    std::iota(whole_of_.begin(), whole_of_.end(), 0);
  }

  /// False if it cannot be parted.
  bool part(std::size_t facet, const Building& written, const Polygon& polygon) {
    const Facet whole = solid_.facets[facet];
    const auto as_written = written_facet(whole, written, polygon);
    if (!as_written) return false;
    const auto triangles = detail::triangulate_in_plane(as_written->points, as_written->rings);
    if (triangles.size() < 2) return false;
    std::vector<char> is_main = find_main(*as_written, triangles);
    std::vector<Loop> loops = loops_round(triangles, is_main);
    if (loops.empty() || std::ranges::find(is_main, 0) == is_main.end()) {
      // Nothing that hangs together well: all triangles are facets, the first in its place.
      is_main.assign(triangles.size(), 0);
      is_main[0] = 1;
      loops = {Loop(triangles[0].begin(), triangles[0].end())};
    }
    settle(*as_written);
    solid_.facets[facet].loops = in_vertices(*as_written, std::move(loops));
    for (std::size_t t = 0; t < triangles.size(); ++t)
      if (!is_main[t]) triangles_.push_back({facet, in_vertices(*as_written, triangles[t])});
    return true;
  }

  PartedSolid take() {
    for (const FacetTriangle& triangle : triangles_)
      if (!has_twin(triangle)) add(triangle);
    arrange_planes_and_loops(solid_);
    return {std::move(solid_), std::move(whole_of_)};
  }

 private:
  /// Its vertices get more planes than they had: they lie on them by decree.
  void settle(const WrittenFacet& facet) {
    for (const int v : facet.vertices) {
      Vertex& vertex = solid_.vertices[at(v)];
      if (vertex.is_meeting)
        vertex = {
            exact::to_metres(exact::round_to_grid(vertex.point, solid_.grid_m), solid_.grid_m),
            false};
    }
  }

  /// A triangle of a facet, in vertices of the solid.
  struct FacetTriangle {
    std::size_t facet = 0;
    Triangle corners{};
  };

  static Triangle in_vertices(const WrittenFacet& facet, Triangle triangle) {
    for (int& corner : triangle) corner = facet.vertices[at(corner)];
    return triangle;
  }

  static std::vector<Loop> in_vertices(const WrittenFacet& facet, std::vector<Loop> loops) {
    for (Loop& loop : loops)
      for (int& corner : loop) corner = facet.vertices[at(corner)];
    return loops;
  }

  /// Its neighbour has the same triangle the other way round: there is nothing between them.
  [[nodiscard]] bool has_twin(const FacetTriangle& triangle) const {
    const auto& [a, b, c] = triangle.corners;
    return std::ranges::any_of(triangles_, [&](const FacetTriangle& other) {
      const Triangle& o = other.corners;
      return o == Triangle{a, c, b} || o == Triangle{c, b, a} || o == Triangle{b, a, c};
    });
  }

  void add(const FacetTriangle& triangle) {
    const auto& [facet, vertices] = triangle;
    const Facet& whole = solid_.facets[facet];
    Facet part{whole.plane, {Loop(vertices.begin(), vertices.end())}, whole.polygons};
    std::array<exact::GridPoint, 3> corners;
    for (std::size_t i = 0; i < 3; ++i)
      corners[i] = exact::round_to_grid(solid_.vertices[at(vertices[i])].point, solid_.grid_m);
    exact::Vector128 across;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      across[i] = exact::Int128{corners[1][j] - corners[0][j]} * (corners[2][k] - corners[0][k]) -
                  exact::Int128{corners[1][k] - corners[0][k]} * (corners[2][j] - corners[0][j]);
    }
    if (const auto normal = exact::direction(across)) {
      const auto offset = static_cast<std::int64_t>(exact::dot(*normal, corners[0]));
      part.plane = PlaneId{static_cast<int>(solid_.planes.size())};
      solid_.planes.push_back(exact::make_plane(*normal, offset, solid_.grid_m));
    }
    solid_.shells[shell_of_.at(facet)].facets.push_back(
        FacetId{static_cast<int>(solid_.facets.size())});
    solid_.facets.push_back(std::move(part));
    whole_of_.push_back(static_cast<int>(facet));
  }

  Solid solid_;
  std::map<std::size_t, std::size_t> shell_of_;  ///< by facet
  std::vector<int> whole_of_;
  std::vector<FacetTriangle> triangles_;  ///< parted from their facets
};

}  // namespace

std::optional<PartedSolid> part_folded(const Solid& solid, const Building& written,
                                       std::span<const Finding> findings) {
  ORIEL_ASSERT(written.polygons.size() == solid.facets.size(), "one polygon for each facet");
  Parter parter(solid);
  bool has_parted = false;
  for (const Finding& finding : findings) {
    if (finding.code != Code::E345) return std::nullopt;
    const auto polygon = std::ranges::find(written.polygons, finding.polygon, &Polygon::source);
    if (polygon == written.polygons.end()) return std::nullopt;
    has_parted |= parter.part(at(finding.polygon), written, *polygon);
  }
  if (!has_parted) return std::nullopt;
  return parter.take();
}

}  // namespace oriel
