#include "tests/support/changed.h"
#include "tests/support/shapes.h"
#include "tests/support/solidified.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>

#include <doctest/doctest.h>
#include <rapidcheck.h>

namespace oriel {
namespace {

using Points = std::vector<Vec3>;

constexpr RepairOptions kCutClosed{Closing::none, 10, Crossings::cut_closed};

struct Block {
  Vec3 min, max;
};

/// The six faces of a block, each with its own corners.
std::vector<Points> faces_of(const Block& block) {
  const auto& [a, b] = block;
  const auto at = [&](int x, int y, int z) {
    return Vec3{x ? b.x : a.x, y ? b.y : a.y, z ? b.z : a.z};
  };
  return {{at(0, 0, 0), at(0, 1, 0), at(1, 1, 0), at(1, 0, 0)},
          {at(0, 0, 1), at(1, 0, 1), at(1, 1, 1), at(0, 1, 1)},
          {at(0, 0, 0), at(1, 0, 0), at(1, 0, 1), at(0, 0, 1)},
          {at(1, 0, 0), at(1, 1, 0), at(1, 1, 1), at(1, 0, 1)},
          {at(1, 1, 0), at(0, 1, 0), at(0, 1, 1), at(1, 1, 1)},
          {at(0, 1, 0), at(0, 0, 0), at(0, 0, 1), at(0, 1, 1)}};
}

Building in_one_shell(const std::vector<Block>& blocks) {
  std::vector<Points> polygons;
  for (const Block& block : blocks)
    for (Points& face : faces_of(block)) polygons.push_back(std::move(face));
  return test::building_of(polygons);
}

/// The volume of the union of blocks with whole coordinates from 0 to 8: its cells are counted.
int cells_in(const std::vector<Block>& blocks) {
  int count = 0;
  for (int i = 0; i < 8 * 8 * 8; ++i) {
    const Vec3 p{i % 8 + 0.5, i / 8 % 8 + 0.5, i / 64 + 0.5};
    count += std::ranges::any_of(blocks, [&](const Block& b) {
      return b.min.x < p.x && p.x < b.max.x && b.min.y < p.y && p.y < b.max.y && b.min.z < p.z &&
             p.z < b.max.z;
    });
  }
  return count;
}

/// A house of 8 × 6 m under a gable roof, ridge at 6 m over y = 3, with a chimney of 1 m across the
/// ridge, up to 8 m. It is cut out of the slope towards y = 0 only, whose hole reaches over the
/// ridge, and its foot lies in that slope's plane.
Building house_with_chimney_on_the_ridge() {
  const auto on_slope = [](double x, double y) { return Vec3{x, y, 3 + y}; };
  const std::array<Vec3, 4> foot{on_slope(3.5, 2.5), on_slope(4.5, 2.5), on_slope(4.5, 3.5),
                                 on_slope(3.5, 3.5)};
  std::vector<Points> polygons{{{0, 0, 0}, {0, 6, 0}, {8, 6, 0}, {8, 0, 0}},
                               {{0, 0, 0}, {8, 0, 0}, {8, 0, 3}, {0, 0, 3}},
                               {{8, 6, 0}, {0, 6, 0}, {0, 6, 3}, {8, 6, 3}},
                               {{8, 0, 0}, {8, 6, 0}, {8, 6, 3}, {8, 3, 6}, {8, 0, 3}},
                               {{0, 6, 0}, {0, 0, 0}, {0, 0, 3}, {0, 3, 6}, {0, 6, 3}},
                               {{0, 3, 6}, {8, 3, 6}, {8, 6, 3}, {0, 6, 3}},
                               {{0, 0, 3}, {8, 0, 3}, {8, 3, 6}, {0, 3, 6}},
                               {{3.5, 2.5, 8}, {4.5, 2.5, 8}, {4.5, 3.5, 8}, {3.5, 3.5, 8}}};
  for (std::size_t i = 0; i < 4; ++i) {
    const Vec3 a = foot[i], b = foot[(i + 1) % 4];
    polygons.push_back({a, b, {b.x, b.y, 8}, {a.x, a.y, 8}});
  }
  Building house = test::building_of(polygons);
  auto& hole = house.polygons[6].rings.emplace_back();
  for (std::size_t i = 4; i-- > 0;) {
    const auto corner =
        std::ranges::find_if(house.vertices, [&](Vec3 p) { return length(p - foot[i]) < 1e-9; });
    hole.push_back(static_cast<int>(corner - house.vertices.begin()));
  }
  return house;
}

Solid uncrossed(const Building& building) {
  const Solidified out = solidify(building, {}, kCutClosed);
  for (const Issue& issue : out.issues) CAPTURE(to_string(issue));
  REQUIRE(out.value.has_value());
  CHECK(is_closed(*out.value));
  return *out.value;
}

std::set<int> polygons_of(const Solid& solid) {
  std::set<int> all;
  for (const Facet& facet : solid.facets) all.insert(facet.polygons.begin(), facet.polygons.end());
  return all;
}

TEST_SUITE("kernel/solidify") {
  TEST_CASE("two blocks that run through each other in one shell become their union") {
    const Building cross = in_one_shell({{{0, 0, 0}, {4, 4, 4}}, {{2, 1, 1}, {6, 3, 3}}});
    CHECK(volume_m3(*solidify(cross).value) == doctest::Approx(64 + 16).epsilon(1e-9));
    const Solidified out = solidify(cross, {}, kCutClosed);
    REQUIRE(out.value.has_value());
    CHECK(volume_m3(*out.value) == doctest::Approx(64 + 16 - 8).epsilon(1e-9));
    CHECK(out.value->shells.size() == 1);
    CHECK(out.value->facets.size() == 11);  // the end in the other block is gone
    CHECK(out.report.was_needed);
    CHECK(out.report.cut == 5);
    CHECK(polygons_of(*out.value).size() == 11);
    CHECK(out.report.inner == std::vector<int>{11});
    CHECK(out.report.inner_area_m2 == doctest::Approx(4).epsilon(1e-9));
  }

  TEST_CASE(
      "a chimney that is cut out of one slope only overhangs the other one beyond the ridge") {
    const Building house = house_with_chimney_on_the_ridge();
    const Solid solid = uncrossed(house);
    // Under its top at 8 m over the one slope's plane, 3 + y.
    const double chimney = 8 - 6;
    CHECK(volume_m3(solid) == doctest::Approx(8 * 6 * 4.5 + chimney).epsilon(1e-9));
    // The foot beyond the ridge looks down, and is of the slope that has the hole.
    const FacetId foot = test::facet_looking(solid, normalised({0, 1, -1}));
    CHECK(solid.facets[foot.index()].polygons == std::vector<int>{6});
    CHECK(area_m2(solid.vertices, solid.facets[foot.index()],
                  solid.planes[solid.facets[foot.index()].plane.index()].normal) ==
          doctest::Approx(0.5 * std::sqrt(2.0)).epsilon(1e-9));
  }

  TEST_CASE("a pocket that is deeper than its wall becomes a hole through it") {
    Building wall = test::building_of(faces_of({{0, 0, 0}, {4, 1, 4}}));
    auto sides = faces_of({{1, 0, 1}, {3, 2, 3}});
    for (Points& side : sides) std::ranges::reverse(side);
    sides.erase(sides.begin() + 2);  // the mouth
    const int first = static_cast<int>(wall.polygons.size());
    for (std::size_t i = 0; i < sides.size(); ++i) {
      Polygon polygon{{{}}, first + static_cast<int>(i), 0, 0, {}};
      for (const Vec3 p : sides[i]) {
        polygon.rings[0].push_back(static_cast<int>(wall.vertices.size()));
        wall.vertices.push_back(p);
      }
      wall.polygons.push_back(std::move(polygon));
    }
    auto& mouth = wall.polygons[2].rings.emplace_back();
    for (const Vec3 p : {Vec3{1, 0, 1}, Vec3{1, 0, 3}, Vec3{3, 0, 3}, Vec3{3, 0, 1}}) {
      mouth.push_back(static_cast<int>(wall.vertices.size()));
      wall.vertices.push_back(p);
    }
    CHECK(volume_m3(uncrossed(wall)) == doctest::Approx(16 - 4).epsilon(1e-9));
  }

  TEST_CASE("a block in a block that shares faces with it is gone, and so is one inside out") {
    const Block large{{1, 0, 0}, {3, 2, 1}}, corner{{1, 0, 0}, {2, 1, 1}};
    CHECK(volume_m3(uncrossed(in_one_shell({large, corner}))) == doctest::Approx(4).epsilon(1e-9));
    Building inside_out = in_one_shell({large, {{2, 1, 0}, {4, 3, 2}}});
    for (Polygon& polygon : inside_out.polygons) std::ranges::reverse(polygon.rings[0]);
    CHECK(volume_m3(uncrossed(inside_out)) == doctest::Approx(4 + 8 - 1).epsilon(1e-9));
  }

  TEST_CASE("what does not run through itself is the same solid when it is cut") {
    const Building body = test::BoxBody()
                              .add({0, 0, 0}, {6, 4, 3})
                              .add({2, 1, 3}, {3, 2, 4})
                              .remove({4, 1, 1}, {5, 2, 2})
                              .build();
    const Solid plain = test::solid_of(body), cut = uncrossed(body);
    CHECK(cut.facets.size() == plain.facets.size());
    CHECK(cut.shells.size() == plain.shells.size());
    CHECK(volume_m3(cut) == doctest::Approx(volume_m3(plain)).epsilon(1e-12));
    CHECK(solidify(body, {}, kCutClosed).report.cut == 0);
  }

  TEST_CASE("sheets of which both sides are given enclose nothing, however they are cut") {
    const Points square{{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}};
    const Points across{{1, 1, -1}, {1, 3, -1}, {1, 3, 1}, {1, 1, 1}};
    std::vector<Points> polygons;
    for (const Points& sheet : {square, across}) {
      polygons.push_back(sheet);
      polygons.emplace_back(sheet.rbegin(), sheet.rend());
    }
    const Solidified out = solidify(test::building_of(polygons), {}, kCutClosed);
    CHECK_FALSE(out.value);
    CHECK(has_errors(out.issues));
  }

  TEST_CASE("turning and shuffling what runs through itself change nothing") {
    for (const Building& building :
         {in_one_shell({{{0, 0, 0}, {4, 4, 4}}, {{2, 1, 1}, {6, 3, 3}}, {{1, 1, 3}, {3, 3, 7}}}),
          house_with_chimney_on_the_ridge()}) {
      const double volume = volume_m3(uncrossed(building));
      Building turned = building;
      for (Vec3& p : turned.vertices) p = test::turned(p, normalised({0.2, 0.3, 1}), 0.47);
      CHECK(volume_m3(uncrossed(test::framed(std::move(turned)))) ==
            doctest::Approx(volume).epsilon(1e-6));
      for (const std::uint64_t seed : {1, 2, 3})
        CHECK(volume_m3(uncrossed(test::shuffled(building, seed))) ==
              doctest::Approx(volume).epsilon(1e-9));
    }
  }

  TEST_CASE("blocks in one shell enclose the volume of their union wherever they stand") {
    CHECK(rc::check([] {
      const auto count = *rc::gen::inRange(2, 5);
      std::vector<Block> blocks;
      for (int i = 0; i < count; ++i) {
        const auto side = [] {
          const int low = *rc::gen::inRange(0, 7);
          return std::pair<double, double>(low, *rc::gen::inRange(low + 1, 9));
        };
        const auto [x, to_x] = side();
        const auto [y, to_y] = side();
        const auto [z, to_z] = side();
        blocks.push_back({{x, y, z}, {to_x, to_y, to_z}});
      }
      const Solidified out = solidify(in_one_shell(blocks), {}, kCutClosed);
      RC_ASSERT(out.value.has_value());
      RC_ASSERT(is_closed(*out.value));
      RC_ASSERT(std::abs(volume_m3(*out.value) - cells_in(blocks)) < 1e-6);
    }));
  }

  TEST_CASE("a body that takes more work to cut than there is stays as it came") {
    std::vector<Block> blocks;
    for (int i = 0; i < 6; ++i) {
      blocks.push_back({{1.0 + i, 0, 0}, {1.5 + i, 8, 8}});
      blocks.push_back({{0, 1.0 + i, 1}, {8, 1.5 + i, 7}});
    }
    const Building building = in_one_shell(blocks);
    bool is_cut = false;
    for (std::int64_t budget = 100; budget <= kWorkBudget; budget *= 10) {
      const Solidified out = solidify(building, {}, kCutClosed, budget);
      const bool is_used_up =
          std::ranges::find(out.issues, Code::E502, &Issue::code) != out.issues.end();
      CAPTURE(budget);
      CHECK(is_used_up == (out.report.cut == 0));
      if (is_cut) CHECK(!is_used_up);
      is_cut = out.report.cut > 0;
    }
    CHECK(is_cut);
  }
}

}  // namespace
}  // namespace oriel
