#include "kernel/blocks/simplify_outlines.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include <doctest/doctest.h>
#include <rapidcheck.h>

using namespace oriel;

namespace {

constexpr double kReach_m = 0.001;

bool anywhere(const Box& /*gained*/) { return true; }

double area_m2(const Outline& outline) { return signed_area(outline, {0, 0, 1}); }

struct SimplifiedOutline {
  Outline outline;
  int left = 0;
};

SimplifiedOutline simplified(Outline outline, double least_m, bool may_grow = false) {
  std::vector<Outline> outlines{std::move(outline)};
  OutlineLimits limits{least_m, kReach_m, {}};
  if (may_grow) limits.may_cover = anywhere;
  const int left = simplify_outlines(outlines, limits);
  return {outlines[0], left};
}

Outline turned_outline(Outline outline, double angle) {
  for (Vec3& p : outline)
    p = {p.x * std::cos(angle) - p.y * std::sin(angle),
         p.x * std::sin(angle) + p.y * std::cos(angle), 0};
  return outline;
}

/// A rectangle of 20 m by 12 m whose south side has a step, a protrusion or a niche of random
/// sizes at random places.
Outline facade(const std::vector<std::pair<int, int>>& steps) {
  Outline outline{{0, 12, 0}};
  double x = 0;
  for (const auto& [width, depth] : steps) {
    const double y = depth / 10.0;
    outline.push_back({x, y, 0});
    x += 0.3 + width / 10.0;
    outline.push_back({x, y, 0});
  }
  outline.push_back({x, 12, 0});
  return outline;
}

/// In an area or on its outline, but for rounding.
bool is_in(const std::vector<Outline>& outlines, Vec3 p) {
  if (contains(outlines, {0, 0, 1}, p)) return true;
  for (const Outline& outline : outlines)
    for (std::size_t i = 0; i < outline.size(); ++i)
      if (distance_to_segment(p, outline[i], outline[(i + 1) % outline.size()]) < 1e-6) return true;
  return false;
}

bool has_only_directions_of(const Outline& outline, const Outline& of) {
  const auto sides = [](const Outline& all) {
    std::vector<Vec3> out;
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Vec3 d = all[(i + 1) % all.size()] - all[i];
      out.push_back((1 / length(d)) * d);
    }
    return out;
  };
  const auto known = sides(of);
  return std::ranges::all_of(sides(outline), [&](Vec3 d) {
    return std::ranges::any_of(known,
                               [&](Vec3 k) { return std::abs(d.x * k.y - d.y * k.x) < 1e-6; });
  });
}

}  // namespace

