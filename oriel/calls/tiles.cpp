#include "oriel/tiles.h"

#include "generalise/series/scale_series.h"
#include "io/cityjson/material_colours.h"
#include "io/mesh/mesh_writer.h"
#include "kernel/mesh/level_distance.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace oriel {

namespace {

/// Distances between levels are no further off.
constexpr double kDistance_m = 0.005;

FlatMesh mesh_of(const Building& building, const LabelledBuilding& level,
                 const FaceColours& colours) {
  MeshSource source;
  append_building(source, building, level, colours);
  return flat_mesh(source, building.frame.origin_m);
}

/// Facets of a level list the input polygons that they are made of, as the states of the series
/// have them.
void name_polygons(LabelledBuilding& level, const ScaleSeries& series, double scale) {
  LevelState state = series.finest;
  if (!move_state(state, series.operations, 0, scale) || !level.geometry) return;
  auto facet = level.geometry->facets.begin();
  for (const auto& [outer, of_state] : state.facets) (facet++)->polygons = of_state.polygons;
}

/// A building that gains one level after the other, from fine to coarse.
class TileLevels {
 public:
  TileLevels(const Building& building, const FaceColours& colours)
      : building_(building), colours_(colours) {
    out_.id = building.id;
    out_.crs = building.frame.crs;
    out_.origin_m = building.frame.origin_m;
  }

  void add(const LabelledBuilding& level) {
    FlatMesh mesh = mesh_of(building_, level, colours_);
    const bool is_new = out_.meshes.empty() || out_.meshes.back() != mesh;
    std::optional<LevelSurface> surface;
    if (is_new && level.geometry) surface.emplace(*level.geometry);
    if (!out_.mesh_at.empty())
      out_.error_m.push_back(last_ && surface ? level_distance_m(*last_, *surface, kDistance_m)
                                              : 0);
    if (is_new) {
      out_.meshes.push_back(std::move(mesh));
      last_ = std::move(surface);
    }
    out_.mesh_at.push_back(static_cast<std::uint32_t>(out_.meshes.size()) - 1);
  }

  TileBuilding take() { return std::move(out_); }

 private:
  const Building& building_;
  const FaceColours& colours_;
  TileBuilding out_;
  std::optional<LevelSurface> last_;
};

}  // namespace

std::optional<TileBuilding> tile_building(const Building& building, const Series& made,
                                          const std::vector<double>& scales,
                                          const FaceColours& colours) {
  std::vector<OutputRecord> drawn = levels(made, scales);
  LabelledBuilding as_read;
  as_read.building = building.id;
  TileLevels tile(building, colours);
  for (std::size_t i = 0; i < scales.size(); ++i) {
    LabelledBuilding& level = made.buildings.empty() ? as_read : drawn[i].buildings[0];
    if (!colours.empty() && !made.buildings.empty())
      name_polygons(level, made.buildings[0].series, scales[i]);
    tile.add(level);
  }
  TileBuilding out = tile.take();
  if (out.meshes.front().triangles.empty()) return std::nullopt;
  return out;
}

std::vector<double> scales_between(double first, double last, int levels) {
  constexpr double kDigits = 3;
  std::vector<double> scales;
  for (int i = 0; i < levels; ++i) {
    const double scale = first * std::pow(last / first, static_cast<double>(i) / (levels - 1));
    const double unit = std::pow(10, std::floor(std::log10(scale)) + 1 - kDigits);
    scales.push_back(
        std::max(1.0, unit >= 1 ? std::round(scale / unit) * unit : std::round(scale)));
  }
  scales.front() = first;
  scales.back() = last;
  std::ranges::sort(scales);
  const auto rest = std::ranges::unique(scales);
  scales.erase(rest.begin(), rest.end());
  return scales;
}

}  // namespace oriel
