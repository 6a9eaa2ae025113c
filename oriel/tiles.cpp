#include "oriel/tiles.h"

#include "kernel/io/mesh/mesh_writer.h"
#include "kernel/mesh/level_distance.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <string_view>
#include <utility>

namespace oriel {

namespace {

/// Distances between levels are no further off.
constexpr double kDistance_m = 0.005;

FlatMesh mesh_of(const Building& building, const LabelledBuilding& level) {
  MeshSource source;
  append_building(source, building, level);
  return flat_mesh(source, building.frame.origin_m);
}

/// A building that gains one level after the other, from fine to coarse.
class TileLevels {
 public:
  explicit TileLevels(const Building& building) : building_(building) {
    out_.id = building.id;
    out_.crs = building.frame.crs;
    out_.origin_m = building.frame.origin_m;
  }

  void add(const LabelledBuilding& level) {
    FlatMesh mesh = mesh_of(building_, level);
    const bool is_new = out_.meshes.empty() || out_.meshes.back() != mesh;
    if (!out_.mesh_at.empty()) out_.error_m.push_back(is_new ? distance(level) : 0);
    if (is_new) {
      out_.meshes.push_back(std::move(mesh));
      last_ = level.geometry;
    }
    out_.mesh_at.push_back(static_cast<std::uint32_t>(out_.meshes.size()) - 1);
  }

  TileBuilding take() { return std::move(out_); }

 private:
  [[nodiscard]] double distance(const LabelledBuilding& level) const {
    if (!last_ || !level.geometry) return 0;
    return level_distance_m(*last_, *level.geometry, kDistance_m);
  }

  const Building& building_;
  TileBuilding out_;
  std::optional<Solid> last_;
};

}  // namespace

std::vector<TileBuilding> tile_buildings(const Document& document, const Series& made,
                                         const std::vector<double>& scales) {
  std::vector<OutputRecord> levels;
  for (const double scale : scales) levels.push_back(at(made, scale));
  std::map<std::string_view, std::size_t> drawn;
  for (std::size_t i = 0; i < made.buildings.size(); ++i)
    drawn.emplace(made.buildings[i].building, i);
  std::vector<TileBuilding> out;
  for (const Building& building : document.buildings) {
    TileLevels tile(building);
    const auto found = drawn.find(building.id);
    LabelledBuilding as_read;
    as_read.building = building.id;
    for (const OutputRecord& level : levels)
      tile.add(found == drawn.end() ? as_read : level.buildings[found->second]);
    out.push_back(tile.take());
    if (out.back().meshes.front().triangles.empty()) out.pop_back();
  }
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
