#include "io/levels/written_grid.h"

#include "io/cityjson/cityjson_source.h"
#include "io/cityjson/write/fresh_cityjson.h"
#include "io/cityjson/write/vertex_pool.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <utility>

namespace oriel {

namespace {

constexpr double kGridPerMetre = 1e6;
/// A micrometre has so many decimals of a metre.
constexpr int kDecimals = 6;

struct DocumentGrid {
  Transform transform;
  bool is_fixed = false;  ///< by the header of a stream
};

DocumentGrid grid_of(const Document& document) {
  if (document.source) return {document.source->transform, document.source->is_feature};
  return {detail::fresh_cityjson(document.buildings).transform, false};
}

/// How many decimals of a metre a whole number of micrometres has.
int decimals_of(std::int64_t number) {
  int decimals = kDecimals;
  while (decimals > 0 && number % 10 == 0) {
    number /= 10;
    --decimals;
  }
  return decimals;
}

void note_decimals(const MicrometreRing& ring, int& decimals) {
  for (const MicrometrePoint& p : ring)
    for (const std::int64_t number : p) decimals = std::max(decimals, decimals_of(number));
}

}  // namespace

WrittenGrid::WrittenGrid(const Document& document) {
  const DocumentGrid grid = grid_of(document);
  if (!grid.is_fixed) digits_ = detail::finer_digits(grid.transform);
  const Transform transform = detail::finer(grid.transform, digits_);
  scale_ = transform.scale;
  translate_ = transform.translate;
}

WrittenGrid::WrittenGrid(const Document& document, const std::vector<LevelState>& states) {
  const DocumentGrid grid = grid_of(document);
  int decimals = 0;
  for (const LevelState& state : states)
    for (const auto& [outer, facet] : state.facets) {
      note_decimals(outer, decimals);
      for (const MicrometreRing& hole : facet.holes) note_decimals(hole, decimals);
    }
  const Vec3 s = grid.transform.scale;
  // Half a step more: a scale of 0.001 is not exactly that.
  const double finest = 1.5 * std::pow(10, -decimals);
  while (!grid.is_fixed && digits_ < kDecimals &&
         std::max({s.x, s.y, s.z}) * std::pow(10, -digits_) > finest)
    ++digits_;
  const Transform transform = detail::finer(grid.transform, digits_);
  scale_ = transform.scale;
  translate_ = transform.translate;
}

MicrometrePoint WrittenGrid::place(Vec3 local_m, const Frame& frame) const {
  return grid_point(detail::rounded(local_m, frame, {scale_, translate_}), scale_, translate_);
}

MicrometrePoint grid_point(const std::array<std::int64_t, 3>& vertex, Vec3 scale, Vec3 translate) {
  const auto whole = [](std::int64_t number, double one, double from) {
    return std::llround((from + one * static_cast<double>(number)) * kGridPerMetre);
  };
  return {whole(vertex[0], scale.x, translate.x), whole(vertex[1], scale.y, translate.y),
          whole(vertex[2], scale.z, translate.z)};
}

namespace {

/// Vertices that rounding makes one are one.
std::vector<int> add_vertices(const Solid& solid, const Transform& transform, Building& written) {
  std::map<std::array<std::int64_t, 3>, int> numbers;
  std::vector<int> number_of;
  for (const Vertex& vertex : solid.vertices) {
    const auto key = detail::rounded(vertex.point, written.frame, transform);
    const auto [entry, is_new] = numbers.emplace(key, static_cast<int>(written.vertices.size()));
    if (is_new) written.vertices.push_back(detail::local_point(key, written.frame, transform));
    number_of.push_back(entry->second);
  }
  return number_of;
}

Polygon polygon_of(const Facet& facet, const std::vector<int>& number_of) {
  Polygon polygon;
  for (const Loop& loop : facet.loops) {
    auto& ring = polygon.rings.emplace_back();
    for (const int v : loop) ring.push_back(number_of[static_cast<std::size_t>(v)]);
  }
  return polygon;
}

}  // namespace

Building as_written(const Document& document, const Building& building, const Solid& solid) {
  Building written;
  written.id = building.id;
  written.lod = building.lod;
  written.frame = building.frame;
  const DocumentGrid grid = grid_of(document);
  const int digits = grid.is_fixed ? 0 : detail::finer_digits(grid.transform);
  const std::vector<int> number_of =
      add_vertices(solid, detail::finer(grid.transform, digits), written);
  std::vector<int> shells_of_lump;
  for (const Shell& shell : solid.shells) {
    const auto lump = static_cast<std::size_t>(shell.lump);
    if (shells_of_lump.size() <= lump) shells_of_lump.resize(lump + 1, 0);
    const int number = shell.is_cavity ? ++shells_of_lump[lump] : 0;
    for (const FacetId f : shell.facets) {
      Polygon polygon = polygon_of(solid.facets[f.index()], number_of);
      polygon.source = static_cast<int>(f.index());
      polygon.body = shell.lump;
      polygon.shell = number;
      written.polygons.push_back(std::move(polygon));
    }
  }
  std::ranges::sort(written.polygons, {}, &Polygon::source);
  return written;
}

}  // namespace oriel
