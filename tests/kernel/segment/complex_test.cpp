#include "kernel/geometry/planar.h"
#include "kernel/segment/complex/cell_complex.h"
#include "kernel/segment/complex/refine.h"
#include "tests/kernel/segment/complex_checks.h"
#include "tests/support/changed.h"
#include "tests/support/corpus.h"
#include "tests/support/houses.h"
#include "tests/support/near.h"

#include <array>
#include <numbers>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::check_complex;
using test::nearly;
using test::segmented;
using test::Segmented;

constexpr CellId kOutside;

/// The only cell whose leaf has this volume.
CellId cell_of(const Segmentation& s, double volume) {
  CellId found;
  for (int c = 0; c < std::ssize(s.cells); ++c)
    if (s.cells[static_cast<std::size_t>(c)].volume_m3 == nearly(volume)) {
      REQUIRE_FALSE(found.is_valid());
      found = CellId{c};
    }
  REQUIRE(found.is_valid());
  return found;
}

double surface_of(const Segmentation& s, CellId cell) {
  return surface_m2(test::solid_of(s, s.cells[cell.index()]));
}

double area_around(const CellComplex& complex, CellId cell) {
  double area = 0;
  for (const Contact& contact : complex.neighbours(cell)) area += contact.area_m2;
  return area;
}

