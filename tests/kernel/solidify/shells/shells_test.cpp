#include "tests/support/changed.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <rapidcheck.h>

namespace oriel {
namespace {

using test::BoxBody;
using test::outcome_of;
using test::solid_of;

std::size_t cavities_of(const Solid& solid) {
  return static_cast<std::size_t>(
      std::ranges::count_if(solid.shells, [](const Shell& s) { return s.is_cavity; }));
}

double volume_of(const Solid& solid, const Shell& shell) {
  Solid one = solid;
  one.facets.clear();
  for (const FacetId f : shell.facets) one.facets.push_back(solid.facets[f.index()]);
  return volume_m3(one);
}

/// Every facet is in one shell, every shell is closed, outer shells enclose volume and cavities
/// take it away.
void check_shells(const Solid& solid) {
  std::vector<int> uses(solid.facets.size(), 0);
  for (const Shell& shell : solid.shells) {
    for (const FacetId f : shell.facets) ++uses[f.index()];
    CHECK((volume_of(solid, shell) < 0) == shell.is_cavity);
  }
  CHECK(std::ranges::count(uses, 1) == std::ssize(uses));
}

TEST_SUITE("kernel/solidify") {
  TEST_CASE("a closed void is a cavity of its lump") {
    const Solid solid =
        solid_of(BoxBody().add({0, 0, 0}, {4, 4, 4}).remove({1, 1, 1}, {2, 3, 2}).build());
    CHECK(solid.shells.size() == 2);
    CHECK(cavities_of(solid) == 1);
    CHECK(solid.shells[1].lump == solid.shells[0].lump);
    CHECK(volume_m3(solid) == doctest::Approx(64 - 2).epsilon(1e-12));
    CHECK(surface_m2(solid) == doctest::Approx(96 + 10).epsilon(1e-12));
    check_shells(solid);
  }

  TEST_CASE("a cavity said by the input is one whichever way its polygons run") {
    for (const bool is_turned : {false, true}) {
      Building building = BoxBody().add({0, 0, 0}, {4, 4, 4}).remove({1, 1, 1}, {2, 3, 2}).build();
      building.is_solid = true;
      for (Polygon& polygon : building.polygons) {
        const Vec3 p = building.vertices[static_cast<std::size_t>(polygon.rings[0][0])];
        polygon.shell = p.x > 0 && p.x < 4 && p.y > 0 && p.y < 4 && p.z > 0 && p.z < 4 ? 1 : 0;
        if (is_turned && polygon.shell == 1) std::ranges::reverse(polygon.rings[0]);
      }
      CHECK(std::ranges::count(building.polygons, 1, &Polygon::shell) == 6);
      CHECK(outcome_of(building) == (is_turned ? "solid E308" : "solid"));
      const Solid solid = solid_of(building);
      CHECK(cavities_of(solid) == 1);
      CHECK(volume_m3(solid) == doctest::Approx(62).epsilon(1e-12));
      check_shells(solid);
    }
  }

  TEST_CASE("a cavity that is larger than the shell around its corner leaves no solid") {
    Building building = test::BoxBody().add({0, 0, 0}, {4, 4, 4}).build();
    const Building larger = test::BoxBody().add({1, 1, 1}, {9, 9, 9}).build();
    building.is_solid = true;
    const int first = static_cast<int>(building.vertices.size());
    building.vertices.insert(building.vertices.end(), larger.vertices.begin(),
                             larger.vertices.end());
    for (Polygon polygon : larger.polygons) {
      polygon.shell = 1;
      polygon.source = static_cast<int>(building.polygons.size());
      for (int& v : polygon.rings[0]) v += first;
      building.polygons.push_back(std::move(polygon));
    }
    CHECK(test::outcome_of(building) == "E308 E310");
  }

  TEST_CASE("what is joined of an exterior shell and a cavity is a solid in whatever order") {
    // Two boxes that share a face, one of them turned inside out and called a cavity, without the
    // face at its far end or that they share; or without the top of the first.
    const auto is_at = [](const Building& of, const Polygon& polygon, Vec3 along, double offset) {
      return std::ranges::all_of(polygon.rings[0], [&](int v) {
        return dot(of.vertices[static_cast<std::size_t>(v)], along) == offset;
      });
    };
    const Building other = test::BoxBody().add({2, 0, 0}, {4, 2, 2}).build();
    RepairOptions cutting;
    cutting.crossings = Crossings::cut;
    for (const int missing : {0, 2, 4})
      for (std::uint64_t seed = 0; seed < 8; ++seed) {
        Building building = test::BoxBody().add({0, 0, 0}, {2, 2, 2}).build();
        building.is_solid = true;
        if (missing == 0)
          std::erase_if(building.polygons, [&](const Polygon& polygon) {
            return is_at(building, polygon, {0, 0, 1}, 2);
          });
        const int first = static_cast<int>(building.vertices.size());
        building.vertices.insert(building.vertices.end(), other.vertices.begin(),
                                 other.vertices.end());
        for (Polygon polygon : other.polygons) {
          if (missing > 0 && is_at(other, polygon, {1, 0, 0}, missing)) continue;
          polygon.shell = 1;
          for (int& v : polygon.rings[0]) v += first;
          std::ranges::reverse(polygon.rings[0]);
          building.polygons.push_back(std::move(polygon));
        }
        for (std::size_t p = 0; p < building.polygons.size(); ++p)
          building.polygons[p].source = static_cast<int>(p);
        CAPTURE(missing);
        CAPTURE(seed);
        const auto made = solidify(test::in_order(test::shuffled(building, seed)), {}, cutting);
        REQUIRE(made.value.has_value());
        CHECK(cavities_of(*made.value) == 0);
        CHECK(volume_m3(*made.value) == doctest::Approx(missing == 2 ? 16 : 8).epsilon(1e-12));
      }
  }

  TEST_CASE("bodies apart are lumps and a cavity belongs to the lump around it") {
    const Solid solid = solid_of(BoxBody()
                                     .add({0, 0, 0}, {1, 1, 1})
                                     .add({2, 0, 0}, {6, 4, 4})
                                     .remove({3, 1, 1}, {4, 2, 2})
                                     .add({7, 0, 0}, {8, 1, 1})
                                     .build());
    REQUIRE(solid.shells.size() == 4);
    CHECK(cavities_of(solid) == 1);
    const auto cavity = std::ranges::find(solid.shells, true, &Shell::is_cavity);
    const auto around = std::ranges::find_if(solid.shells, [&](const Shell& shell) {
      return shell.lump == cavity->lump && !shell.is_cavity;
    });
    CHECK(volume_of(solid, *around) == doctest::Approx(64).epsilon(1e-12));
    CHECK(volume_m3(solid) == doctest::Approx(1 + 64 - 1 + 1).epsilon(1e-12));
    check_shells(solid);
  }

  TEST_CASE("a lump inside a cavity is a lump of its own") {
    const Solid solid = solid_of(BoxBody()
                                     .add({0, 0, 0}, {5, 5, 5})
                                     .remove({1, 1, 1}, {4, 4, 4})
                                     .add({2, 2, 2}, {3, 3, 3})
                                     .build());
    CHECK(solid.shells.size() == 3);
    CHECK(cavities_of(solid) == 1);
    CHECK(volume_m3(solid) == doctest::Approx(125 - 27 + 1).epsilon(1e-12));
    check_shells(solid);
  }

  TEST_CASE("two boxes that share an edge are parted there") {
    const Solid solid =
        solid_of(BoxBody().add({0, 0, 0}, {1, 1, 2}).add({1, 1, 0}, {2, 2, 2}).build());
    CHECK(solid.shells.size() == 2);
    CHECK(solid.facets.size() == 12);
    CHECK(solid.vertices.size() == 16);
    CHECK(volume_m3(solid) == doctest::Approx(4).epsilon(1e-12));
    check_shells(solid);
  }

  TEST_CASE("boxes that share an edge are parted there in whatever order their vertices come") {
    const Building body = BoxBody().add({0, 0, 1}, {1, 1, 3}).add({1, 1, 1}, {2, 2, 3}).build();
    for (std::uint64_t seed = 0; seed < 8; ++seed) {
      const Solid solid = solid_of(test::shuffled(body, seed));
      CHECK(solid.shells.size() == 2);
      CHECK(volume_m3(solid) == doctest::Approx(4).epsilon(1e-12));
      check_shells(solid);
    }
  }

  TEST_CASE("boxes that share a level edge high above the ground are parted there") {
    for (const bool is_along_x : {false, true}) {
      const Vec3 far = is_along_x ? Vec3{1, 2, 32} : Vec3{2, 1, 32};
      const Vec3 near = is_along_x ? Vec3{0, 1, 31} : Vec3{1, 0, 31};
      const Solid solid = solid_of(BoxBody().add({0, 0, 0}, {1, 1, 31}).add(near, far).build());
      CHECK(solid.shells.size() == 2);
      CHECK(volume_m3(solid) == doctest::Approx(31 + 1).epsilon(1e-12));
      check_shells(solid);
    }
  }

  TEST_CASE("four polygons at an edge are paired round material and not across air") {
    // A box with a notch whose inner edge lies in the top: two steps that touch in a line.
    const Solid solid = solid_of(BoxBody()
                                     .add({0, 0, 0}, {4, 4, 1})
                                     .add({0, 0, 1}, {2, 2, 2})
                                     .add({2, 2, 1}, {4, 4, 2})
                                     .build());
    CHECK(solid.shells.size() == 1);
    CHECK(volume_m3(solid) == doctest::Approx(16 + 8).epsilon(1e-12));
    check_shells(solid);
    // Turned inside out: air pockets that touch in a line.
    const Solid holes = solid_of(BoxBody()
                                     .add({0, 0, 0}, {4, 4, 2})
                                     .remove({1, 1, 1}, {2, 2, 2})
                                     .remove({2, 2, 1}, {3, 3, 2})
                                     .build());
    CHECK(volume_m3(holes) == doctest::Approx(32 - 2).epsilon(1e-12));
    check_shells(holes);
  }

  TEST_CASE("two edges between the same two vertices stay apart by a vertex between") {
    // Two columns between a floor and a roof touch along an edge whose ends hang together over
    // floor and roof; the small box gives the edge a vertex in the middle.
    const Building building = BoxBody()
                                  .add({0, 0, 0}, {4, 4, 1})
                                  .add({0, 0, 1}, {2, 2, 3})
                                  .add({2, 2, 1}, {4, 4, 3})
                                  .add({0, 0, 3}, {4, 4, 4})
                                  .add({0, 0, 0}, {1, 1, 2})
                                  .build();
    const Solid solid = solid_of(building);
    CHECK(volume_m3(solid) == doctest::Approx(16 + 16 + 16).epsilon(1e-12));
    std::vector<std::pair<int, int>> edges;
    for (const Facet& facet : solid.facets)
      for (const Loop& loop : facet.loops)
        for (std::size_t i = 0; i < loop.size(); ++i)
          edges.emplace_back(loop[i], loop[(i + 1) % loop.size()]);
    std::ranges::sort(edges);
    CHECK(std::ranges::adjacent_find(edges) == edges.end());
    check_shells(solid);
  }

  TEST_CASE("two edges between the same two vertices are no reason to refuse a solid") {
    CHECK(outcome_of(BoxBody()
                         .add({0, 0, 0}, {4, 4, 1})
                         .add({0, 0, 1}, {2, 2, 3})
                         .add({2, 2, 1}, {4, 4, 3})
                         .add({0, 0, 3}, {4, 4, 4})
                         .build()) == "solid");
  }

  TEST_CASE("boxes that touch in a vertex only are lumps with vertices of their own") {
    const Solid solid =
        solid_of(BoxBody().add({0, 0, 0}, {1, 1, 1}).add({1, 1, 1}, {2, 2, 2}).build());
    CHECK(solid.shells.size() == 2);
    CHECK(solid.vertices.size() == 16);
    check_shells(solid);
  }

  TEST_CASE("solids of a multi-solid that share a face stay apart") {
    Building building = BoxBody().add({0, 0, 0}, {1, 1, 1}).build();
    Building other = BoxBody().add({1, 0, 0}, {2, 1, 1}).build();
    const int shift = static_cast<int>(building.vertices.size());
    building.is_solid = true;
    building.vertices.insert(building.vertices.end(), other.vertices.begin(), other.vertices.end());
    for (Polygon polygon : other.polygons) {
      polygon.source += 6;
      polygon.body = 1;
      for (int& v : polygon.rings[0]) v += shift;
      building.polygons.push_back(polygon);
    }
    CHECK(outcome_of(building) == "solid");
    const Solid solid = solid_of(building);
    CHECK(solid.shells.size() == 2);
    CHECK(solid.facets.size() == 12);
    CHECK(volume_m3(solid) == doctest::Approx(2).epsilon(1e-12));
    check_shells(solid);
  }

  TEST_CASE("walls that all lie in one plane enclose no volume though doubles say a little") {
    CHECK(rc::check([] {
      const auto metres = [](int low, int high) { return 1e-3 * *rc::gen::inRange(low, high); };
      const double x = metres(-300000, 300000), z = metres(-9000, 9000);
      // One wall looks one way, three between the same ends the other way.
      const double a = metres(-320000, -310000);
      const double b = a + metres(1, 900), c = b + metres(1, 900), d = c + metres(1, 900);
      const auto wall = [&](double from, double to) {
        return std::vector<Vec3>{
            {x, from, z}, {x, to, z}, {x, to, z + 7.224}, {x, from, z + 7.224}};
      };
      const std::string outcome = outcome_of(
          test::framed(test::building_of({wall(a, d), wall(d, c), wall(c, b), wall(b, a)})));
      RC_ASSERT(outcome.find("solid") == std::string::npos);
    }));
  }
}

}  // namespace
}  // namespace oriel
