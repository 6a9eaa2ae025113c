#include "kernel/segment/flush/imprints.h"

#include "examples/generator/generate.h"
#include "io/records/truth.h"
#include "tests/support/changed.h"
#include "tests/support/corpus.h"
#include "tests/support/flush.h"
#include "tests/support/generated_house.h"
#include "tests/support/houses.h"
#include "tests/support/segmented.h"

#include <map>
#include <set>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::features_of;
using test::generated_building;
using test::Segmented;

Segmented with_imprints(Building building, const SegmentOptions& options = {}) {
  Segmented s = test::segmented(std::move(building), options);
  add_imprints(s.building, s.solid, s.segmentation, options.tolerances);
  return s;
}

const Feature& feature(const Segmented& s, FeatureId id) {
  return s.segmentation.features[id.index()];
}

/// The only imprint; the test ends if there is none or another one.
FeatureId only_imprint(const Segmented& s) {
  const auto imprints = features_of(s.segmentation, Sense::imprint);
  REQUIRE(imprints.size() == 1);
  return imprints[0];
}

void check_box(const Feature& f, Vec3 min, Vec3 max) {
  CHECK(length(f.box.min - min) < 1e-5);
  CHECK(length(f.box.max - max) < 1e-5);
}

/// What holds for the imprints of every building.
void check_imprints(const Segmented& s) {
  const auto& features = s.segmentation.features;
  for (const FeatureId id : features_of(s.segmentation, Sense::imprint)) {
    const Feature& f = feature(s, id);
    CHECK_FALSE(f.node.is_valid());
    CHECK_FALSE(f.value.has_value());
    CHECK_FALSE(f.quality.has_value());
    CHECK(f.volume_m3 == 0);
    CHECK(f.new_area_m2 > 0);
    REQUIRE(f.planes.size() == 1);
    REQUIRE(f.host_facet.has_value());
    CHECK(f.parent == s.segmentation.cells[f.host_facet->cell.index()].feature);
    CHECK(f.outline.size() >= 3);
    CHECK(std::ranges::is_sorted(f.vertices));
    CHECK(std::ranges::is_sorted(f.source_polygons));
    CHECK_FALSE(f.source_polygons.empty());
    const Plane& plane = s.segmentation.planes[f.planes[0].index()];
    for (const int v : f.outline) {
      const Vec3 p = s.segmentation.vertices[static_cast<std::size_t>(v)].point;
      CHECK(std::abs(dot(p, plane.normal) - plane.offset_m) < 1e-9);
      CHECK(std::ranges::binary_search(f.vertices, v));
    }
    // Outer imprints stand before inner ones, and have all that these have.
    if (f.host.is_valid() && feature(s, f.host).sense == Sense::imprint) {
      CHECK(f.host < id);
      CHECK(std::ranges::includes(feature(s, f.host).source_polygons, f.source_polygons));
    }
  }
  for (const Feature& f : features)
    if (f.sense != Sense::imprint && f.host.is_valid() &&
        feature(s, f.host).sense == Sense::imprint)
      CHECK(std::ranges::includes(feature(s, f.host).source_polygons, f.source_polygons));
}

double volume_of(const Box& box) {
  const Vec3 size = box.max - box.min;
  return std::max(0.0, size.x) * std::max(0.0, size.y) * std::max(0.0, size.z);
}

/// Intersection over union of two boxes grown by 5 cm: flush ones have no volume.
double overlap_of(Box p, Box q) {
  const Vec3 margin{0.05, 0.05, 0.05};
  p = {p.min - margin, p.max + margin};
  q = {q.min - margin, q.max + margin};
  const double shared = volume_of(
      {{std::max(p.min.x, q.min.x), std::max(p.min.y, q.min.y), std::max(p.min.z, q.min.z)},
       {std::min(p.max.x, q.max.x), std::min(p.max.y, q.max.y), std::min(p.max.z, q.max.z)}});
  return shared / (volume_of(p) + volume_of(q) - shared);
}

using Places = std::multiset<std::array<long, 7>>;

