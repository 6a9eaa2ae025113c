#include "studio/session/standing.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <functional>
#include <iterator>
#include <map>
#include <set>
#include <string_view>
#include <utility>

namespace oriel::studio {

namespace {

/// Buildings in cells that touch each other are of one place.
constexpr double kCell_m = 5000;
/// Boxes of which so much of both together is in both: bodies do not lie so to each other.
constexpr double kShared = 0.2;
constexpr double kLeastGap_m = 4;
/// Rows are so much longer than they are many: a picture is wider than it is high.
constexpr double kWide = 2.5;

using MapCell = std::array<long long, 3>;
using StandeeNumbers = std::vector<std::size_t>;

/// The gap between units of which the widest is so wide.
double gap_between(double widest_m) {
  return std::max(kLeastGap_m, std::min(widest_m / 4, 5 * kLeastGap_m));
}

Vec3 middle_of(const Box& box) { return 0.5 * (box.min + box.max); }

MapCell cell_of(const Box& box) {
  const Vec3 at = middle_of(box);
  const auto along = [](double x) { return std::llround(std::floor(x / kCell_m)); };
  return {along(at.x), along(at.y), along(at.z)};
}

/// Those that have a place, by the reference system that they name, the system of most first. Those
/// that name none are taken to be of that one.
std::vector<StandeeNumbers> by_system(std::span<const Standee> all) {
  std::map<std::string_view, StandeeNumbers> named;
  for (std::size_t i = 0; i < all.size(); ++i)
    if (!all[i].box_m.is_empty()) named[all[i].system].push_back(i);
  const StandeeNumbers unnamed = std::exchange(named[""], {});
  std::vector<StandeeNumbers> systems;
  for (auto& [name, numbers] : named) systems.push_back(std::move(numbers));
  std::ranges::stable_sort(systems, std::greater(), &StandeeNumbers::size);
  systems[0].insert(systems[0].end(), unnamed.begin(), unnamed.end());
  std::ranges::sort(systems[0]);
  std::erase_if(systems, &StandeeNumbers::empty);
  return systems;
}

/// The cells around that with the most of some buildings, as far as one touches the next.
std::set<MapCell> main_cells(std::span<const Standee> all, const StandeeNumbers& some) {
  std::map<MapCell, std::size_t> counts;
  for (const std::size_t i : some) ++counts[cell_of(all[i].box_m)];
  const auto most =
      std::ranges::max_element(counts, {}, [](const auto& each) { return each.second; });
  const MapCell fullest = most->first;
  std::set<MapCell> near{fullest};
  std::vector<MapCell> ends{fullest};
  while (!ends.empty()) {
    const MapCell from = ends.back();
    ends.pop_back();
    for (int i = 0; i < 27; ++i) {
      const MapCell next{from[0] + i % 3 - 1, from[1] + i / 3 % 3 - 1, from[2] + i / 9 - 1};
      if (counts.contains(next) && near.insert(next).second) ends.push_back(next);
    }
  }
  return near;
}

bool lie_upon_each_other(const Box& a, const Box& b) {
  const auto area = [](double x, double y) { return std::max(0.0, x) * std::max(0.0, y); };
  const double shared = area(std::min(a.max.x, b.max.x) - std::max(a.min.x, b.min.x),
                             std::min(a.max.y, b.max.y) - std::max(a.min.y, b.min.y));
  const double both = area(a.max.x - a.min.x, a.max.y - a.min.y) +
                      area(b.max.x - b.min.x, b.max.y - b.min.y) - shared;
  const bool are_level = a.min.z < b.max.z && b.min.z < a.max.z;
  return are_level && shared > kShared * both;
}

/// Which buildings lie upon one of their own file, and upon one of another.
struct Lying {
  std::vector<bool> in_file, across;
};

Lying lying(std::span<const Standee> all, StandeeNumbers near) {
  Lying found{std::vector<bool>(all.size()), std::vector<bool>(all.size())};
  std::ranges::sort(near, {}, [&](std::size_t i) { return std::pair(all[i].box_m.min.x, i); });
  for (std::size_t p = 0; p < near.size(); ++p)
    for (std::size_t q = p + 1; q < near.size(); ++q) {
      const std::size_t i = near[p], j = near[q];
      if (all[j].box_m.min.x >= all[i].box_m.max.x) break;
      auto& lists = all[i].file == all[j].file ? found.in_file : found.across;
      if ((lists[i] && lists[j]) || !lie_upon_each_other(all[i].box_m, all[j].box_m)) continue;
      lists[i] = lists[j] = true;
    }
  return found;
}

/// What keeps together, in the order of the files: a file, or a building of one whose buildings lie
/// upon each other. Only those that have to move.
std::vector<StandeeNumbers> moving_units(std::span<const Standee> all, const StandeeNumbers& near) {
  const Lying found = lying(all, near);
  std::vector<StandeeNumbers> units, files;
  for (const std::size_t i : near) {
    if (files.empty() || all[files.back().front()].file != all[i].file) files.emplace_back();
    files.back().push_back(i);
  }
  for (const StandeeNumbers& file : files) {
    const auto lies_in = [&](std::size_t i) { return bool(found.in_file[i]); };
    const auto lies_across = [&](std::size_t i) { return bool(found.across[i]); };
    if (2 * static_cast<std::size_t>(std::ranges::count_if(file, lies_in)) > file.size()) {
      for (const std::size_t i : file)
        if (lies_in(i) || lies_across(i)) units.push_back({i});
    } else if (std::ranges::any_of(file, lies_across)) {
      units.push_back(file);
    }
  }
  return units;
}

Box box_of(std::span<const Standee> all, const StandeeNumbers& unit) {
  Box box;
  for (const std::size_t i : unit) box.grow(all[i].box_m);
  return box;
}

/// Stands units side by side in rows, from the back to the front and each from the left to the
/// right. The first row begins at `begin`, in the picture. Returns the right end of the longest.
double stand_in_rows(std::span<const Standee> all, const std::vector<StandeeNumbers>& units,
                     Vec3 begin, std::vector<Standing>& made) {
  std::vector<Box> boxes;
  double area_m2 = 0, widest_m = 0, tallest_m = 0;
  for (const StandeeNumbers& unit : units) {
    const Box& box = boxes.emplace_back(box_of(all, unit));
    const Vec3 size = box.max - box.min;
    widest_m = std::max({widest_m, size.x, size.y});
    tallest_m = std::max(tallest_m, size.z);
    area_m2 += (size.x + kLeastGap_m) * (size.y + kLeastGap_m);
  }
  const double gap_m = gap_between(widest_m);
  const double row_m = std::sqrt(kWide * area_m2);
  double depth_m = 0, end_m = begin.x;
  Vec3 next = begin + Vec3{gap_m, 0, 0};
  for (std::size_t i = 0; i < units.size(); ++i) {
    const Vec3 size = boxes[i].max - boxes[i].min;
    if (next.x > begin.x + gap_m && next.x + size.x > begin.x + gap_m + row_m) {
      next = {begin.x + gap_m, next.y - depth_m - gap_m - tallest_m / 2, begin.z};
      depth_m = 0;
    }
    for (const std::size_t number : units[i])
      made[number].origin_m = boxes[i].min - (next - Vec3{0, size.y, 0});
    next.x += size.x + gap_m;
    end_m = std::max(end_m, next.x);
    depth_m = std::max(depth_m, size.y);
  }
  return end_m;
}

/// Puts what is far away out of sight, `from_m` to the right, but no farther: floats would not tell
/// apart the corners of a house that is far from the origin. What is of one cell stays together,
/// unless it lies upon each other.
void put_out_of_sight(std::span<const Standee> all, const StandeeNumbers& far, double from_m,
                      std::vector<Standing>& made) {
  for (const std::size_t i : far) {
    const MapCell cell = cell_of(all[i].box_m);
    const auto at = [&](std::size_t axis) { return static_cast<double>(cell[axis]) * kCell_m; };
    made[i].origin_m = Vec3{at(0), at(1), at(2)} - Vec3{from_m, 0, 0};
  }
  double next_m = from_m + 2 * kCell_m;
  for (const StandeeNumbers& unit : moving_units(all, far)) {
    const Box box = box_of(all, unit);
    for (const std::size_t i : unit) made[i].origin_m = box.min - Vec3{next_m, 0, 0};
    next_m += box.max.x - box.min.x + kLeastGap_m;
  }
}

}  // namespace

Box box_of(const Building& building) {
  Box box;
  for (const Vec3& vertex : building.vertices) box.grow(vertex + building.frame.origin_m);
  return box;
}

std::vector<Standing> standings(std::span<const Standee> all) {
  std::vector<Standing> made(all.size());
  StandeeNumbers main, far;
  std::vector<StandeeNumbers> units;
  const auto take_away = [&](const StandeeNumbers& unit) {
    for (const std::size_t i : unit) made[i].is_moved = true;
    units.push_back(unit);
  };
  for (const StandeeNumbers& system : by_system(all)) {
    const std::set<MapCell> cells = main_cells(all, system);
    const auto is_near = [&](std::size_t i) { return cells.contains(cell_of(all[i].box_m)); };
    StandeeNumbers near;
    std::ranges::copy_if(system, std::back_inserter(near), is_near);
    const Vec3 middle = middle_of(box_of(all, near));
    for (const std::size_t i : system) {
      if (is_near(i)) continue;
      far.push_back(i);
      made[i].away_m = length(middle_of(all[i].box_m) - middle);
    }
    for (const StandeeNumbers& unit : moving_units(all, near)) take_away(unit);
    if (main.empty()) {
      main = std::move(near);
    } else {
      std::erase_if(near, [&](std::size_t i) { return made[i].is_moved; });
      if (!near.empty()) take_away(near);
    }
  }
  if (main.empty()) return made;

  Box whole, rest, frames;
  for (const std::size_t i : main) {
    whole.grow(all[i].box_m);
    if (made[i].is_moved) continue;
    rest.grow(all[i].box_m);
    frames.grow(all[i].frame_m);
  }
  const Vec3 origin_m = rest.is_empty() ? whole.min : frames.min;
  for (Standing& standing : made) standing.origin_m = origin_m;
  const Vec3 begin =
      rest.is_empty() ? Vec3{} : Vec3{rest.max.x - origin_m.x, 0, rest.min.z - origin_m.z};
  const double end_m = stand_in_rows(all, units, begin, made);
  const double from_m = std::max(end_m, whole.max.x - whole.min.x) + 4 * kCell_m;
  put_out_of_sight(all, far, from_m, made);
  return made;
}

}  // namespace oriel::studio
