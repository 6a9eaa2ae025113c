#include "kernel/solidify/noise.h"
#include "tests/support/changed.h"
#include "tests/support/houses.h"
#include "tests/support/solidified.h"

#include <algorithm>
#include <numbers>

#include <doctest/doctest.h>
#include <rapidcheck.h>

namespace oriel {
namespace {

using test::bodies;
using test::solid_of;

double area_of(const Building& building, const Polygon& polygon) {
  Vec3 sum;
  for (const auto& ring : polygon.rings)
    for (std::size_t i = 0; i < ring.size(); ++i)
      sum = sum + cross(building.vertices[static_cast<std::size_t>(ring[i])],
                        building.vertices[static_cast<std::size_t>(ring[(i + 1) % ring.size()])]);
  return length(sum) / 2;
}

double volume_of(const Building& building) {
  double sum = 0;
  for (const Polygon& polygon : building.polygons)
    for (const auto& ring : polygon.rings)
      for (std::size_t i = 1; i + 1 < ring.size(); ++i)
        sum += dot(building.vertices[static_cast<std::size_t>(ring[0])],
                   cross(building.vertices[static_cast<std::size_t>(ring[i])],
                         building.vertices[static_cast<std::size_t>(ring[i + 1])]));
  return sum / 6;
}

/// All that a shuffle must leave alone.
bool is_same(const Solid& p, const Solid& q) {
  const auto plane = [](const Plane& a, const Plane& b) {
    return a.coefficients == b.coefficients && a.offset == b.offset && a.normal == b.normal;
  };
  const auto vertex = [](const Vertex& a, const Vertex& b) {
    return a.point == b.point && a.is_meeting == b.is_meeting;
  };
  const auto facet = [](const Facet& a, const Facet& b) {
    return a.plane == b.plane && a.loops == b.loops && a.polygons.size() == b.polygons.size();
  };
  const auto shell = [](const Shell& a, const Shell& b) {
    return a.facets == b.facets && a.lump == b.lump && a.is_cavity == b.is_cavity;
  };
  return p.grid_m == q.grid_m && std::ranges::equal(p.planes, q.planes, plane) &&
         std::ranges::equal(p.vertices, q.vertices, vertex) &&
         std::ranges::equal(p.facets, q.facets, facet) &&
         std::ranges::equal(p.shells, q.shells, shell);
}

TEST_SUITE("kernel/solidify") {
  TEST_CASE("a solid has the volume and the area of its polygons") {
    for (const auto& [name, make] : bodies()) {
      CAPTURE(std::string(name));
      const Building building = make();
      const Solid solid = solid_of(building);
      double area = 0;
      for (const Polygon& polygon : building.polygons) area += area_of(building, polygon);
      CHECK(volume_m3(solid) == doctest::Approx(volume_of(building)).epsilon(1e-6));
      CHECK(surface_m2(solid) == doctest::Approx(area).epsilon(1e-6));
    }
  }

  TEST_CASE("what was shuffled and put in order is the same solid but for the numbers") {
    for (const auto& [name, make] : bodies()) {
      CAPTURE(std::string(name));
      const Building building = test::in_order(make());
      const Solid solid = solid_of(building);
      CHECK(rc::check([&] {
        std::vector<int> origin;
        const Building shuffled =
            test::shuffled(building, *rc::gen::arbitrary<std::uint64_t>(), &origin);
        const auto other = solidify(test::in_order(shuffled, &origin), {});
        RC_ASSERT(other.value.has_value());
        RC_ASSERT(is_same(*other.value, solid));
        for (std::size_t f = 0; f < solid.facets.size(); ++f) {
          std::vector<int> polygons;
          for (const int p : other.value->facets[f].polygons)
            polygons.push_back(origin[static_cast<std::size_t>(p)]);
          std::ranges::sort(polygons);
          RC_ASSERT(polygons == solid.facets[f].polygons);
        }
      }));
    }
  }

  TEST_CASE("polygons in pieces and whole facets with rings make the same solid") {
    for (const auto& [name, make] : bodies()) {
      CAPTURE(std::string(name));
      const Solid pieces = solid_of(make()), whole = solid_of(test::in_whole_facets(make()));
      CHECK(whole.facets.size() == pieces.facets.size());
      CHECK(whole.planes.size() == pieces.planes.size());
      CHECK(whole.vertices.size() == pieces.vertices.size());
      CHECK(volume_m3(whole) == doctest::Approx(volume_m3(pieces)).epsilon(1e-6));
    }
  }

  TEST_CASE("noise below the tolerance changes no count of facets and hardly a volume") {
    for (const auto& [name, make] : bodies()) {
      CAPTURE(std::string(name));
      const Building building = test::in_whole_facets(make());
      const Solid solid = solid_of(building);
      const double area = surface_m2(solid);
      for (std::uint64_t seed = 0; seed < 5; ++seed) {
        const Solid noisy = solid_of(test::with_noise(building, 0.0003, seed));
        CHECK(noisy.facets.size() == solid.facets.size());
        CHECK(noisy.vertices.size() == solid.vertices.size());
        CHECK(noisy.planes.size() == solid.planes.size());
        CHECK(std::abs(volume_m3(noisy) - volume_m3(solid)) < 0.001 * area);
      }
    }
  }

  TEST_CASE("the tolerance follows the noise of the building and nothing else") {
    const Tolerances defaults;
    for (const auto& [name, make] : bodies()) {
      CAPTURE(std::string(name));
      const Building building = test::in_whole_facets(make());
      CHECK(noise_of(building) < 1e-6);
      if (building.polygons.size() < 12) continue;  // too few to tell much of the noise
      for (const double size_m : {0.0005, 0.002, 0.005}) {
        const double noise_m = noise_of(test::with_noise(building, size_m, 1));
        CHECK(noise_m > 0.3 * size_m);
        CHECK(noise_m < 1.0 * size_m);
        const double offset_m = fitted_to_noise(defaults, noise_m).plane_offset_m;
        CHECK(offset_m >= defaults.plane_offset_m);
        CHECK(offset_m <= 0.01);
        if (size_m < 0.001)
          CHECK(offset_m == defaults.plane_offset_m);
        else
          CHECK(offset_m > size_m);
      }
    }
    Tolerances wide;
    wide.plane_offset_m = 0.05;
    CHECK(fitted_to_noise(wide, 0.004).plane_offset_m == 0.05);
  }

  TEST_CASE("the halves of rectangles show the noise of triangles") {
    const Building halves = test::in_triangles(test::BoxBody()
                                                   .add({0, 0, 0}, {12, 8, 6})
                                                   .remove({2, 0, 1}, {4, 0.5, 2})
                                                   .remove({7, 0, 1}, {9, 0.5, 2})
                                                   .build());
    CHECK(noise_of(halves) < 1e-6);
    for (const double size_m : {0.0005, 0.002, 0.005}) {
      const Building noisy = test::with_noise(halves, size_m, 1);
      const double noise_m = noise_of(noisy);
      CHECK(noise_m > 0.45 * size_m);
      CHECK(noise_m < 0.8 * size_m);
      Building apart = noisy;  // each triangle with corners of its own
      apart.vertices.clear();
      for (Polygon& polygon : apart.polygons)
        for (int& v : polygon.rings[0]) {
          apart.vertices.push_back(noisy.vertices[static_cast<std::size_t>(v)]);
          v = static_cast<int>(apart.vertices.size()) - 1;
        }
      CHECK(noise_of(apart) == noise_m);
    }
  }

  TEST_CASE("a fold between two triangles is no noise") {
    Building tent;
    tent.vertices = {{0, 0, 0}, {8, 0, 0}};
    for (int i = 0; i < 20; ++i) {
      const double fold = i % 2 == 0 ? 0.5 : -3;  // a shallow ridge, and a steep one
      tent.vertices.push_back({2, 3, fold});
      tent.vertices.push_back({2, -3, fold});
      const int n = static_cast<int>(tent.vertices.size());
      for (std::vector<int> ring : {std::vector{0, 1, n - 2}, std::vector{1, 0, n - 1}}) {
        Polygon polygon;
        polygon.source = static_cast<int>(tent.polygons.size());
        polygon.rings = {std::move(ring)};
        tent.polygons.push_back(std::move(polygon));
      }
    }
    CHECK(noise_of(tent) == 0);
  }

  TEST_CASE("a handful of polygons tells no noise") {
    Building box = test::with_noise(test::in_whole_facets(bodies().front().make()), 0.005, 1);
    box.polygons.resize(5);
    CHECK(noise_of(box) == 0);
    CHECK(noise_of(test::in_triangles(box)) == 0);
    CHECK(noise_of(Building{}) == 0);
  }

  TEST_CASE("coordinates far from the origin make the same solid in a frame of their own") {
    for (const auto& [name, make] : bodies()) {
      CAPTURE(std::string(name));
      const Building building = make();
      const Solid solid = solid_of(building);
      const Vec3 shift{600000, 5000000, 500};
      const Building moved =
          test::framed(test::mapped(building, [&](Vec3 p) { return p + shift; }));
      CHECK(length(moved.frame.origin_m - shift) < 3);
      CHECK(is_same(solid_of(test::framed(building)), solid_of(moved)));
      CHECK(test::outcome_of(test::mapped(building, [&](Vec3 p) { return p + shift; })) == "E501");
    }
  }

  TEST_CASE("turning and mirroring keep volume and area and counts") {
    const Vec3 axis = normalised({1, 2, 3});
    for (const auto& [name, make] : bodies()) {
      CAPTURE(std::string(name));
      const Building building = make();
      const Solid solid = solid_of(building);
      const auto by = [&](Vec3 about, double radians) {
        return test::mapped(building, [=](Vec3 p) { return test::turned(p, about, radians); });
      };
      for (const Building& other : {by({0, 0, 1}, std::numbers::pi / 2), by({0, 0, 1}, 0.7),
                                    by(axis, 1), test::mirrored(building)}) {
        const Solid turned = solid_of(other);
        CHECK(volume_m3(turned) == doctest::Approx(volume_m3(solid)).epsilon(1e-6));
        CHECK(surface_m2(turned) == doctest::Approx(surface_m2(solid)).epsilon(1e-6));
        CHECK(turned.facets.size() == solid.facets.size());
        CHECK(turned.planes.size() == solid.planes.size());
        CHECK(turned.vertices.size() == solid.vertices.size());
        CHECK(turned.shells.size() == solid.shells.size());
      }
    }
  }
}

}  // namespace
}  // namespace oriel
