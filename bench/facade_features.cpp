#include "bench/facade_features.h"

#include <array>
#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>
#include <limits>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace oriel::bench {

namespace {

/// id, bldg, fac, host, hk, sense, incl, h, a, b, c, x, st, vol; the truth follows.
constexpr std::size_t kNumbers = 14;
using Line = std::array<double, kNumbers>;

Line parse(std::string_view text) {
  Line line{};
  for (double& value : line) {
    const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
    if (result.ec != std::errc()) throw std::runtime_error("no number in " + std::string(text));
    text.remove_prefix(static_cast<std::size_t>(result.ptr - text.data()) + 1);
  }
  return line;
}

double host_inclination(int kind) {
  if (kind == 0) return 90;
  return kind == 1 ? 30 : std::numeric_limits<double>::quiet_NaN();
}

FacadeBuilding make_building(const std::vector<Line>& lines) {
  const auto at = [](const Line& line, std::size_t i) { return static_cast<int>(line[i]); };
  FacadeBuilding building{FeatureTable(std::to_string(at(lines[0], 1)), lines.size()), {}, {}};
  const int first = at(lines[0], 0), first_facade = at(lines[0], 2);
  static constexpr std::array<std::pair<Attribute, std::size_t>, 8> kColumns = {
      {{Attribute::inclination, 6},
       {Attribute::base_height, 7},
       {Attribute::a, 8},
       {Attribute::b, 9},
       {Attribute::c, 10},
       {Attribute::edge_gap, 11},
       {Attribute::storey, 12},
       {Attribute::volume, 13}}};
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const FeatureId row{static_cast<int>(i)};
    const Line& line = lines[i];
    building.table.set_id(row, std::to_string(at(line, 0)));
    building.table.set(row, Attribute::sense,
                       std::string(at(line, 5) == 0 ? "hole" : "protrusion"));
    building.table.set(row, Attribute::host_inclination, host_inclination(at(line, 4)));
    for (const auto& [attribute, column] : kColumns)
      building.table.set(row, attribute, line[column]);
    building.facades.push_back(at(line, 2) - first_facade);
    building.hosts.push_back(at(line, 3) < 0 ? -1 : at(line, 3) - first);
  }
  return building;
}

}  // namespace

std::vector<FacadeBuilding> read_facade_features(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw std::runtime_error("cannot read " + path);
  std::vector<FacadeBuilding> buildings;
  std::vector<Line> lines;
  std::string text;
  std::getline(file, text);
  while (std::getline(file, text)) {
    const Line line = parse(text);
    if (!lines.empty() && lines.back()[1] != line[1]) {
      buildings.push_back(make_building(lines));
      lines.clear();
    }
    lines.push_back(line);
  }
  if (!lines.empty()) buildings.push_back(make_building(lines));
  return buildings;
}

FeatureGraph relate(const FacadeBuilding& building) {
  const int rows = static_cast<int>(building.hosts.size());
  std::vector<FeatureGraph::Pair> host, contains;
  for (int row = 0; row < rows; ++row) {
    const int on = building.hosts[static_cast<std::size_t>(row)];
    if (on < 0) continue;
    host.emplace_back(FeatureId{row}, FeatureId{on});
    contains.emplace_back(FeatureId{on}, FeatureId{row});
  }
  FeatureGraph graph;
  graph.set_classes("same_facade", building.facades);
  graph.set("host", std::move(host));
  graph.set("contains", std::move(contains));
  return graph;
}

}  // namespace oriel::bench