/// Senses and boxes to a tenth of a millimetre.
Places places_of(const Segmented& s) {
  Places places;
  const auto rounded = [](double c) { return std::lround(c * 1e4); };
  for (const Feature& f : s.segmentation.features) {
    const Box b = f.box.moved(s.building.frame.origin_m);
    places.insert({static_cast<long>(f.sense), rounded(b.min.x), rounded(b.min.y), rounded(b.min.z),
                   rounded(b.max.x), rounded(b.max.y), rounded(b.max.z)});
  }
  return places;
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("a pane that fills a ring of its wall is an imprint") {
    Building building = test::plain_block();
    const int pane = test::add_pane(building, 2, 1, 3, 2.25);
    const Segmented s = with_imprints(std::move(building));
    check_imprints(s);
    REQUIRE(s.segmentation.features.size() == 1);
    const Feature& f = feature(s, only_imprint(s));
    check_box(f, {2, 0, 1}, {3, 0, 2.25});
    CHECK(f.new_area_m2 == doctest::Approx(1.25).epsilon(1e-9));
    CHECK(f.surface_m2 == doctest::Approx(1.25).epsilon(1e-9));
    CHECK(f.source_polygons == std::vector{pane});
    CHECK(s.segmentation.planes[f.planes[0].index()].normal == Vec3{0, -1, 0});
    CHECK_FALSE(f.parent.is_valid());
    CHECK_FALSE(f.host.is_valid());
    CHECK(f.cap_point.x > 2);
    CHECK(f.cap_point.x < 3);
    CHECK(f.cap_point.y == 0);
  }

  TEST_CASE("corners that only the pane has on the edges of its ring hide nothing") {
    Building building = test::plain_block();
    const int pane = test::add_pane(building, 2, 1, 3, 2.25);
    Segmented s = test::segmented(building);
    auto& ring = s.building.polygons.back().rings[0];
    REQUIRE(s.building.polygons.back().source == pane);
    ring.insert(ring.begin() + 1, {test::add_vertex(s.building, {2.25, 0, 1}),
                                   test::add_vertex(s.building, {2.5, 0, 1})});
    add_imprints(s.building, s.solid, s.segmentation);
    check_imprints(s);
    CHECK(feature(s, only_imprint(s)).source_polygons == std::vector{pane});
  }

  TEST_CASE("a door that its wall runs along on three sides is an imprint") {
    const Segmented s = with_imprints(test::block_with_door());
    check_imprints(s);
    const Feature& f = feature(s, only_imprint(s));
    check_box(f, {4, 0, 0}, {5, 0, 2});
    CHECK(f.source_polygons == std::vector{6});
  }

  TEST_CASE("the two leaves of a door are one imprint") {
    Building building = test::block_with_door();
    const int foot = test::add_vertex(building, {4.5, 0, 0});
    const int head = test::add_vertex(building, {4.5, 0, 2});
    auto& wall = building.polygons[0].rings[0];
    wall.insert(wall.begin() + 3, head);
    auto& ground = building.polygons[5].rings[0];
    ground.insert(ground.end() - 2, foot);
    Polygon right = building.polygons[6];
    const auto door = right.rings[0];
    building.polygons[6].rings = {{door[0], foot, head, door[3]}};
    right.rings = {{foot, door[1], door[2], head}};
    right.source = 7;
    building.polygons.push_back(right);
    const Segmented s = with_imprints(std::move(building));
    const Feature& f = feature(s, only_imprint(s));
    check_box(f, {4, 0, 0}, {5, 0, 2});
    CHECK(f.source_polygons == std::vector{6, 7});
  }

  TEST_CASE("a door between plinths in its plane is an imprint without them") {
    const Segmented s = with_imprints(test::building_of(
        {{{0, 0, 0.5},
          {4, 0, 0.5},
          {4, 0, 2},
          {5, 0, 2},
          {5, 0, 0.5},
          {10, 0, 0.5},
          {10, 0, 6},
          {0, 0, 6}},
         {{10, 0, 0}, {10, 8, 0}, {10, 8, 6}, {10, 0, 6}, {10, 0, 0.5}},
         {{10, 8, 0}, {0, 8, 0}, {0, 8, 6}, {10, 8, 6}},
         {{0, 8, 0}, {0, 0, 0}, {0, 0, 0.5}, {0, 0, 6}, {0, 8, 6}},
         {{0, 0, 6}, {10, 0, 6}, {10, 8, 6}, {0, 8, 6}},
         {{0, 0, 0}, {0, 8, 0}, {10, 8, 0}, {10, 0, 0}, {5, 0, 0}, {4, 0, 0}},
         {{0, 0, 0}, {4, 0, 0}, {4, 0, 0.5}, {0, 0, 0.5}},
         {{5, 0, 0}, {10, 0, 0}, {10, 0, 0.5}, {5, 0, 0.5}},
         {{4, 0, 0}, {5, 0, 0}, {5, 0, 0.5}, {5, 0, 2}, {4, 0, 2}, {4, 0, 0.5}}}));
    const Feature& f = feature(s, only_imprint(s));
    check_box(f, {4, 0, 0}, {5, 0, 2});
    CHECK(f.source_polygons == std::vector{8});
  }

  TEST_CASE("a door over the slab of its balcony is an imprint without the slab") {
    // The ring of the wall runs around door and slab together.
    Building building = test::in_whole_facets(
        test::BoxBody().add({0, 0, 0}, {10, 8, 6}).add({3, -1, 2.75}, {6, 0, 3}).build());
    Polygon& wall = test::front_wall(building);
    REQUIRE(wall.rings.size() == 2);
    const auto vertex = [&](double x, double z) { return test::add_vertex(building, {x, 0, z}); };
    const std::vector<int> door{vertex(4, 3), vertex(5, 3), vertex(5, 5), vertex(4, 5)};
    // Clockwise: up the left side of the slab, around the door, and back below.
    wall.rings[1] = {vertex(3, 2.75), vertex(3, 3), door[0],      door[3],
                     door[2],         door[1],      vertex(6, 3), vertex(6, 2.75)};
    for (Polygon& polygon : building.polygons) {
      auto& ring = polygon.rings[0];
      for (std::size_t i = 0; i < ring.size(); ++i)  // the top of the slab meets the door
        if (ring[i] == vertex(6, 3) && ring[(i + 1) % ring.size()] == vertex(3, 3)) {
          ring.insert(ring.begin() + static_cast<std::ptrdiff_t>(i) + 1, {door[1], door[0]});
          break;
        }
    }
    Polygon leaf;
    leaf.rings = {door};
    leaf.source = static_cast<int>(building.polygons.size());
    building.polygons.push_back(leaf);
    const Segmented s = with_imprints(std::move(building));
    const Feature& f = feature(s, only_imprint(s));
    check_box(f, {4, 0, 3}, {5, 0, 5});
    for (const FeatureId slab : features_of(s.segmentation, Sense::protrusion))
      CHECK_FALSE(feature(s, slab).host.is_valid());
  }

  TEST_CASE("a flush frame owns the sashes in it") {
    const Segmented s = with_imprints(test::block_with_sashes());
    check_imprints(s);
    const FeatureId frame = only_imprint(s);
    const auto sashes = features_of(s.segmentation, Sense::hole);
    REQUIRE(sashes.size() == 2);
    for (const FeatureId sash : sashes) CHECK(feature(s, sash).host == frame);
    const Feature& f = feature(s, frame);
    check_box(f, {2, 0, 1}, {4, 0.04, 2.5});
    CHECK(f.new_area_m2 == doctest::Approx(3).epsilon(1e-6));
    CHECK(f.source_polygons.size() == 11);
    CHECK_FALSE(f.host.is_valid());
  }

  TEST_CASE("recesses beside a flush mullion are one opening with it") {
    Building building = test::in_whole_facets(test::BoxBody()
                                                  .add({0, 0, 0}, {10, 8, 6})
                                                  .remove({2, 0, 1}, {2.875, 0.125, 2.5})
                                                  .remove({3.125, 0, 1}, {4, 0.125, 2.5})
                                                  .build());
    Polygon& wall = test::front_wall(building);
    const auto vertex = [&](double x, double z) { return test::add_vertex(building, {x, 0, z}); };
    wall.rings = {wall.rings[0],
                  {vertex(2, 1), vertex(2, 2.5), vertex(2.875, 2.5), vertex(3.125, 2.5),
                   vertex(4, 2.5), vertex(4, 1), vertex(3.125, 1), vertex(2.875, 1)}};
    Polygon mullion;
    mullion.rings = {{vertex(2.875, 1), vertex(3.125, 1), vertex(3.125, 2.5), vertex(2.875, 2.5)}};
    mullion.source = static_cast<int>(building.polygons.size());
    building.polygons.push_back(mullion);
    const Segmented s = with_imprints(std::move(building));
    check_imprints(s);
    const FeatureId window = only_imprint(s);
    check_box(feature(s, window), {2, 0, 1}, {4, 0.125, 2.5});
    for (const FeatureId hole : features_of(s.segmentation, Sense::hole))
      CHECK(feature(s, hole).host == window);
  }

  TEST_CASE("a pane in a flush frame is an imprint of the frame") {
    Building building = test::plain_block();
    const int frame = test::add_pane(building, 2, 1, 4, 2.5);
    const int pane = test::add_pane(building, 2.25, 1.25, 3.75, 2.25, frame);
    const Segmented s = with_imprints(std::move(building));
    check_imprints(s);
    REQUIRE(s.segmentation.features.size() == 2);
    CHECK(feature(s, FeatureId{0}).source_polygons == std::vector{frame, pane});
    CHECK(feature(s, FeatureId{1}).source_polygons == std::vector{pane});
    CHECK(feature(s, FeatureId{1}).host == FeatureId{0});
    CHECK_FALSE(feature(s, FeatureId{1}).parent.is_valid());
  }

  TEST_CASE("a pane at the back of a recess belongs to the recess") {
    Building building = test::in_whole_facets(
        test::BoxBody().add({0, 0, 0}, {10, 8, 6}).remove({2, 0, 1}, {4, 0.25, 2.5}).build());
    // Mirrored front to back, the back of the recess lies in the plane that add_pane draws in.
    for (Vec3& p : building.vertices) p.y -= 0.25;
    Polygon* back = nullptr;
    for (Polygon& polygon : building.polygons)
      if (std::ranges::all_of(polygon.rings[0], [&](int v) {
            return building.vertices[static_cast<std::size_t>(v)].y == 0;
          }))
        back = &polygon;
    REQUIRE(back != nullptr);
    const int pane = test::add_pane(building, 2.5, 1.25, 3.5, 2.25, back->source);
    const Segmented s = with_imprints(std::move(building));
    check_imprints(s);
    const Feature& f = feature(s, only_imprint(s));
    CHECK(f.source_polygons == std::vector{pane});
    REQUIRE(f.host.is_valid());
    CHECK(f.parent == f.host);
    CHECK(feature(s, f.host).sense == Sense::hole);
    CHECK(s.segmentation.planes[f.planes[0].index()].normal == Vec3{0, -1, 0});
  }

  TEST_CASE("a recess below the plane tolerance is flush") {
    Building building = test::in_whole_facets(
        test::BoxBody().add({0, 0, 0}, {10, 8, 6}).remove({2, 0, 1}, {3, 0.125, 2}).build());
    for (Vec3& p : building.vertices)
      if (p.y == 0.125) p.y = 0.0015;
    const Segmented s = with_imprints(std::move(building));
    check_imprints(s);
    REQUIRE(s.segmentation.features.size() == 1);
    check_box(feature(s, only_imprint(s)), {2, 0, 1}, {3, 0, 2});
    CHECK(feature(s, FeatureId{0}).source_polygons.size() == 5);
  }

  TEST_CASE("a ring that is tied to its polygon by a bridge is a ring") {
    Building building = test::plain_block();
    test::add_pane(building, 2, 1, 3, 2);
    Polygon& wall = test::front_wall(building);
    auto bridged = wall.rings[0];
    bridged.push_back(bridged[0]);
    const auto& hole = wall.rings[1];
    bridged.insert(bridged.end(), hole.begin(), hole.end());
    bridged.push_back(hole[0]);
    wall.rings = {bridged};
    const Segmented s = with_imprints(std::move(building));
    check_box(feature(s, only_imprint(s)), {2, 0, 1}, {3, 0, 2});
  }

  TEST_CASE("hints delimit what triangles hide") {
    Building door = test::block_with_door();
    // The wall in convex pieces beside and above the door.
    const auto ring = door.polygons[0].rings[0];
    const int left = test::add_vertex(door, {4, 0, 6}), right = test::add_vertex(door, {5, 0, 6});
    door.polygons[0].rings = {{ring[0], ring[1], ring[2], left, ring[7]}};
    auto& roof = door.polygons[4].rings[0];
    std::ranges::rotate(roof, roof.begin() + 2);
    roof.insert(roof.end() - 1, {left, right});
    for (const auto& piece : {std::vector{ring[2], ring[3], right, left},
                              std::vector{ring[3], ring[4], ring[5], ring[6], right}}) {
      Polygon polygon = door.polygons[0];
      polygon.rings = {piece};
      polygon.source = static_cast<int>(door.polygons.size());
      door.polygons.push_back(polygon);
    }
    const Building silent = test::in_triangles(door);
    CHECK(features_of(with_imprints(silent).segmentation, Sense::imprint).empty());
    door.polygons[6].hint = "oak";
    const Segmented s = with_imprints(test::in_triangles(door));
    check_imprints(s);
    const Feature& f = feature(s, only_imprint(s));
    check_box(f, {4, 0, 0}, {5, 0, 2});
    CHECK(f.source_polygons.size() == 2);
    // What the hint says does not matter.
    door.polygons[6].hint = "WallSurface";
    CHECK(places_of(with_imprints(test::in_triangles(door))) == places_of(s));
  }

  TEST_CASE("bodies in convex pieces and in triangles have no imprints") {
    for (const test::NamedBody& body : test::bodies()) {
      CAPTURE(body.name);
      CHECK(features_of(with_imprints(body.make()).segmentation, Sense::imprint).empty());
      CHECK(features_of(with_imprints(test::in_whole_facets(body.make())).segmentation,
                        Sense::imprint)
                .empty());
    }
    generator::Options options;
    options.triangulate = true;
    for (int i = 0; i < 10; ++i) {
      const Segmented s = with_imprints(generated_building(generator::generate(options, i)));
      CHECK(features_of(s.segmentation, Sense::imprint).empty());
    }
  }

  TEST_CASE("triangles leave every flush opening of generated houses and make no other") {
    generator::Options options;
    options.seed = 3;
    options.flush = 0.5;
    std::size_t flush = 0;
    const auto boxes = [](const generator::Body& body) {
      std::multiset<std::array<long, 6>> places;
      const Segmented s = with_imprints(generated_building(body));
      check_imprints(s);
      for (const FeatureId id : features_of(s.segmentation, Sense::imprint)) {
        const Box b = feature(s, id).box.moved(s.building.frame.origin_m);
        const auto mm = [](double c) { return std::lround(c * 1e3); };
        places.insert(
            {mm(b.min.x), mm(b.min.y), mm(b.min.z), mm(b.max.x), mm(b.max.y), mm(b.max.z)});
      }
      return places;
    };
    for (int i = 0; i < 10; ++i) {
      CAPTURE(i);
      options.triangulate = false;
      const auto drawn = boxes(generator::generate(options, i));
      options.triangulate = true;
      CHECK(boxes(generator::generate(options, i)) == drawn);
      flush += drawn.size();
    }
    CHECK(flush > 70);
  }

  TEST_CASE("every flush opening of generated houses is an imprint and nothing else is") {
    generator::Options options;
    options.seed = 3;
    options.flush = 0.5;
    options.noise = 500;  // micrometres
    std::size_t flush = 0;
    for (int i = 0; i < 30; ++i) {
      CAPTURE(i);
      const generator::Body body = generator::generate(options, i);
      const Segmented s = with_imprints(generated_building(body));
      check_imprints(s);
      std::map<int, std::set<int>> of_object;
      for (int p = 0; p < std::ssize(body.polygons); ++p)
        of_object[body.polygons[static_cast<std::size_t>(p)].owner.object].insert(p);
      std::set<std::vector<int>> imprints;
      for (const FeatureId id : features_of(s.segmentation, Sense::imprint)) {
        const auto& polygons = feature(s, id).source_polygons;
        imprints.insert(polygons);
        const int object = body.polygons[static_cast<std::size_t>(polygons[0])].owner.object;
        CHECK(is_opening(body.objects[static_cast<std::size_t>(object)].kind));
        for (const int p : polygons)
          CHECK(body.polygons[static_cast<std::size_t>(p)].owner.object == object);
      }
      for (int o = 0; o < std::ssize(body.objects); ++o) {
        if (body.objects[static_cast<std::size_t>(o)].recess != generator::Um{0}) continue;
        CAPTURE(body.objects[static_cast<std::size_t>(o)].name);
        ++flush;
        CHECK(imprints.contains({of_object[o].begin(), of_object[o].end()}));
      }
    }
    CHECK(flush > 200);
  }

  TEST_CASE("shuffling and turning and noise change no imprint") {
    for (const Building& read : test::samples().buildings) {
      const Building building = test::in_order(read);
      CAPTURE(building.id);
      const Segmented plain = with_imprints(building);
      const Places places = places_of(plain);
      for (const std::uint64_t seed : {1U, 2U}) {
        std::vector<int> origin;
        const Segmented shuffled =
            with_imprints(test::in_order(test::shuffled(building, seed, &origin), &origin));
        CHECK(places_of(shuffled) == places);
        std::set<std::set<int>> was, is;
        for (const Feature& f : plain.segmentation.features)
          was.emplace(f.source_polygons.begin(), f.source_polygons.end());
        for (const Feature& f : shuffled.segmentation.features) {
          std::set<int> old;
          for (const int p : f.source_polygons) old.insert(origin[static_cast<std::size_t>(p)]);
          is.insert(old);
        }
        CHECK(was == is);
      }
      const auto count = [](const Segmented& s) {
        return features_of(s.segmentation, Sense::imprint).size();
      };
      const auto changed = [&](auto map) { return test::framed(test::mapped(building, map)); };
      CHECK(count(with_imprints(changed([](Vec3 p) {
              return test::turned(p, normalised({1, 2, 3}), 0.7);
            }))) == count(plain));
      CHECK(count(with_imprints(test::framed(test::mirrored(building)))) == count(plain));
      CHECK(count(with_imprints(test::with_noise(building, 0.0004, 5))) == count(plain));
    }
  }

  TEST_CASE("a pane that floats behind its opening joins it") {
    Building building = test::in_whole_facets(
        test::BoxBody().add({0, 0, 0}, {10, 8, 6}).remove({2, 0, 1}, {3, 0.125, 2}).build());
    const Solid solid = test::solid_of(building);
    Polygon pane;
    pane.source = static_cast<int>(building.polygons.size());
    for (const Vec3 p : {Vec3{2, 0.25, 1}, {3, 0.25, 1}, {3, 0.25, 2}, {2, 0.25, 2}}) {
      pane.rings.resize(1);
      pane.rings[0].push_back(test::add_vertex(building, p));
    }
    building.polygons.push_back(pane);
    Segmentation segmentation = segment(building, solid);
    add_imprints(building, solid, segmentation);
    REQUIRE(segmentation.features.size() == 1);
    const Feature& f = segmentation.features[0];
    CHECK(f.sense == Sense::hole);
    CHECK(f.source_polygons.back() == pane.source);
    check_box(f, {2, 0, 1}, {3, 0.25, 2});
  }

  TEST_CASE("a pane laid on an unbroken wall is an imprint") {
    Building building = test::plain_block();
    const Solid solid = test::solid_of(building);
    Polygon pane;
    pane.source = static_cast<int>(building.polygons.size());
    pane.rings = {test::front_ring(building, 2, 1, 3, 2)};
    building.polygons.push_back(pane);
    Polygon far = pane;  // nothing that it belongs to
    far.source = pane.source + 1;
    far.rings = {{}};
    for (const int v : pane.rings[0])
      far.rings[0].push_back(test::add_vertex(
          building, building.vertices[static_cast<std::size_t>(v)] + Vec3{5, -0.3, 0}));
    building.polygons.push_back(far);
    Segmented s{building, solid, segment(building, solid)};
    add_imprints(s.building, s.solid, s.segmentation);
    check_imprints(s);
    const Feature& f = feature(s, only_imprint(s));
    check_box(f, {2, 0, 1}, {3, 0, 2});
    CHECK(f.source_polygons == std::vector{pane.source});
    CHECK(s.segmentation.planes[f.planes[0].index()].normal == Vec3{0, -1, 0});
  }

  TEST_CASE(
      "all windows of random3dcity and most of the solid buildings of ingolstadt are features") {
    ORIEL_NEEDS_SHARED(shared);
    for (const auto& [set, least] : {std::pair{"random3dcity", 1.0}, {"ingolstadt", 0.93}}) {
      std::size_t windows = 0, found = 0;
      for (const std::string& file : test::files_in(shared / "data" / set, ".truth.json")) {
        const GroundTruth truth = read_truth(file).value.value();
        Reader reader(file.substr(0, file.size() - std::string(".truth.json").size()) +
                      ".stripped.city.json");
        const Building building = reader.next()->value->buildings.at(0);
        if (!solidify(building, {}).value) continue;
        const Segmented s = with_imprints(building);
        for (const TruthObject& object : truth.objects) {
          if (object.label != "window" || object.faces.empty()) continue;
          ++windows;
          const Box box = object.feature_aabb.value_or(object.aabb);
          found += std::ranges::any_of(s.segmentation.features, [&](const Feature& f) {
            return overlap_of(f.box.moved(building.frame.origin_m), box) >= 0.8;
          });
        }
      }
      MESSAGE(std::string(set) << ": " << found << " of " << windows << " windows");
      CHECK(windows > 100);
      CHECK(static_cast<double>(found) >= least * static_cast<double>(windows));
    }
  }
}

}  // namespace
}  // namespace oriel
