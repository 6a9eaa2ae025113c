#include "kernel/perturb/perturb.h"

#include "tests/support/generated.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <doctest/doctest.h>
#include <rapidcheck.h>

namespace oriel {
namespace {

/// A house far from the origin, as surveyed ones are.
Building house(int index = 0) {
  generator::Options options;
  options.seed = 11;
  Building building = test::generated(options, index).building;
  building.frame.origin_m = building.frame.origin_m + Vec3{678000, 5403000, 370};
  return building;
}

Vec3 place(const Building& building, std::size_t vertex) {
  return building.vertices[vertex] + building.frame.origin_m;
}

double volume_of(const Building& building) { return volume_m3(test::solid_of(building)); }

bool is_same(const Building& a, const Building& b) {
  const auto is_same_polygon = [](const Polygon& p, const Polygon& q) {
    return p.rings == q.rings && p.source == q.source && p.body == q.body && p.shell == q.shell &&
           p.hint == q.hint;
  };
  return a.vertices == b.vertices && a.frame.origin_m == b.frame.origin_m &&
         std::ranges::equal(a.polygons, b.polygons, is_same_polygon);
}

double farthest_move(const Building& before, const Building& after) {
  double farthest = 0;
  for (std::size_t i = 0; i < before.vertices.size(); ++i) {
    const Vec3 d = place(after, i) - place(before, i);
    farthest = std::max({farthest, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
  }
  return farthest;
}

TEST_SUITE("kernel/perturb") {
  TEST_CASE("nothing asked changes nothing") {
    const Building before = house();
    const Perturbed after = perturbed(before, {});
    CHECK(is_same(after.building, before));
    CHECK(after.motion.is_still());
    for (std::size_t i = 0; i < after.source_before.size(); ++i)
      CHECK(after.source_before[i] == static_cast<int>(i));
  }

  TEST_CASE("the same seed gives the same building and another seed another one") {
    rc::check([] {
      const Building before = house(*rc::gen::inRange(0, 3));
      Perturbation perturbation;
      perturbation.seed = *rc::gen::arbitrary<std::uint64_t>();
      perturbation.noise_m = *rc::gen::element(0.001, 0.05);
      perturbation.missing_share = *rc::gen::element(0.0, 0.2);
      perturbation.rotation_deg = *rc::gen::element(0.0, 33.0);
      perturbation.triangulates = *rc::gen::arbitrary<bool>();
      const Perturbed once = perturbed(before, perturbation);
      const Perturbed twice = perturbed(before, perturbation);
      RC_ASSERT(is_same(once.building, twice.building));
      RC_ASSERT(once.source_before == twice.source_before);
      Perturbation other = perturbation;
      other.seed ^= 1U;
      RC_ASSERT(!is_same(once.building, perturbed(before, other).building));
      Building renamed = before;
      renamed.id += "b";
      RC_ASSERT(!is_same(once.building, perturbed(renamed, perturbation).building));
    });
  }

  TEST_CASE("noise is bounded and as large as it is said to be") {
    const Building before = house();
    Perturbation perturbation;
    perturbation.noise_m = 0.01;
    for (const NoiseKind kind : {NoiseKind::uniform, NoiseKind::normal}) {
      perturbation.noise_kind = kind;
      const Building after = perturbed(before, perturbation).building;
      const double bound = kind == NoiseKind::uniform ? 0.01 : 0.06;
      CHECK(farthest_move(before, after) <= bound + 1e-8);
      double squares = 0;
      for (std::size_t i = 0; i < before.vertices.size(); ++i) {
        const Vec3 d = place(after, i) - place(before, i);
        squares += dot(d, d);
      }
      const double deviation = std::sqrt(squares / 3 / static_cast<double>(before.vertices.size()));
      CHECK(deviation ==
            doctest::Approx(kind == NoiseKind::uniform ? 0.01 / std::sqrt(3) : 0.01).epsilon(0.15));
    }
  }

  TEST_CASE("what is one corner stays one") {
    Building before = house();
    // Every ring gets vertices of its own, some of them a tenth of a millimetre away.
    Building apart = before;
    apart.vertices.clear();
    for (Polygon& polygon : apart.polygons)
      for (std::vector<int>& ring : polygon.rings)
        for (int& vertex : ring) {
          const double off = apart.vertices.size() % 3 == 0 ? 1e-4 : 0;
          apart.vertices.push_back(before.vertices[static_cast<std::size_t>(vertex)] +
                                   Vec3{off, 0, 0});
          vertex = static_cast<int>(apart.vertices.size()) - 1;
        }
    Perturbation perturbation;
    perturbation.noise_m = 0.02;
    const Building after = perturbed(apart, perturbation).building;
    Tolerances tolerances;
    tolerances.plane_offset_m = 0.05;
    CHECK(is_closed(test::solid_of(after, tolerances)));
  }

  TEST_CASE("noise does not depend on the order of vertices") {
    const Building before = house();
    Building turned = before;
    std::ranges::reverse(turned.vertices);
    const int last = static_cast<int>(turned.vertices.size()) - 1;
    for (Polygon& polygon : turned.polygons)
      for (std::vector<int>& ring : polygon.rings)
        for (int& vertex : ring) vertex = last - vertex;
    Perturbation perturbation;
    perturbation.noise_m = 0.02;
    Building after = perturbed(turned, perturbation).building;
    std::ranges::reverse(after.vertices);
    CHECK(after.vertices == perturbed(before, perturbation).building.vertices);
  }

  TEST_CASE("a rotation goes back and full turns change nothing") {
    const Building before = house();
    Perturbation there;
    there.rotation_deg = 360;
    CHECK(is_same(perturbed(before, there).building, before));
    there.rotation_deg = 33;
    const Perturbed turned = perturbed(before, there);
    CHECK(farthest_move(before, turned.building) > 1);
    for (std::size_t i = 0; i < before.vertices.size(); ++i)
      CHECK(length(turned.motion.before(place(turned.building, i)) - place(before, i)) < 1e-7);
    CHECK(volume_of(turned.building) == doctest::Approx(volume_of(before)).epsilon(1e-6));
  }

  TEST_CASE("the frame follows what moves") {
    Perturbation perturbation;
    perturbation.rotation_deg = 45;
    perturbation.shift_m = {0.3, 100.7, -5};
    const Building after = perturbed(house(), perturbation).building;
    Box box;
    for (const Vec3 p : after.vertices) box.grow(p);
    for (const double least : {box.min.x, box.min.y, box.min.z}) {
      CHECK(least >= 0);
      CHECK(least < 1);
    }
  }

  TEST_CASE("a shift moves every vertex by the same") {
    const Building before = house();
    Perturbation perturbation;
    perturbation.shift_m = {0.25, -3.5, 10};
    const Perturbed after = perturbed(before, perturbation);
    for (std::size_t i = 0; i < before.vertices.size(); ++i) {
      CHECK(length(place(after.building, i) - place(before, i) - perturbation.shift_m) < 1e-8);
      CHECK(length(after.motion.before(place(after.building, i)) - place(before, i)) < 1e-8);
    }
  }

  TEST_CASE("a triangulated building has the same volume and knows its polygons") {
    for (const double noise_m : {0.0, 0.002}) {
      const Building before = house(1);
      Perturbation perturbation;
      perturbation.triangulates = true;
      perturbation.noise_m = noise_m;
      const Perturbed after = perturbed(before, perturbation);
      std::set<int> sources;
      for (const Polygon& polygon : after.building.polygons) {
        CHECK(polygon.rings.size() == 1);
        CHECK(polygon.rings[0].size() == 3);
        CHECK(sources.insert(polygon.source).second);
      }
      // The corners of a triangle are corners of its polygon.
      for (const Polygon& polygon : after.building.polygons) {
        const int source = after.source_before[static_cast<std::size_t>(polygon.source)];
        std::set<int> corners;
        for (const auto& ring : before.polygons[static_cast<std::size_t>(source)].rings)
          corners.insert(ring.begin(), ring.end());
        for (const int vertex : polygon.rings[0]) CHECK(corners.contains(vertex));
      }
      if (noise_m == 0)
        CHECK(volume_of(after.building) == doctest::Approx(volume_of(before)).epsilon(1e-6));
    }
  }

  TEST_CASE("a larger share of missing polygons takes those of a smaller one") {
    const Building before = house();
    std::set<int> fewer_left;
    for (const double share : {1.0, 0.5, 0.25, 0.1, 0.0}) {
      Perturbation perturbation;
      perturbation.missing_share = share;
      const Building after = perturbed(before, perturbation).building;
      const auto all = static_cast<double>(before.polygons.size());
      CHECK(after.polygons.size() ==
            before.polygons.size() - static_cast<std::size_t>(std::floor(share * all + 0.5)));
      std::set<int> left;
      for (const Polygon& polygon : after.polygons) left.insert(polygon.source);
      CHECK(std::ranges::includes(left, fewer_left));
      fewer_left = left;
      CHECK(after.vertices == before.vertices);
    }
  }

  TEST_CASE("installations and repeated vertices keep their polygons") {
    Building before = house();
    const std::size_t half = before.polygons.size() / 2;
    const int source = before.polygons[half].source;
    before.installations = {{"balcony", half, before.vertices.size()}};
    before.repeats = {{0, 0, 0}, {static_cast<int>(half), 0, 1}};
    Perturbation perturbation;
    perturbation.missing_share = 0.3;
    const Building after = perturbed(before, perturbation).building;
    std::size_t own = 0;
    for (const Polygon& polygon : after.polygons) own += polygon.source < source ? 1 : 0;
    REQUIRE(after.installations.size() == 1);
    CHECK(after.installations[0].first_polygon == own);
    for (const RepeatedVertex& repeat : after.repeats) {
      const int kept = after.polygons[static_cast<std::size_t>(repeat.polygon)].source;
      CHECK((kept == 0 || kept == source));
    }
  }

  TEST_CASE("a polygon that cannot be cut stays whole") {
    // Its ring crosses itself.
    const Building bow = test::building_of({{{0, 0, 0}, {4, 4, 0}, {4, 0, 0}, {0, 3, 0}}});
    Perturbation perturbation;
    perturbation.triangulates = true;
    CHECK(is_same(perturbed(bow, perturbation).building, bow));
  }

  TEST_CASE("a building without polygons is perturbed into itself") {
    Building nothing;
    Perturbation perturbation;
    perturbation.noise_m = 0.1;
    perturbation.rotation_deg = 10;
    perturbation.missing_share = 0.5;
    perturbation.triangulates = true;
    CHECK(is_same(perturbed(nothing, perturbation).building, nothing));
  }
}

}  // namespace
}  // namespace oriel
