#include "kernel/solidify/crossings/uncross.h"

#include "kernel/base/index.h"
#include "kernel/geometry/planar.h"
#include "kernel/solidify/crossings/crossings.h"
#include "kernel/solidify/crossings/faces.h"
#include "kernel/solidify/mend/cells.h"
#include "kernel/solidify/mend/duplicates.h"
#include "kernel/solidify/mend/t_vertices.h"
#include "kernel/solidify/shells/edge_groups.h"
#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <optional>
#include <set>
#include <utility>
#include <vector>

namespace oriel::detail {

namespace {

class WindingFinder {
 public:
  WindingFinder(const Soup& soup, const PolygonCells& cells, Work& work)
      : soup_(soup), cells_(cells), work_(work), winding_(2 * soup.polygons.size()) {
    beside_.resize(winding_.size());
    for (int p = 0; p < soup.polygon_count(); ++p) {
      beside_[at(cells.front[at(p)])].push_back(p);
      beside_[at(cells.back[at(p)])].push_back(p);
    }
  }

  std::optional<Numbers> run() {
    std::vector<char> is_done(at(cells_.piece_count), 0);
    for (int p = 0; p < soup_.polygon_count(); ++p) {
      const int piece = cells_.piece[at(p)];
      if (std::exchange(is_done[at(piece)], 1)) continue;
      if (work_.is_used_up()) return std::nullopt;
      reach(cells_.outer[at(piece)], winding_of_others(p));
      spread();
    }
    if (is_contradictory_) return std::nullopt;
    Numbers front;
    for (const int cell : cells_.front) front.push_back(*winding_[at(cell)]);
    return front;
  }

 private:
  void reach(int cell, int winding) {
    auto& known = winding_[at(cell)];
    if (known) {
      is_contradictory_ |= *known != winding;
      return;
    }
    known = winding;
    reached_.push_back(cell);
  }

  void spread() {
    while (!reached_.empty()) {
      const int cell = reached_.back();
      reached_.pop_back();
      const int winding = *winding_[at(cell)];
      for (const int p : beside_[at(cell)]) {
        if (cells_.front[at(p)] == cell) reach(cells_.back[at(p)], winding + 1);
        if (cells_.back[at(p)] == cell) reach(cells_.front[at(p)], winding - 1);
      }
    }
  }

  /// How often the other pieces of its body wind round the piece of a polygon.
  [[nodiscard]] int winding_of_others(int polygon) const {
    if (cells_.piece_count == 1) return 0;
    work_.add(soup_.corner_count());
    const auto ring = soup_.corners_of(polygon);
    const Vec3 eye = 0.5 * (exact::to_metres(soup_.points[at(ring[0])], 1) +
                            exact::to_metres(soup_.points[at(ring[1])], 1));
    double sum = 0;
    for (int p = 0; p < soup_.polygon_count(); ++p)
      if (cells_.piece[at(p)] != cells_.piece[at(polygon)] &&
          soup_.polygons[at(p)].body == soup_.polygons[at(polygon)].body)
        sum += winding_part(outlines_of(soup_, p), eye);
    return static_cast<int>(std::lround(sum));
  }

