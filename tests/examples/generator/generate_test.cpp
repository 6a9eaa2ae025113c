#include "examples/generator/generate.h"

#include "examples/generator/output/check.h"
#include "tests/examples/generator/crossings.h"
#include "tests/examples/generator/measured_bodies.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

#include <doctest/doctest.h>

namespace oriel::generator {
namespace {

constexpr int kSeeds = 300;

Options with_features(std::initializer_list<Feature> features) {
  Options options;
  options.features.emplace();
  for (const Feature feature : features) options.features->add(feature);
  return options;
}

int count(const Body& body, Class kind) {
  return static_cast<int>(std::count_if(body.objects.begin(), body.objects.end(),
                                        [&](const Object& o) { return o.kind == kind; }));
}

/// The roof planes, as objects, that share a corner with the object.
std::set<int> roof_planes_around(const Body& body, int object) {
  std::set<int> corners, planes;
  const auto each_corner = [&](const Polygon& polygon, const auto& act) {
    for (const std::vector<int>& ring : polygon.rings) std::ranges::for_each(ring, act);
  };
  for (const Polygon& polygon : body.polygons)
    if (polygon.owner.object == object)
      each_corner(polygon, [&](int corner) { corners.insert(corner); });
  for (const Polygon& polygon : body.polygons) {
    const int owner = polygon.owner.object;
    if (body.objects[static_cast<std::size_t>(owner)].kind != Class::roof) continue;
    each_corner(polygon, [&](int corner) {
      if (corners.contains(corner)) planes.insert(owner);
    });
  }
  return planes;
}

/// True for what stands by itself: surfaces and bands around the house contain other boxes.
bool is_single(const Object& object) {
  return !is_surface(object.kind) && object.subclass != "plinth" && object.subclass != "parapet";
}

TEST_SUITE("examples/generator") {
  TEST_CASE("every house is a closed solid of planar faces with complete truth") {
    Options options;
    for (int i = 0; i < kSeeds; ++i) {
      options.flush = i % 3 == 0 ? 0.4 : 0;
      options.jitter = i % 2 == 0 ? 300_mm : 0;
      const Body body = generate(options, i);
      CHECK(find_faults(body, 1).empty());
      CHECK(volume_m3(body) > 50);
      CHECK(count(body, Class::window) > 0);
      CHECK(count(body, Class::wall) >= 4);
      CHECK(count(body, Class::ground) == 1);
    }
  }

  TEST_CASE("boxes of things that do not belong together do not overlap") {
    Options options;
    options.seed = 2;
    int pairs = 0;
    for (int i = 0; i < kSeeds; ++i) {
      options.jitter = i % 2 == 0 ? 200_mm : 0;
      const Body body = generate(options, i);
      const std::vector<Extent> boxes = boxes_of(body);
      for (std::size_t a = 0; a < boxes.size(); ++a)
        for (std::size_t b = 0; b < a; ++b) {
          if (!is_single(body.objects[a]) || !is_single(body.objects[b])) continue;
          if (body.objects[a].parent == static_cast<int>(b)) continue;
          ++pairs;
          INFO("house " << i << ": " << body.objects[a].name << " and " << body.objects[b].name);
          CHECK_FALSE(boxes[a].overlaps(boxes[b]));
        }
    }
    CHECK(pairs > 10'000);
  }

  TEST_CASE("no house crosses itself") {
    Options options;
    options.seed = 3;
    options.triangulate = true;
    options.storeys = {1, 2};
    options.jitter = 200_mm;
    for (int i = 0; i < 40; ++i) CHECK(test::count_crossings(generate(options, i)) == 0);
  }

  TEST_CASE("a triangle that is pierced is a crossing, and only triangles are looked at") {
    Body body;
    body.vertices = {{0, 0, 0},
                     {1'000'000, 0, 0},
                     {0, 1'000'000, 0},
                     {200'000, 200'000, -500'000},
                     {200'000, 200'000, 500'000},
                     {5'000'000, 0, 0}};
    body.polygons = {{{}, {{0, 1, 2}}}, {{}, {{3, 4, 5}}}};
    CHECK(test::count_crossings(body) == 2);
    body.vertices[3].z = 200'000;
    CHECK(test::count_crossings(body) == 0);
    body.polygons[0].rings[0].push_back(5);
    CHECK_THROWS_AS(test::count_crossings(body), std::invalid_argument);
  }

  TEST_CASE("every class and every finer kind occurs") {
    std::map<std::string, int> kinds;
    for (int i = 0; i < kSeeds; ++i)
      for (const Object& object : generate({}, i).objects)
        ++kinds[std::string(name_of(object.kind)) + " " + object.subclass];
    for (const char* kind : {"window Window",
                             "window roofWindow",
                             "window gableWindow",
                             "window cellarWindow",
                             "window frenchWindow",
                             "window shopWindow",
                             "door Door",
                             "door garageDoor",
                             "door frenchWindow",
                             "chimney chimney",
                             "vent vent",
                             "vent pipe",
                             "dormer shedDormer",
                             "dormer gabledDormer",
                             "balcony balcony",
                             "loggia loggia",
                             "bay bay",
                             "canopy canopy",
                             "stairs stairs",
                             "other sill",
                             "other shutter",
                             "other pilaster",
                             "other cornice",
                             "other plinth",
                             "other parapet",
                             "other ground",
                             "wall WallSurface",
                             "roof RoofSurface"})
      CHECK_MESSAGE(kinds[kind] >= 5, kind);
  }

  TEST_CASE("features that are named stand on every house that has room and others on none") {
    Options options = with_features({Feature::window, Feature::door, Feature::chimney,
                                     Feature::balcony, Feature::dormer, Feature::stairs});
    options.roof = RoofKind::gable;
    options.storeys = {2, 2};
    options.width = {12'000'000, 14'000'000};
    options.depth = {9'000'000, 10'000'000};
    for (int i = 0; i < 60; ++i) {
      const Body body = generate(options, i);
      CHECK(count(body, Class::chimney) >= 1);
      CHECK(count(body, Class::balcony) >= 1);
      CHECK(count(body, Class::dormer) >= 1);
      CHECK(count(body, Class::stairs) == 1);
      CHECK(count(body, Class::loggia) == 0);
      CHECK(count(body, Class::other) == 0);
      CHECK(body.roof == "gable");
      CHECK(body.storeys == 2);
    }
  }

  TEST_CASE("chimneys stand where they are asked to") {
    struct Case {
      ChimneyPlace place;
      std::size_t fewest_planes, most_planes;
    };
    const std::vector<Case> cases{
        {ChimneyPlace::slope, 1, 1}, {ChimneyPlace::ridge, 2, 2}, {ChimneyPlace::apex, 3, 4}};
    for (const Case& c : cases) {
      Options options = with_features({Feature::chimney, Feature::dormer});
      options.chimney = c.place;
      int chimneys = 0;
      for (int i = 0; i < kSeeds; ++i) {
        const Body body = generate(options, i);
        for (std::size_t object = 0; object < body.objects.size(); ++object) {
          if (body.objects[object].kind != Class::chimney) continue;
          ++chimneys;
          const std::size_t planes = roof_planes_around(body, static_cast<int>(object)).size();
          CHECK(planes >= c.fewest_planes);
          CHECK(planes <= c.most_planes);
        }
      }
      CHECK(chimneys > 20);
    }
  }

  TEST_CASE("the share of flush openings is about what was asked") {
    for (const double share : {0.0, 0.5, 1.0}) {
      Options options = with_features({Feature::window, Feature::door, Feature::dormer});
      options.flush = share;
      const OpeningCounts openings = count_openings(options, 100);
      CHECK(openings.flush == doctest::Approx(share * openings.all).epsilon(0.1));
    }
  }

  TEST_CASE("noise moves every corner by no more than it says and keeps the body closed") {
    Options options;
    options.noise = 5'000;
    for (int i = 0; i < 50; ++i) {
      const Body noisy = generate(options, i);
      Options exact = options;
      exact.noise = 0;
      const Body calm = generate(exact, i);
      REQUIRE(noisy.vertices.size() == calm.vertices.size());
      Um farthest = 0;
      for (std::size_t k = 0; k < calm.vertices.size(); ++k) {
        const Point d = noisy.vertices[k] - calm.vertices[k];
        farthest = std::max({farthest, std::abs(d.x), std::abs(d.y), std::abs(d.z)});
      }
      CHECK(farthest <= 5'000);
      CHECK(farthest > 4'000);
    }
  }

  TEST_CASE("triangles keep corners and volume and area of every object") {
    Options options;
    for (int i = 0; i < 60; ++i) {
      const Body whole = generate(options, i);
      Options cut = options;
      cut.triangulate = true;
      const Body triangles = generate(cut, i);
      CHECK(triangles.vertices == whole.vertices);
      CHECK(volume_m3(triangles) == doctest::Approx(volume_m3(whole)).epsilon(1e-10));
      std::vector<double> areas(whole.objects.size());
      for (const Polygon& polygon : whole.polygons)
        areas[static_cast<std::size_t>(polygon.owner.object)] +=
            length(doubled_area(whole, polygon));
      for (const Polygon& polygon : triangles.polygons) {
        REQUIRE(polygon.rings.size() == 1);
        REQUIRE(polygon.rings[0].size() == 3);
        areas[static_cast<std::size_t>(polygon.owner.object)] -=
            length(doubled_area(triangles, polygon));
      }
      for (const double left : areas) CHECK(std::abs(left) < 1e-6);
    }
  }

  TEST_CASE("a turned house has the same volume") {
    Options options;
    options.rotate_deg = 33;
    for (int i = 0; i < 30; ++i) {
      const double volume = volume_m3(generate({}, i));
      CHECK(volume_m3(generate(options, i)) == doctest::Approx(volume).epsilon(1e-6));
    }
  }

  TEST_CASE("a house of a given number of windows has about as many") {
    for (const int windows : {20, 100, 500, 2000}) {
      Options options;
      options.windows = windows;
      options.roof = RoofKind::gable;
      CHECK(count(generate(options, 0), Class::window) == doctest::Approx(windows).epsilon(0.1));
    }
  }

  TEST_CASE("houses of one run do not stand in each other") {
    Options options;
    std::vector<Extent> boxes;
    for (int i : {0, 1, 2, 199, 200, 201})
      boxes.push_back(extent_of(generate(options, i).vertices));
    for (std::size_t a = 0; a < boxes.size(); ++a)
      for (std::size_t b = 0; b < a; ++b) CHECK_FALSE(boxes[a].overlaps(boxes[b]));
  }
}

}  // namespace
}  // namespace oriel::generator