TEST_SUITE("kernel/blocks") {
  TEST_CASE("at a step the shorter part of the facade follows the longer one") {
    const Outline recessed{{0, 0, 0}, {15, 0, 0}, {15, 1, 0}, {20, 1, 0}, {20, 10, 0}, {0, 10, 0}};
    const auto grown = simplified(recessed, 4, true);
    CHECK(grown.left == 0);
    CHECK(area_m2(grown.outline) == doctest::Approx(200));
    // Where somebody else may stand in front of the shorter part nothing happens.
    const auto kept = simplified(recessed, 4);
    CHECK(kept.left == 1);
    CHECK(area_m2(kept.outline) == doctest::Approx(195));
    const Outline ahead{{0, 1, 0}, {15, 1, 0}, {15, 0, 0}, {20, 0, 0}, {20, 10, 0}, {0, 10, 0}};
    const auto cut = simplified(ahead, 4);
    CHECK(cut.left == 0);
    CHECK(area_m2(cut.outline) == doctest::Approx(180));
  }

  TEST_CASE("a protrusion that covers less than the square of the least edge is cut off") {
    const Outline oriel{{0, 0, 0},  {8, 0, 0},  {8, -1, 0},  {10, -1, 0},
                        {10, 0, 0}, {20, 0, 0}, {20, 10, 0}, {0, 10, 0}};
    const auto made = simplified(oriel, 3);
    CHECK(made.left == 0);
    CHECK(made.outline.size() == 4);
    CHECK(area_m2(made.outline) == doctest::Approx(200));
    // What is narrow but covers more is a part of the building.
    Outline wing = oriel;
    wing[2].y = wing[3].y = -8;
    const auto kept = simplified(wing, 3);
    CHECK(kept.left == 1);
    CHECK(area_m2(kept.outline) == doctest::Approx(216));
  }

  TEST_CASE("a niche is filled only where nothing else can stand") {
    const Outline niche{{0, 0, 0},  {8, 0, 0},  {8, 1, 0},   {10, 1, 0},
                        {10, 0, 0}, {20, 0, 0}, {20, 10, 0}, {0, 10, 0}};
    CHECK(simplified(niche, 3).left > 0);
    const auto filled = simplified(niche, 3, true);
    CHECK(filled.left == 0);
    CHECK(area_m2(filled.outline) == doctest::Approx(200));
  }

  TEST_CASE("a corner that is cut off becomes a corner where there is room") {
    const Outline cut{{1, 0, 0}, {20, 0, 0}, {20, 10, 0}, {0, 10, 0}, {0, 1, 0}};
    const auto made = simplified(cut, 2, true);
    CHECK(made.left == 0);
    CHECK(made.outline.size() == 4);
    CHECK(area_m2(made.outline) == doctest::Approx(200));
  }

  TEST_CASE("a building smaller than the least edge stays") {
    const Outline hut{{0, 0, 0}, {2, 0, 0}, {2, 2, 0}, {0, 2, 0}};
    const auto made = simplified(hut, 3);
    CHECK(made.left == 4);
    CHECK(made.outline.size() == 4);
  }

  TEST_CASE("two wings do not come to touch each other") {
    // A passage of 1 m between two wings: the step in it must not close it.
    const Outline u{{0, 0, 0},   {20, 0, 0},  {20, 10, 0}, {10.5, 10, 0}, {10.5, 5, 0},
                    {9.5, 5, 0}, {9.5, 9, 0}, {9, 9, 0},   {9, 10, 0},    {0, 10, 0}};
    const auto made = simplified(u, 0.8, true);
    CHECK(made.left == 0);
    CHECK(has_only_directions_of(made.outline, u));
    CHECK(area_m2(made.outline) > 180);
  }

  TEST_CASE("whatever a facade looks like it keeps its directions and its ground") {
    CHECK(rc::check("facades", [] {
      const auto sizes = *rc::gen::container<std::vector<std::pair<int, int>>>(
          *rc::gen::inRange<std::size_t>(2, 9),
          rc::gen::pair(rc::gen::inRange(0, 60), rc::gen::inRange(0, 40)));
      const bool may_grow = *rc::gen::arbitrary<bool>();
      const double least_m = *rc::gen::inRange(2, 40) / 10.0;
      const Outline before = facade(sizes);
      const auto made = simplified(before, least_m, may_grow);
      RC_ASSERT(has_only_directions_of(made.outline, before));
      RC_ASSERT(area_m2(made.outline) > 0);
      if (!may_grow) {
        RC_ASSERT(area_m2(made.outline) <= area_m2(before) + 1e-9);
        const std::vector<Outline> outlines{before};
        for (const Vec3 p : made.outline) RC_ASSERT(is_in(outlines, p));
      }
      const auto again = simplified(made.outline, least_m, may_grow);
      RC_ASSERT(again.left <= made.left);
    }));
  }

  TEST_CASE("a turned outline is simplified as the outline itself") {
    const Outline before = facade({{31, 20}, {7, 9}, {42, 25}, {13, 31}, {2, 17}, {55, 39}});
    const auto straight = simplified(before, 1.5);
    CHECK(straight.outline.size() < before.size());
    for (const double angle : {0.4, 1.2, 2.9}) {
      const auto turned = simplified(turned_outline(before, angle), 1.5);
      CHECK(turned.outline.size() == straight.outline.size());
      CHECK(area_m2(turned.outline) == doctest::Approx(area_m2(straight.outline)));
    }
  }

  TEST_CASE("an edge against which a neighbour stands stays as it is") {
    // A step of half a metre in the south side; a neighbour stands to the south of its left part.
    const Outline step{{0, 0, 0}, {6, 0, 0}, {6, 0.5, 0}, {20, 0.5, 0}, {20, 12, 0}, {0, 12, 0}};
    std::vector<Outline> free{step}, bound{step};
    OutlineLimits limits{1, kReach_m, {}};
    CHECK(simplify_outlines(free, limits) == 0);
    limits.is_fixed = [](Vec3 p, Vec3 q) { return p.y == 0 && q.y == 0; };
    CHECK(simplify_outlines(bound, limits) == 1);
    CHECK(bound[0].size() == step.size());
  }
}