/// True if all inner rings of the facets lie in their outer ones.
bool has_sound_rings(const Solid& solid) {
  for (const Facet& facet : solid.facets) {
    std::vector<Outline> outer(1);
    for (const int v : facet.loops[0])
      outer[0].push_back(solid.vertices[static_cast<std::size_t>(v)].point);
    const Vec3 normal = solid.planes[facet.plane.index()].normal;
    for (std::size_t i = 1; i < facet.loops.size(); ++i)
      for (const int v : facet.loops[i])
        if (!contains(outer, normal, solid.vertices[static_cast<std::size_t>(v)].point))
          return false;
  }
  return true;
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("T1 each box stands on the slab with the area of its foot") {
    const Segmented s = segmented(test::two_boxes_on_a_slab(), Order::paper);
    const CellComplex complex = cell_complex(s.segmentation);
    const CellId slab = cell_of(s.segmentation, 64);
    CHECK(complex.neighbours(slab).size() == 3);
    for (const Contact& contact : complex.neighbours(slab)) {
      if (contact.cell == kOutside) continue;
      CHECK(contact.area_m2 == nearly(2));
      CHECK(complex.contact_area_m2(contact.cell, kOutside) == nearly(8));
    }
    // Nothing overlaps here: the faces around a cell are the cell's surface.
    for (const CellId cell : cells_of(s.segmentation, {}))
      CHECK(area_around(complex, cell) == nearly(surface_of(s.segmentation, cell)));
  }

  TEST_CASE("T2 the wall around a pocket meets its air in five faces and the cap is the air's") {
    const Segmented s = segmented(test::pocket(), Order::paper);
    const CellComplex complex = cell_complex(s.segmentation);
    const CellId wall = cell_of(s.segmentation, 32), air = cell_of(s.segmentation, 1);
    CHECK(complex.contact_area_m2(wall, air) == nearly(5));
    CHECK(complex.contact_area_m2(air, kOutside) == nearly(1));
    CHECK(complex.contact_area_m2(wall, kOutside) == nearly(surface_of(s.segmentation, wall) - 1));
    CHECK(area_around(complex, wall) == nearly(surface_m2(s.solid)));
    // With its pocket the wall is its leaf again.
    const std::array both{wall, air};
    CHECK(complex.boundary_area_m2(both) == nearly(surface_of(s.segmentation, wall)));
    CHECK(test::volume_m3(s.segmentation, complex, both) == nearly(32));
  }

  TEST_CASE("a block in a terrace's air meets the air and the floor and not the outside") {
    const Segmented s = segmented(test::terrace_with_block(), Order::natural);
    const CellComplex complex = cell_complex(s.segmentation);
    const CellId house = cell_of(s.segmentation, 480), air = cell_of(s.segmentation, 48);
    const CellId block = cell_of(s.segmentation, 9);
    CHECK(complex.contact_area_m2(block, air) == nearly(6 + 2 * 4.5 + 2 * 3));
    CHECK(complex.contact_area_m2(block, house) == nearly(6));
    CHECK(complex.contact_area_m2(block, kOutside) == 0);
    CHECK(complex.contact_area_m2(air, house) == nearly(24 - 6 + 2 * (6 + 4) * 2));
    // The terrace as a feature is its air and the block in it.
    const FeatureId terrace = test::feature_in(s.segmentation, {2, 2, 4}, {8, 6, 6});
    const auto cells = cells_of(s.segmentation, terrace);
    CHECK(cells.size() == 2);
    CHECK(complex.boundary_area_m2(cells) == nearly(2 * 24 + 2 * (6 + 4) * 2));
  }

  TEST_CASE("a cavity is closed in by its cell and never meets the outside") {
    const Segmented s = segmented(test::cavity_and_lumps(), Order::natural);
    const CellComplex complex = cell_complex(s.segmentation);
    const CellId cavity = cell_of(s.segmentation, 64), shell = cell_of(s.segmentation, 216);
    const CellId inside = cell_of(s.segmentation, 8);
    CHECK(complex.contact_area_m2(cavity, kOutside) == 0);
    CHECK(complex.contact_area_m2(cavity, shell) == nearly(96));
    CHECK(complex.contact_area_m2(cavity, inside) == nearly(24));
    CHECK(complex.neighbours(inside).size() == 1);
  }

  TEST_CASE("air that passes through a later cut is no contact of the parts") {
    const Segmented s = segmented(test::BoxBody()
                                      .add({0, 0, 0}, {10, 4, 4})
                                      .add({10, 0, 0}, {13, 2, 2})
                                      .remove({9, 0, 0.5}, {11, 0.5, 1.5})
                                      .build(),
                                  Order::paper);
    const CellComplex complex = cell_complex(s.segmentation);
    const CellId air = cell_of(s.segmentation, 1);
    CHECK(s.segmentation.cells[air.index()].sign == -1);
    const CellId block = cell_of(s.segmentation, 160), step = cell_of(s.segmentation, 12);
    CHECK(complex.contact_area_m2(block, step) == nearly(2 * 2 - 0.5));
    CHECK(complex.contact_area_m2(block, air) == complex.contact_area_m2(step, air));
    check_complex(s, complex);
  }

  TEST_CASE("in the complex of every body each face has the two cells that the tree says") {
    for (const auto& [name, make] : test::bodies())
      for (const Order order : {Order::natural, Order::paper}) {
        CAPTURE(std::string(name));
        CAPTURE(to_string(order));
        const Segmented s = segmented(make(), order);
        check_complex(s, cell_complex(s.segmentation));
      }
  }

  TEST_CASE("turning a body and moving it far away leaves the contacts as they are") {
    const auto areas_of = [](const CellComplex& complex, const Segmentation& s) {
      std::vector<double> areas;
      for (const CellId cell : cells_of(s, {}))
        for (const Contact& contact : complex.neighbours(cell)) areas.push_back(contact.area_m2);
      std::ranges::sort(areas);
      return areas;
    };
    const Vec3 axis{0, 0, 1};  // natural cuts know the ground
    for (const auto& [name, make] : test::bodies()) {
      CAPTURE(std::string(name));
      const Segmented s = segmented(make(), Order::natural);
      const Segmented changed = segmented(
          test::framed(test::mapped(make(),
                                    [&](Vec3 p) {
                                      return test::turned(p, axis, 1) + Vec3{6e5, 5e6, 400};
                                    })),
          Order::natural);
      const auto areas = areas_of(cell_complex(s.segmentation), s.segmentation);
      const auto others = areas_of(cell_complex(changed.segmentation), changed.segmentation);
      REQUIRE(areas.size() == others.size());
      for (std::size_t i = 0; i < areas.size(); ++i)
        CHECK(areas[i] == doctest::Approx(others[i]).epsilon(1e-4));
    }
  }

  TEST_CASE("a body in other units has the same contacts") {
    for (const double scale : {0.001, 1000.0}) {
      CAPTURE(scale);
      SegmentOptions options;
      options.tolerances.plane_offset_m *= scale;
      options.tolerances.weld_m *= scale;
      const Segmented s =
          segmented(test::mapped(test::full_house(), [&](Vec3 p) { return scale * p; }), options);
      const CellComplex complex = cell_complex(s.segmentation, options.tolerances);
      CHECK(complex.open_edge_count() == 0);
      CHECK(complex.boundary_area_m2(cells_of_sign(s.segmentation, 1)) ==
            nearly(surface_m2(s.solid)));
      const Segmented plain = segmented(test::full_house(), Order::natural);
      CHECK(complex.faces().size() == cell_complex(plain.segmentation).faces().size());
    }
  }

  TEST_CASE("the complex of every sample is sound in both orders") {
    for (const Building& building : test::samples().buildings)
      for (const Order order : {Order::natural, Order::paper}) {
        CAPTURE(building.id);
        CAPTURE(to_string(order));
        const Segmented s = segmented(building, order);
        check_complex(s, cell_complex(s.segmentation));
      }
  }

  TEST_CASE("slow: the complex of every building of random3dcity is sound in both orders") {
    ORIEL_NEEDS_SHARED(shared);
    const test::Corpus corpus =
        test::corpus_of(test::files_in(shared / "data" / "random3dcity", ".stripped.city.json"));
    CHECK(corpus.buildings.size() >= 70);
    int unsound_rings = 0;
    for (const Building& building : corpus.buildings)
      for (const Order order : {Order::natural, Order::paper}) {
        CAPTURE(building.id);
        CAPTURE(to_string(order));
        const Segmented s = segmented(building, order);
        const bool is_sound = has_sound_rings(s.solid);
        unsound_rings += is_sound ? 0 : 1;
        check_complex(s, cell_complex(s.segmentation), {1e-9, 1e-5, 10, is_sound});
      }
    CHECK(unsound_rings <= 2 * 4);
  }

  TEST_CASE("slow: most complexes of surveyed buildings close and all but a few keep the volume") {
    ORIEL_NEEDS_SHARED(shared);
    auto files = test::files_in(shared / "data" / "ingolstadt", ".stripped.city.json");
    files.push_back((shared / "data" / "3dbag" / "tile_5910.city.jsonl").string());
    test::Corpus corpus = test::corpus_of(files);
    std::erase_if(corpus.buildings, [](const Building& b) { return b.polygons.size() > 300; });
    int closed = 0, close = 0;
    for (const Building& building : corpus.buildings) {
      const Segmented s = segmented(building, Order::natural);
      const CellComplex complex = cell_complex(s.segmentation);
      for (const Face& face : complex.faces()) CHECK(face.front != face.behind);
      const double volume =
          test::volume_m3(s.segmentation, complex, cells_of_sign(s.segmentation, 1));
      closed += complex.open_edge_count() == 0 ? 1 : 0;
      close += std::abs(volume / volume_m3(s.solid) - 1) < 1e-3 ? 1 : 0;
    }
    const int all = static_cast<int>(corpus.buildings.size());
    MESSAGE(closed << " of " << all << " close, " << close << " have the volume to 0.1 %");
    CHECK(all > 150);
    CHECK(closed > all * 8 / 10);
    CHECK(close > all * 95 / 100);
  }

  TEST_CASE("vertices that are appended to a pool are those of one made of all") {
    std::vector<Vertex> all;
    for (int i = 0; i < 600; ++i) {
      const double x = 0.0007 * ((i * 37) % 101), y = 0.0005 * ((i * 53) % 97);
      all.push_back({{x, y, 0.0003 * (i % 7)}, false});
    }
    const VertexPool whole(all, 0.001);
    for (const std::size_t first : {0U, 1U, 17U, 599U}) {
      VertexPool pool({all.begin(), all.begin() + static_cast<std::ptrdiff_t>(first)}, 0.001);
      pool.append(std::span(all).subspan(first));
      for (int v = 0; v < std::ssize(all); ++v)
        CHECK(pool.represented_by(v) == whole.represented_by(v));
    }
  }

  TEST_CASE("edges that cross where both end are not cut there round after round") {
    const PlaneAxes axes({0, 0, 1});
    VertexPool pool({}, 0.001);
    // The second one begins beside the first one's begin, nearer than doubles tell from its length.
    const int a = pool.add({0, 0, 0}), b = pool.add({1, 0, 0});
    const int c = pool.add({0, 1e-18, 0}), d = pool.add({0.5, -1, 0});
    Work work;
    const auto edges = refine({{a, b, 0, 1}, {c, d, 1, 1}}, axes, pool, work);
    CHECK(edges.size() == 2);
    CHECK(pool.vertices().size() == 4);
  }
}

}  // namespace
}  // namespace oriel
