#include "kernel/solidify/solidify.h"
#include "tests/support/changed.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <algorithm>
#include <functional>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::BoxBody;
using test::in_whole_facets;
using test::outcome_of;

using Where = std::function<bool(Vec3)>;

/// One polygon a facet, without those whose points are all in one of the places.
Building without_faces(const Building& whole, const std::vector<Where>& places) {
  Building open = in_whole_facets(whole);
  std::erase_if(open.polygons, [&](const Polygon& polygon) {
    return std::ranges::any_of(places, [&](const Where& is_there) {
      return std::ranges::all_of(polygon.rings[0], [&](int v) {
        return is_there(open.vertices[static_cast<std::size_t>(v)]);
      });
    });
  });
  for (std::size_t i = 0; i < open.polygons.size(); ++i)
    open.polygons[i].source = static_cast<int>(i);
  open.is_solid = false;
  return open;
}

Where at_x(double x) {
  return [x](Vec3 p) { return p.x == x; };
}
Where at_z(double z) {
  return [z](Vec3 p) { return p.z == z; };
}

BoxBody house() { return BoxBody().add({0, 0, 0}, {10, 8, 6}); }

/// What was closed, in sorted words: "ground 80, wall 48".
std::string closed_in(const Building& open, const RepairOptions& options = {}) {
  const Solidified made = solidify(open, {}, options);
  if (!made.value) return "open";
  CHECK(is_closed(*made.value));
  std::vector<std::string> words;
  for (const Cap& cap : made.report.caps)
    words.push_back(to_string(cap.kind) + " " + std::to_string(std::lround(cap.area_m2)));
  std::ranges::sort(words);
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

double closed_volume_m3(const Building& open) {
  const Solidified made = solidify(open);
  return made.value ? volume_m3(*made.value) : 0;
}

/// A house of 10 m × 8 m with a gable, its ridge along x.
Building gable_house() {
  const std::vector<Vec3> p{{0, 0, 0},  {10, 0, 0}, {10, 8, 0}, {0, 8, 0}, {0, 0, 5},
                            {10, 0, 5}, {10, 8, 5}, {0, 8, 5},  {0, 4, 9}, {10, 4, 9}};
  return test::building_of({{p[3], p[2], p[1], p[0]},
                            {p[0], p[1], p[5], p[4]},
                            {p[2], p[3], p[7], p[6]},
                            {p[1], p[2], p[6], p[9], p[5]},
                            {p[3], p[0], p[4], p[8], p[7]},
                            {p[4], p[5], p[9], p[8]},
                            {p[6], p[7], p[8], p[9]}});
}

TEST_SUITE("kernel/solidify") {
  TEST_CASE("a missing ground is closed by default and reported") {
    const Building open = without_faces(house().build(), {at_z(0)});
    CHECK(closed_in(open) == "ground 80");
    CHECK(closed_volume_m3(open) == doctest::Approx(480).epsilon(1e-9));
    CHECK(outcome_of(open) == "solid E316");
    const Solidified made = solidify(open);
    CHECK(made.issues.back().severity == Severity::warning);
    CHECK(made.issues.back().sentence ==
          "1 hole was closed by a face of oriel's own, 80.00 m²: 1 ground (80.00 m²)");
    CHECK(closed_in(open, {Closing::planar}) == "open");
    CHECK(closed_in(open, {Closing::none}) == "open");
    CHECK(closed_in(open, {Closing::any}) == "ground 80");
  }

  TEST_CASE("a missing party wall is closed by default") {
    const Building open = without_faces(house().build(), {at_x(0)});
    CHECK(closed_in(open) == "wall 48");
    CHECK(closed_in(open, {Closing::planar}) == "open");
  }

  TEST_CASE("ground and both party walls may be missing together") {
    const Building flat = without_faces(house().build(), {at_z(0), at_x(0)});
    CHECK(closed_in(flat) == "ground 80, wall 48");
    CHECK(closed_volume_m3(flat) == doctest::Approx(480).epsilon(1e-9));
    const Building gable = without_faces(gable_house(), {at_z(0), at_x(0), at_x(10)});
    CHECK(closed_in(gable) == "ground 80, wall 56, wall 56");
    CHECK(closed_volume_m3(gable) == doctest::Approx(560).epsilon(1e-9));
  }

  TEST_CASE("a missing roof stays open by default") {
    const Building flat = house().build();
    CHECK(closed_in(without_faces(flat, {at_z(6)})) == "open");
    CHECK(closed_in(without_faces(flat, {at_z(6)}), {Closing::any}) == "hole 80");
    CHECK(closed_in(without_faces(flat, {at_z(6), at_x(0)})) == "open");
    // What lies over a missing ground is none.
    CHECK(closed_in(without_faces(flat, {at_z(6), at_z(0)})) == "open");
    const Building gable = gable_house();
    const auto is_front = [](Vec3 p) { return p.z >= 5 && p.y <= 4; };
    const auto is_back = [](Vec3 p) { return p.z >= 5 && p.y >= 4; };
    CHECK(closed_in(without_faces(gable, {is_front})) == "open");
    CHECK(closed_in(without_faces(gable, {is_front, is_back})) == "open");
    CHECK(closed_in(without_faces(gable, {is_front, at_z(0)})) == "open");
    CHECK(closed_in(without_faces(gable, {at_x(0), at_z(0)})) == "ground 80, wall 56");
  }

  TEST_CASE("a small hole is closed wherever it is as long as the area allows it") {
    const Building shed = BoxBody().add({0, 0, 0}, {3, 3, 3}).build();
    const Building open = without_faces(shed, {at_z(3)});
    CHECK(closed_in(open) == "hole 9");
    CHECK(closed_in(open, {Closing::ground, 0}) == "open");
    // A wall is called one if it is closed for what it is.
    CHECK(closed_in(without_faces(shed, {at_x(0)})) == "hole 9");
    CHECK(closed_in(without_faces(shed, {at_x(0)}), {Closing::ground, 0}) == "wall 9");
    CHECK(closed_in(without_faces(shed, {at_z(0)}), {Closing::ground, 0}) == "ground 9");
  }

  TEST_CASE("a stepped ground is closed with or without the faces between its steps") {
    const Building stepped = house().remove({6, 0, 0}, {10, 8, 2}).build();
    const auto is_riser = [](Vec3 p) { return p.x == 6 && p.z <= 2; };
    CHECK(closed_in(without_faces(stepped, {at_z(0), at_z(2), is_riser})) ==
          "ground 32, ground 48, wall 16");
    CHECK(closed_in(without_faces(stepped, {at_z(0), at_z(2)})) == "ground 32, ground 48");
  }

  TEST_CASE("the ground of an L with a courtyard is one face with a hole") {
    const Building ell = BoxBody()
                             .add({0, 0, 0}, {20, 10, 6})
                             .add({0, 10, 0}, {8, 20, 6})
                             .remove({3, 3, 0}, {7, 7, 6})
                             .build();
    const Building open = without_faces(ell, {at_z(0)});
    CHECK(closed_in(open) == "ground 264");
    CHECK(closed_volume_m3(open) == doctest::Approx(6 * 264).epsilon(1e-9));
  }

  TEST_CASE("two lumps on two levels have a ground each") {
    const Building lumps = BoxBody().add({0, 0, 0}, {5, 5, 6}).add({20, 0, 4}, {26, 5, 10}).build();
    CHECK(closed_in(without_faces(lumps, {at_z(0), at_z(4)})) == "ground 25, ground 30");
  }

  TEST_CASE("a level hole over another part of the building is no ground") {
    // A roof terrace behind parapets: its floor is missing, and all around it rises.
    const Building terrace = house().remove({1, 1, 5}, {9, 7, 6}).build();
    CHECK(closed_in(without_faces(terrace, {at_z(5)})) == "open");
    CHECK(closed_in(without_faces(terrace, {at_z(5), at_z(0)})) == "open");
    CHECK(closed_in(without_faces(terrace, {at_z(0)})) == "ground 80");
  }

  TEST_CASE("a wall that is missing keeps the windows in it") {
    const Building windows = house().remove({2, 0, 1}, {4, 0.3, 3}).build();
    const auto is_front = [](Vec3 p) { return p.y == 0; };
    const Solidified made = solidify(without_faces(windows, {is_front}));
    REQUIRE(made.value);
    CHECK(made.report.dangling.empty());
    CHECK(volume_m3(*made.value) == doctest::Approx(480 - 1.2).epsilon(1e-6));
  }

  TEST_CASE(
      "what is closed depends on no order of vertices and polygons and no sense of rotation") {
    const Building stepped = house().remove({6, 0, 0}, {10, 8, 2}).build();
    const Building open = without_faces(stepped, {at_z(0), at_z(2), at_x(0)});
    const std::string closed = closed_in(open);
    CHECK(closed == "ground 32, ground 48, wall 48");
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
      Building other = test::in_order(test::shuffled(open, seed));
      CHECK(closed_in(other) == closed);
      for (Polygon& polygon : other.polygons)
        for (auto& ring : polygon.rings) std::ranges::reverse(ring);
      CHECK(closed_in(other) == closed);
      CHECK(closed_in(test::mapped(open, [&](Vec3 p) {
              return test::turned(p, {0, 0, 1}, 0.3 * static_cast<double>(seed));
            })) == closed);
    }
  }

  TEST_CASE("faces that lean by more than five degrees are neither ground nor walls") {
    const auto leaning = [](double slope) {
      return without_faces(
          test::mapped(house().build(),
                       [&](Vec3 p) {
                         // The wall at x = 0 leans, and the ground tilts about its edge at y = 0.
                         return Vec3{p.x == 0 ? slope * p.z : p.x, p.y, p.z + slope * p.y};
                       }),
          {[](Vec3 p) { return p.x < 3; }});
    };
    CHECK(closed_in(leaning(0.08)) != "open");
    CHECK(closed_in(leaning(0.1)) == "open");
  }

  /// A house without the foot of its wall at x = 0, so high; the rest of the wall is there.
  Building without_foot(double height_m) {
    Building open =
        BoxBody().add({0, 0, 0}, {10, 8, height_m}).add({0, 0, height_m}, {10, 8, 6}).build();
    const auto gone = std::erase_if(open.polygons, [&](const Polygon& polygon) {
      return std::ranges::all_of(polygon.rings[0], [&](int v) {
        const Vec3 p = open.vertices[static_cast<std::size_t>(v)];
        return p.x == 0 && p.z <= height_m;
      });
    });
    REQUIRE(gone == 1);
    return open;
  }

  TEST_CASE("facets of closing faces are facets of their own if they are to be written") {
    for (const bool is_apart : {false, true})
      for (const double height_m : {3.0, 0.003}) {
        CAPTURE(is_apart);
        CAPTURE(height_m);
        RepairOptions options;
        options.keeps_caps_apart = is_apart;
        const Solidified made = solidify(without_foot(height_m), {}, options);
        REQUIRE(made.value);
        CHECK(is_closed(*made.value));
        // Slivers go with their neighbours.
        const bool is_own = is_apart && height_m > 1;
        CHECK(made.value->facets.size() == (is_own ? 7 : 6));
        CHECK(std::ranges::count_if(made.value->facets, [](const Facet& facet) {
                return facet.polygons.empty();
              }) == (is_own ? 1 : 0));
      }
  }
}

}  // namespace
}  // namespace oriel
