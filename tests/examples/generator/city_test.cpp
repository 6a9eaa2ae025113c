#include "examples/generator/city/city_plan.h"
#include "examples/generator/generate.h"
#include "examples/generator/output/check.h"
#include "tests/examples/generator/measured_bodies.h"

#include <algorithm>
#include <vector>

#include <doctest/doctest.h>

namespace oriel::generator {
namespace {

constexpr int kGroups = 8;

Options city(std::uint64_t seed) {
  Options options;
  options.style = Style::city;
  options.seed = seed;
  return options;
}

/// The box of the ground that a house stands on, its height that of its walls.
Extent ground_of(const Body& body) {
  Extent ground;
  const std::vector<Extent> boxes = boxes_of(body);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (body.objects[i].kind == Class::wall) {
      ground.grow(boxes[i].low);
      ground.grow(boxes[i].high);
    }
  return ground;
}

std::vector<Extent> grounds_of(const Options& options, int first, int count) {
  std::vector<Extent> grounds;
  for (int i = first; i < first + count; ++i) grounds.push_back(ground_of(generate(options, i)));
  return grounds;
}

/// They share a wall: their grounds meet along a side, which is longer than 2 m.
bool do_touch(const Extent& p, const Extent& q) {
  const Um x = std::min(p.high.x, q.high.x) - std::max(p.low.x, q.low.x);
  const Um y = std::min(p.high.y, q.high.y) - std::max(p.low.y, q.low.y);
  return (x == 0 && y > 2000_mm) || (y == 0 && x > 2000_mm);
}

int touching(const std::vector<Extent>& all, const Extent& one) {
  return static_cast<int>(
      std::ranges::count_if(all, [&](const Extent& other) { return do_touch(one, other); }));
}

bool has_window_in(const Body& body, const Extent& strip) {
  const std::vector<Extent> boxes = boxes_of(body);
  for (std::size_t i = 0; i < boxes.size(); ++i)
    if (body.objects[i].kind == Class::window && boxes[i].overlaps(strip)) return true;
  return false;
}

}  // namespace

TEST_SUITE("examples/generator") {
  TEST_CASE("every house of a city is a closed solid with complete truth") {
    for (const std::uint64_t seed : {1, 2, 3}) {
      int chimneys = 0;
      for (int i = 0; i < kGroups * kHousesInGroup; ++i) {
        const Body body = generate(city(seed), i);
        CHECK(find_faults(body, 1).empty());
        chimneys +=
            static_cast<int>(std::ranges::count(body.objects, Class::chimney, &Object::kind));
      }
      CHECK(chimneys > kGroups);
    }
  }

  TEST_CASE("houses of a terrace share the walls at their sides") {
    const auto grounds = grounds_of(city(4), 0, kHousesInGroup);
    for (int i = 0; i < kHousesInGroup; ++i) {
      const bool is_at_end = i % 8 == 0 || i % 8 == 7;
      CHECK(touching(grounds, grounds[static_cast<std::size_t>(i)]) == (is_at_end ? 1 : 2));
    }
  }

  TEST_CASE("the houses of a block stand around a courtyard") {
    REQUIRE(kind_of_group(1) == GroupKind::perimeter);
    const auto grounds = grounds_of(city(5), kHousesInGroup, kHousesInGroup);
    Extent all;
    for (const Extent& ground : grounds) {
      CHECK(touching(grounds, ground) == 2);
      all.grow(ground.low);
      all.grow(ground.high);
    }
    Extent yard;
    yard.grow({(all.low.x + all.high.x) / 2 - 5000_mm, (all.low.y + all.high.y) / 2 - 5000_mm, 0});
    yard.grow({(all.low.x + all.high.x) / 2 + 5000_mm, (all.low.y + all.high.y) / 2 + 5000_mm, 9});
    CHECK(std::ranges::none_of(grounds, [&](const Extent& g) { return g.overlaps(yard); }));
  }

  TEST_CASE("no two houses of a city stand on the same ground") {
    const auto grounds = grounds_of(city(6), 0, kGroups * kHousesInGroup);
    for (std::size_t i = 0; i < grounds.size(); ++i)
      for (std::size_t k = 0; k < i; ++k) CHECK_FALSE(grounds[i].overlaps(grounds[k]));
  }

  TEST_CASE("a wall that houses share has no window") {
    for (int i = 0; i < kHousesInGroup; ++i) {
      const Body body = generate(city(7), i);
      const Extent ground = ground_of(body);
      if (i % 8 == 0) continue;
      Extent strip = ground;  // of 30 cm along the wall to the house before
      if (i < 8)
        strip.high.x = strip.low.x + 290_mm;
      else
        strip.low.x = strip.high.x - 290_mm;
      CHECK_FALSE(has_window_in(body, strip));
    }
  }

  TEST_CASE("a house of a city is the same whatever stands around it") {
    const Body body = generate(city(8), 37);
    const Body again = generate(city(8), 37);
    CHECK(body.vertices == again.vertices);
    CHECK(body.vertices != generate(city(9), 37).vertices);
  }

  TEST_CASE("a city is turned as a whole") {
    Options options = city(4);
    options.rotate_deg = 90;
    const auto grounds = grounds_of(options, 0, 8);
    for (std::size_t i = 1; i + 1 < grounds.size(); ++i) CHECK(touching(grounds, grounds[i]) == 2);
  }
}

}  // namespace oriel::generator
