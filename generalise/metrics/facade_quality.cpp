#include "generalise/metrics/facade_quality.h"

#include "kernel/base/index.h"
#include "kernel/geometry/directions.h"
#include "kernel/geometry/planar.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <span>
#include <tuple>
#include <utility>

namespace oriel {

namespace {

/// Openings are on one facade if their walls look the same way to 2 degrees and lie no further
/// apart than this: frames stand before the wall, panes behind it.
constexpr double kSameWay_cos = 0.9994, kSamePlane_m = 0.3;

/// A polygon that is written, its outer ring.
struct WrittenPolygon {
  Outline outline;
  Vec3 twice_area;
};

WrittenPolygon measured(Outline outline) {
  Vec3 twice;
  for (std::size_t i = 0; i < outline.size(); ++i)
    twice = twice + cross(outline[i] - outline[0], outline[(i + 1) % outline.size()] - outline[0]);
  return {std::move(outline), twice};
}

/// By the numbers of LabelledBuilding::surface_of_polygon.
std::vector<WrittenPolygon> polygons_of(const Building& building,
                                        const LabelledBuilding& labelled) {
  std::vector<WrittenPolygon> polygons(labelled.surface_of_polygon.size());
  const auto put = [&](std::size_t number, Outline outline) {
    if (number < polygons.size()) polygons[number] = measured(std::move(outline));
  };
  if (labelled.geometry) {
    const Solid& solid = *labelled.geometry;
    for (std::size_t f = 0; f < solid.facets.size(); ++f) {
      Outline outline;
      for (const int v : solid.facets[f].loops.at(0))
        outline.push_back(solid.vertices[at(v)].point);
      put(f, std::move(outline));
    }
    return polygons;
  }
  for (const Polygon& polygon : building.polygons) {
    if (polygon.source < 0 || polygon.rings.empty()) continue;
    Outline outline;
    for (const int v : polygon.rings[0]) outline.push_back(building.vertices[at(v)]);
    put(at(polygon.source), std::move(outline));
  }
  return polygons;
}

/// Of the largest of some polygons; zero if there are none.
Vec3 main_normal(const std::vector<int>& numbers, const std::vector<WrittenPolygon>& polygons) {
  Vec3 largest;
  for (const int number : numbers) {
    const Vec3 area = polygons[at(number)].twice_area;
    if (length(area) > length(largest)) largest = area;
  }
  return normalised(largest);
}

WrittenOpening opening_of(const std::string& type, Vec3 normal, const std::vector<int>& numbers,
                          const std::vector<WrittenPolygon>& polygons) {
  WrittenOpening opening;
  opening.type = type;
  opening.is_in_wall = looks_aside(normal);
  if (opening.is_in_wall) normal = normalised({normal.x, normal.y, 0});
  opening.normal = normal;
  // Of a wall, `along` runs to the right for who looks at it from outside.
  Vec3 along = opening.is_in_wall ? Vec3{-normal.y, normal.x, 0} : cross({0, 1, 0}, normal);
  if (length(along) < kSteepestRoof) along = {1, 0, 0};
  along = normalised(along);
  const Vec3 up = cross(normal, along);
  Box box;  // along, up, out
  for (const int number : numbers)
    for (const Vec3 p : polygons[at(number)].outline)
      box.grow(Vec3{dot(along, p), dot(up, p), dot(normal, p)});
  opening.left_m = box.min.x;
  opening.right_m = box.max.x;
  opening.bottom_m = box.min.y;
  opening.top_m = box.max.y;
  opening.offset_m = box.max.z;
  return opening;
}

using OpeningRow = std::vector<const WrittenOpening*>;

bool share_facade(const WrittenOpening& a, const WrittenOpening& b) {
  return dot(a.normal, b.normal) >= kSameWay_cos &&
         std::abs(a.offset_m - b.offset_m) <= kSamePlane_m;
}

/// Those in walls, by facade.
std::vector<OpeningRow> facades_of(const std::vector<WrittenOpening>& openings) {
  std::vector<OpeningRow> facades;
  for (const WrittenOpening& opening : openings) {
    if (!opening.is_in_wall) continue;
    auto facade = std::ranges::find_if(
        facades, [&](const OpeningRow& known) { return share_facade(*known[0], opening); });
    if (facade == facades.end()) facade = facades.insert(facades.end(), OpeningRow());
    facade->push_back(&opening);
  }
  return facades;
}

double overlap_m(double from, double to, double other_from, double other_to) {
  return std::max(0.0, std::min(to, other_to) - std::max(from, other_from));
}

bool are_level(const WrittenOpening& a, const WrittenOpening& b) {
  return a.type == b.type && 2 * overlap_m(a.bottom_m, a.top_m, b.bottom_m, b.top_m) >=
                                 std::min(a.height_m(), b.height_m());
}

/// The openings of a facade in rows, each from left to right: an opening is in the row of the first
/// one, from below, that it is level with.
std::vector<OpeningRow> rows_of(OpeningRow facade) {
  std::ranges::sort(facade, [](const WrittenOpening* a, const WrittenOpening* b) {
    return std::tuple(a->bottom_m, a->left_m) < std::tuple(b->bottom_m, b->left_m);
  });
  std::vector<OpeningRow> rows;
  for (const WrittenOpening* opening : facade) {
    auto row = std::ranges::find_if(
        rows, [&](const OpeningRow& known) { return are_level(*known[0], *opening); });
    if (row == rows.end()) row = rows.insert(rows.end(), OpeningRow());
    row->push_back(opening);
  }
  for (OpeningRow& row : rows) std::ranges::sort(row, {}, &WrittenOpening::left_m);
  return rows;
}

double spread_m(const std::vector<double>& values) {
  const auto [least, most] = std::ranges::minmax(values);
  return most - least;
}

void count_row(const OpeningRow& row, FacadeQuality& quality) {
  if (row.size() < 2) return;
  std::vector<double> sills, lintels, gaps;
  for (std::size_t i = 0; i < row.size(); ++i) {
    sills.push_back(row[i]->bottom_m);
    lintels.push_back(row[i]->top_m);
    if (i > 0) gaps.push_back(row[i]->left_m - row[i - 1]->right_m);
  }
  ++quality.rows;
  if (spread_m(sills) <= kAligned_m || spread_m(lintels) <= kAligned_m) ++quality.aligned_rows;
  if (gaps.size() < 2) return;
  ++quality.long_rows;
  if (spread_m(gaps) <= kAligned_m) ++quality.even_rows;
}

/// The area of a facade's openings that lies on their mirror images.
double mirrored_m2(const OpeningRow& facade) {
  double left = Box::kInfinity, right = -Box::kInfinity;
  for (const WrittenOpening* opening : facade) {
    left = std::min(left, opening->left_m);
    right = std::max(right, opening->right_m);
  }
  double area = 0;
  for (const WrittenOpening* a : facade)
    for (const WrittenOpening* b : facade)
      if (a->type == b->type)
        area +=
            overlap_m(a->left_m, a->right_m, left + right - b->right_m, left + right - b->left_m) *
            overlap_m(a->bottom_m, a->top_m, b->bottom_m, b->top_m);
  return area;
}

/// How far apart two openings of a facade are that face each other, or nothing.
double gap_m(const WrittenOpening& a, const WrittenOpening& b) {
  const bool are_beside = overlap_m(a.bottom_m, a.top_m, b.bottom_m, b.top_m) > 0;
  const bool are_above = overlap_m(a.left_m, a.right_m, b.left_m, b.right_m) > 0;
  if (are_beside == are_above) return Box::kInfinity;
  return are_beside ? std::max(b.left_m - a.right_m, a.left_m - b.right_m)
                    : std::max(b.bottom_m - a.top_m, a.bottom_m - b.top_m);
}

}  // namespace

std::vector<WrittenOpening> written_openings(const Building& building,
                                             const LabelledBuilding& labelled) {
  const std::vector<WrittenPolygon> polygons = polygons_of(building, labelled);
  std::vector<std::vector<int>> polygons_of_surface(labelled.surfaces.size());
  for (std::size_t i = 0; i < polygons.size(); ++i) {
    const int surface = labelled.surface_of_polygon[i];
    if (surface >= 0 && !polygons[i].outline.empty())
      polygons_of_surface[at(surface)].push_back(static_cast<int>(i));
  }
  std::vector<WrittenOpening> openings;
  for (std::size_t s = 0; s < labelled.surfaces.size(); ++s) {
    const SemanticSurface& surface = labelled.surfaces[s];
    if (polygons_of_surface[s].empty() || (surface.type != "Window" && surface.type != "Door"))
      continue;
    Vec3 normal;
    if (surface.parent >= 0)
      normal = main_normal(polygons_of_surface[at(surface.parent)], polygons);
    if (length(normal) == 0) normal = main_normal(polygons_of_surface[s], polygons);
    if (length(normal) > 0)
      openings.push_back(opening_of(surface.type, normal, polygons_of_surface[s], polygons));
  }
  return openings;
}

FacadeQuality facade_quality(const std::vector<WrittenOpening>& openings) {
  FacadeQuality quality;
  double in_walls_m2 = 0, mirrored = 0;
  for (const WrittenOpening& opening : openings) {
    ++quality.openings;
    quality.openings_m2 += opening.area_m2();
    if (opening.is_in_wall) in_walls_m2 += opening.area_m2();
  }
  for (const OpeningRow& facade : facades_of(openings)) {
    mirrored += mirrored_m2(facade);
    for (const OpeningRow& row : rows_of(facade)) count_row(row, quality);
  }
  // Openings that lie over each other would count twice.
  if (in_walls_m2 > 0) quality.symmetry = std::min(1.0, mirrored / in_walls_m2);
  return quality;
}

OpeningGaps opening_gaps(const std::vector<WrittenOpening>& openings, double least_m) {
  OpeningGaps gaps;
  for (const OpeningRow& facade : facades_of(openings))
    for (std::size_t i = 0; i < facade.size(); ++i)
      for (std::size_t k = i + 1; k < facade.size(); ++k) {
        const double gap = gap_m(*facade[i], *facade[k]);
        gaps.smallest_m = std::min(gaps.smallest_m, gap);
        if (gap < least_m - kRoundedOff_m) ++gaps.narrow;
      }
  return gaps;
}

}  // namespace oriel
