#include "tests/kernel/segment/complex_checks.h"

#include "kernel/geometry/planar.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

#include <doctest/doctest.h>

namespace oriel::test {

namespace {

std::vector<CellId> all_cells(const Segmentation& s) { return cells_of(s, FeatureId{}); }

std::vector<Outline> outlines_of(const CellComplex& complex, const Face& face) {
  std::vector<Outline> outlines;
  for (const Loop& loop : face.loops) {
    outlines.emplace_back();
    for (const int v : loop)
      outlines.back().push_back(complex.vertices()[static_cast<std::size_t>(v)].point);
  }
  return outlines;
}

void check_faces(const Segmented& s, const CellComplex& complex) {
  const auto cells = static_cast<int>(s.segmentation.cells.size());
  const auto vertices = static_cast<int>(complex.vertices().size());
  for (const Face& face : complex.faces()) {
    CHECK(face.front != face.behind);
    for (const CellId side : {face.front, face.behind}) CHECK(side.value < cells);
    CHECK(face.area_m2 > 0);
    REQUIRE_FALSE(face.loops.empty());
    const Vec3 normal = s.segmentation.planes[face.plane.index()].normal;
    for (std::size_t i = 0; i < face.loops.size(); ++i) {
      CHECK(face.loops[i].size() >= 3);
      for (const int v : face.loops[i]) REQUIRE((v >= 0 && v < vertices));
      const double area = signed_area_m2(complex.vertices(), face.loops[i], normal);
      CHECK((area > 0) == (i == 0));
    }
  }
}

/// The definition, on both sides of faces.
void check_sides(const Segmented& s, const CellComplex& complex,
                 const ComplexExactness& exactness) {
  SlowOwner owner(s.segmentation);
  std::size_t asked = 0;
  for (std::size_t f = 0; f < complex.faces().size();
       f += static_cast<std::size_t>(exactness.probe_every)) {
    const Face& face = complex.faces()[f];
    const Vec3 normal = s.segmentation.planes[face.plane.index()].normal;
    const auto outlines = outlines_of(complex, face);
    const auto inside = interior_point(outlines, normal);
    if (!inside || !contains_clearly(outlines, normal, *inside, 2 * exactness.probe_m)) continue;
    CAPTURE(f);
    ++asked;
    CHECK(owner(*inside + exactness.probe_m * normal) == face.front);
    CHECK(owner(*inside - exactness.probe_m * normal) == face.behind);
  }
  CHECK(asked > 0);
}

void check_contacts(const CellComplex& complex, const std::vector<CellId>& cells) {
  std::vector<CellId> sides = cells;
  sides.insert(sides.begin(), CellId{});
  for (const CellId a : sides) {
    double sum = 0, around = 0;
    const auto contacts = complex.neighbours(a);
    CHECK(std::ranges::is_sorted(contacts, {}, &Contact::cell));
    for (const auto& [b, area] : contacts) {
      CHECK(a != b);
      CHECK(complex.contact_area_m2(a, b) == doctest::Approx(area).epsilon(1e-12));
      CHECK(complex.contact_area_m2(a, b) == complex.contact_area_m2(b, a));
      const auto back = complex.neighbours(b);
      CHECK(std::ranges::find(back, a, &Contact::cell) != back.end());
      sum += area;
    }
    for (const FaceId id : complex.faces_of(a)) around += complex.face(id).area_m2;
    CHECK(sum == doctest::Approx(around).epsilon(1e-12));
    CHECK(complex.contact_area_m2(a, a) == 0);
  }
}

/// The directed edges of a boundary that are not met by as many opposite ones.
std::size_t open_edges(const CellComplex& complex, std::span<const CellId> cells) {
  std::multiset<std::pair<int, int>> edges;
  for (const BoundaryFace& part : complex.boundary(cells))
    for (const Loop& loop : complex.face(part.face).loops)
      for (std::size_t i = 0; i < loop.size(); ++i) {
        const int from = loop[i], to = loop[(i + 1) % loop.size()];
        edges.insert(part.is_reversed ? std::pair{to, from} : std::pair{from, to});
      }
  return static_cast<std::size_t>(std::ranges::count_if(edges, [&](const auto& edge) {
    return edges.count(edge) != edges.count({edge.second, edge.first});
  }));
}

void check_measures(const Segmented& s, const CellComplex& complex,
                    const ComplexExactness& exactness) {
  const auto near = [&](double value) {
    return doctest::Approx(value).epsilon(exactness.area_rel);
  };
  const auto solid = cells_of_sign(s.segmentation, 1);
  if (exactness.has_sound_rings)
    CHECK(complex.boundary_area_m2(solid) == near(surface_m2(s.solid)));
  CHECK(volume_m3(s.segmentation, complex, solid) == near(volume_m3(s.solid)));
  double sum = 0;
  for (const CellId cell : solid) sum += volume_m3(s.segmentation, complex, {&cell, 1});
  CHECK(sum == near(volume_m3(s.solid)));
  const double slack = exactness.area_rel * volume_m3(s.solid);
  for (const CellId id : all_cells(s.segmentation)) {
    CAPTURE(id.value);
    const double volume = volume_m3(s.segmentation, complex, {&id, 1});
    CHECK(volume > -slack);
    CHECK(volume < s.segmentation.cells[id.index()].volume_m3 + slack);
    CHECK(open_edges(complex, {&id, 1}) == 0);
  }
  CHECK(complex.open_edge_count() == 0);
  CHECK(open_edges(complex, solid) == 0);
  for (const FeatureId id : all_features(s.segmentation))
    CHECK(open_edges(complex, cells_of(s.segmentation, id)) == 0);
}

}  // namespace

double volume_m3(const Segmentation& segmentation, const CellComplex& complex,
                 std::span<const CellId> cells) {
  double sum = 0;
  for (const BoundaryFace& part : complex.boundary(cells)) {
    const Face& face = complex.face(part.face);
    sum += (part.is_reversed ? -1 : 1) * face.area_m2 *
           segmentation.planes[face.plane.index()].offset_m;
  }
  return sum / 3;
}

void check_complex(const Segmented& s, const CellComplex& complex,
                   const ComplexExactness& exactness) {
  check_faces(s, complex);
  check_sides(s, complex, exactness);
  check_contacts(complex, all_cells(s.segmentation));
  check_measures(s, complex, exactness);
}

}  // namespace oriel::test
