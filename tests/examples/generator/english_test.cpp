#include "examples/generator/generate.h"
#include "examples/generator/output/check.h"
#include "examples/generator/output/truth.h"
#include "tests/examples/generator/crossings.h"
#include "tests/examples/generator/measured_bodies.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace oriel::generator {
namespace {

constexpr int kRows = 200;

Options english(std::uint64_t seed) {
  Options options;
  options.style = Style::english;
  options.seed = seed;
  return options;
}

/// True for what stands by itself: surfaces and what runs over a whole roof contain other boxes.
bool stands_alone(const Object& object) {
  return !is_surface(object.kind) && object.subclass != "upstand" && object.subclass != "parapet";
}

/// How far the opening's deepest corner lies behind the polygon that it is cut into.
double measured_recess_m(const Body& body, int opening) {
  std::set<int> corners, rim;
  for (const Polygon& polygon : body.polygons)
    if (polygon.owner.object == opening)
      for (const int corner : polygon.rings[0])
        (polygon.owner.is_niche ? rim : corners).insert(corner);
  if (rim.empty()) return 0;
  const int host = body.objects[static_cast<std::size_t>(opening)].host;
  for (const Polygon& polygon : body.polygons) {
    if (polygon.owner.object != host) continue;
    int shared = 0;
    for (const std::vector<int>& ring : polygon.rings)
      shared += static_cast<int>(
          std::ranges::count_if(ring, [&](int corner) { return rim.contains(corner); }));
    if (shared < 3) continue;
    const Vec3 normal = normalised(doubled_area(body, polygon));
    const Point origin = body.vertices[static_cast<std::size_t>(polygon.rings[0][0])];
    double depth = 0;
    for (const int corner : corners)
      depth = std::max(
          depth, -dot(normal, metres(body.vertices[static_cast<std::size_t>(corner)] - origin)));
    return depth;
  }
  return -1;
}

TEST_SUITE("examples/generator") {
  TEST_CASE("every English row is a closed solid of planar faces with complete truth") {
    Options options = english(1);
    for (int i = 0; i < kRows; ++i) {
      options.flush = i % 3 == 0 ? 0.4 : 0;
      options.jitter = i % 2 == 0 ? 300_mm : 0;
      const Body body = generate(options, i);
      CHECK(find_faults(body, 1).empty());
      CHECK(volume_m3(body) > 200);
    }
  }

  TEST_CASE("an English row is the same for the same seed and another for another one") {
    for (int i = 0; i < 20; ++i) {
      const Body body = generate(english(1), i);
      CHECK(generate(english(1), i).vertices == body.vertices);
      CHECK(generate(english(2), i).vertices != body.vertices);
    }
  }

  TEST_CASE("boxes of things in an English row that do not belong together do not overlap") {
    Options options = english(2);
    int pairs = 0;
    for (int i = 0; i < kRows; ++i) {
      options.jitter = i % 2 == 0 ? 200_mm : 0;
      const Body body = generate(options, i);
      const std::vector<Extent> boxes = boxes_of(body);
      for (std::size_t a = 0; a < boxes.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
          const Object &first = body.objects[a], &second = body.objects[b];
          if (!stands_alone(first) || !stands_alone(second)) continue;
          if (first.parent == static_cast<int>(b) || first.host == static_cast<int>(b)) continue;
          ++pairs;
          if (!boxes[a].overlaps(boxes[b])) continue;
          FAIL_CHECK("house " << i << ": " << first.name << " and " << second.name);
        }
    }
    CHECK(pairs > 100'000);
  }

  TEST_CASE("truth boxes of an English row lie within the building") {
    for (int i = 0; i < 40; ++i) {
      Options options = english(3);
      options.noise = i % 2 == 0 ? 1'000 : 0;
      const Body body = generate(options, i);
      const Extent all = extent_of(body.vertices);
      const double low[] = {metres(all.low.x), metres(all.low.y), metres(all.low.z)};
      const double high[] = {metres(all.high.x), metres(all.high.y), metres(all.high.z)};
      const auto truth = nlohmann::json::parse(truth_json({"row", body, {}}));
      CHECK(truth["objects"].size() == body.objects.size());
      for (const auto& object : truth["objects"])
        for (const char* key : {"aabb", "feature_aabb"}) {
          if (!object.contains(key)) continue;
          for (std::size_t axis = 0; axis < 3; ++axis) {
            CHECK(object[key][axis].get<double>() >= low[axis] - 1e-9);
            CHECK(object[key][axis + 3].get<double>() <= high[axis] + 1e-9);
          }
        }
    }
  }

  TEST_CASE("no English row crosses itself") {
    Options options = english(4);
    options.triangulate = true;
    options.jitter = 200_mm;
    for (int i = 0; i < 12; ++i) CHECK(test::count_crossings(generate(options, i)) == 0);
  }

  TEST_CASE("recesses in the truth are true metres and so on the slanted sides of a bay") {
    int openings = 0, slanted = 0;
    for (int i = 0; i < 40; ++i) {
      const Body body = generate(english(5), i);
      for (std::size_t k = 0; k < body.objects.size(); ++k) {
        const Object& object = body.objects[k];
        if (!object.recess || *object.recess == 0) continue;
        INFO("house " << i << ": " << object.name);
        CHECK(metres(*object.recess) ==
              doctest::Approx(measured_recess_m(body, static_cast<int>(k))).epsilon(1e-4));
        ++openings;
        for (const Polygon& polygon : body.polygons) {
          if (polygon.owner.object != static_cast<int>(k) || polygon.owner.is_niche) continue;
          const Vec3 normal = normalised(doubled_area(body, polygon));
          if (std::abs(normal.x) > 0.5 && std::abs(normal.y) > 0.5) ++slanted;
        }
      }
    }
    CHECK(openings > 1000);
    CHECK(slanted > 100);
  }

  TEST_CASE("every class and every English kind occurs") {
    std::map<std::string, int> kinds;
    for (int i = 0; i < kRows; ++i)
      for (const Object& object : generate(english(1), i).objects)
        ++kinds[std::string(name_of(object.kind)) + " " + object.subclass];
    for (const char* kind : {"window Window",
                             "window roofWindow",
                             "window gableWindow",
                             "window cellarWindow",
                             "window frenchWindow",
                             "door Door",
                             "door garageDoor",
                             "door frenchWindow",
                             "chimney stack",
                             "vent pipe",
                             "vent vent",
                             "vent flueTerminal",
                             "dormer shedDormer",
                             "dormer gabledDormer",
                             "balcony balcony",
                             "loggia loggia",
                             "bay bay",
                             "canopy canopy",
                             "canopy gabledHood",
                             "stairs stairs",
                             "other sill",
                             "other lintel",
                             "other porch",
                             "other upstand",
                             "other parapet",
                             "other pilaster",
                             "other bracket",
                             "other band",
                             "other cornice",
                             "other ground",
                             "wall WallSurface",
                             "roof RoofSurface"})
      CHECK_MESSAGE(kinds[kind] >= 5, kind);
  }

  TEST_CASE("the share of flush openings of English rows is about what was asked") {
    for (const double share : {0.0, 0.5, 1.0}) {
      Options options = english(6);
      options.flush = share;
      const OpeningCounts openings = count_openings(options, 60);
      CHECK(openings.flush == doctest::Approx(share * openings.all).epsilon(0.1));
    }
  }

  TEST_CASE("English rows of one run do not stand in each other") {
    std::vector<Extent> boxes;
    for (int i : {0, 1, 2, 3, 4, 5, 199, 200, 201})
      boxes.push_back(extent_of(generate(english(1), i).vertices));
    for (std::size_t a = 0; a < boxes.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) CHECK_FALSE(boxes[a].overlaps(boxes[b]));
  }
}

}  // namespace
}  // namespace oriel::generator