  const Soup& soup_;
  const PolygonCells& cells_;
  Work& work_;
  std::vector<std::optional<int>> winding_;  ///< by cell
  std::vector<Numbers> beside_;              ///< by cell its polygons
  Numbers reached_;
  bool is_contradictory_ = false;
};

/// How often the surface that the polygons of a body make winds round the cell in front of each
/// polygon: 0 outside, 1 inside, 2 where it overlaps itself, −1 where it is turned inside out;
/// round the cell behind the polygon once more. Nothing if that is contradictory: then the polygons
/// of a body are no closed surfaces, all of them oriented, that meet in common edges only.
std::optional<Numbers> find_windings(const Soup& soup, const PolygonCells& cells, Work& work) {
  return WindingFinder(soup, cells, work).run();
}

Soup without_opposites(const Soup& soup) {
  const std::vector<char> is_opposite = find_opposites(soup);
  SoupBuilder builder(soup);
  for (int p = 0; p < soup.polygon_count(); ++p)
    if (!is_opposite[at(p)]) builder.add_polygon(soup, p);
  return builder.finish();
}

/// As many polygons run one way along every edge as the other way.
bool is_cycle(const Soup& soup) {
  const ShellMesh mesh = linked_rings(soup);
  bool all_paired = !soup.polygons.empty();
  EdgeGroups(soup, mesh).for_each([&](EdgeGroup group) {
    const auto runs_up = [&](int h) {
      return soup.corners[at(h)] < soup.corners[at(mesh.next[at(h)])];
    };
    all_paired &= 2 * std::ranges::count_if(group, runs_up) == std::ssize(group);
  });
  return all_paired;
}

/// The soup with the polygons of every body turned round that encloses less than nothing.
Soup outward(const Soup& soup) {
  const std::vector<PolygonShape> shapes = shapes_of(soup);
  std::map<int, double> volume;  // by body
  for (int p = 0; p < soup.polygon_count(); ++p) {
    const Vec3 corner = exact::to_metres(soup.points[at(soup.corners_of(p).front())], 1) -
                        exact::to_metres(soup.points[0], 1);
    volume[soup.polygons[at(p)].body] += shapes[at(p)].area * dot(shapes[at(p)].unit, corner);
  }
  SoupBuilder builder(soup);
  for (int p = 0; p < soup.polygon_count(); ++p)
    builder.add_polygon(soup, p, volume.at(soup.polygons[at(p)].body) < 0);
  return builder.finish();
}

/// What finding the shapes, the cells and the windings of pieces takes.
constexpr std::int64_t kStepsPerPieceCorner = 32;

std::optional<Uncrossed> uncross_within(const Soup& soup, double reach, double weld, Work& work) {
  auto [parted, cut] = cut_at_crossings(soup, reach, weld, work, RingKind::crossing);
  if (work.is_used_up()) return std::nullopt;
  auto [joined, inserted] = insert_t_vertices(parted, weld, Inserted::all, &work);
  work.add(kStepsPerPieceCorner * joined.corner_count());
  if (work.is_used_up()) return std::nullopt;
  const Soup pieces = without_opposites(joined);
  if (pieces.polygons.empty()) return std::nullopt;
  const std::vector<PolygonShape> shapes = shapes_of(pieces);
  const PolygonCells cells = find_cells(pieces, shapes);
  const auto windings = find_windings(pieces, cells, work);
  if (!windings) return std::nullopt;
  Uncrossed out;
  out.cut = cut;
  SoupBuilder builder(pieces);
  std::set<int> kept, all;
  for (const SoupPolygon& polygon : soup.polygons) all.insert(polygon.source);
  for (int p = 0; p < pieces.polygon_count(); ++p) {
    if ((*windings)[at(p)] != 0) continue;
    builder.add_polygon(pieces, p);
    kept.insert(pieces.polygons[at(p)].source);
  }
  std::ranges::set_difference(all, kept, std::back_inserter(out.left_out));
  const std::vector<PolygonShape> whole = shapes_of(soup);
  for (int p = 0; p < soup.polygon_count(); ++p)
    if (!kept.contains(soup.polygons[at(p)].source))
      out.left_out_m2 += whole[at(p)].area * soup.grid_m * soup.grid_m;
  out.soup = builder.finish();
  if (out.soup.polygons.empty()) return std::nullopt;
  return out;
}

}  // namespace

std::optional<Uncrossed> uncross(const Soup& soup, const Tolerances& tolerances, Work& work) {
  if (!is_cycle(soup)) return std::nullopt;
  const Soup facing = outward(soup);
  const double reach = tolerances.plane_offset_m / soup.grid_m;
  const double weld = tolerances.weld_m / soup.grid_m;
  for (const auto& [on_plane, together] :
       {std::pair{reach, weld}, {reach / 10, weld}, {reach / 100, weld / 10}})
    if (auto uncrossed = uncross_within(facing, on_plane, together, work);
        uncrossed || work.is_used_up())
      return uncrossed;
  return std::nullopt;
}

}  // namespace oriel::detail
