#include "kernel/segment/rings/ring_features.h"

#include "kernel/segment/flush/imprints.h"
#include "kernel/segment/remove.h"
#include "kernel/solidify/open_shell.h"
#include "tests/support/changed.h"
#include "tests/support/corpus.h"
#include "tests/support/flush.h"
#include "tests/support/generated_house.h"
#include "tests/support/houses.h"
#include "tests/support/segmented.h"
#include "tests/support/triangle_wall.h"

#include <set>
#include <tuple>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::Segmented;

/// The building without some of its polygons, taken as open.
Segmented opened(Building building, const std::set<int>& gone) {
  std::erase_if(building.polygons,
                [&](const Polygon& polygon) { return gone.contains(polygon.source); });
  const auto shell = open_shell(building);
  REQUIRE(shell.has_value());
  Segmented s{std::move(building), *shell, segment_open(*shell)};
  add_ring_features(s.building, s.solid, s.segmentation);
  add_imprints(s.building, s.solid, s.segmentation);
  return s;
}

/// The polygon that faces straight down, or -1.
int ground_of(const Building& building) {
  for (const Polygon& polygon : building.polygons) {
    bool is_low = true;
    for (const int v : polygon.rings[0])
      is_low = is_low && building.vertices[static_cast<std::size_t>(v)].z < 1e-6;
    if (is_low) return polygon.source;
  }
  return -1;
}

using Box6 = std::tuple<long, long, long, long, long, long>;

/// The boxes of features in millimetres, with their senses.
std::multiset<std::pair<Box6, Sense>> boxes_of(const Segmented& s) {
  std::multiset<std::pair<Box6, Sense>> boxes;
  const auto mm = [](double c) { return std::lround(c * 1000); };
  for (const Feature& f : s.segmentation.features)
    boxes.insert({{mm(f.box.min.x), mm(f.box.min.y), mm(f.box.min.z), mm(f.box.max.x),
                   mm(f.box.max.y), mm(f.box.max.z)},
                  f.sense});
  return boxes;
}

}  // namespace

TEST_SUITE("kernel/segment") {
  TEST_CASE("without its ground a house has the windows that cuts find in the closed one") {
    for (const test::NamedBody body :
         {test::NamedBody{"six_pockets", test::six_pockets}, {"full_house", test::full_house}}) {
      CAPTURE(body.name);
      const Building whole = test::in_whole_facets(body.make());
      const Segmented closed = test::segmented(whole);
      const Segmented open = opened(whole, {ground_of(whole)});
      CHECK(open.segmentation.cells.size() == 1);
      CHECK(open.segmentation.cells[0].flag == LeafFlag::open);
      const auto found = boxes_of(open);
      std::size_t windows = 0;
      for (const auto& [box, sense] : boxes_of(closed)) {
        if (sense != Sense::hole) continue;
        ++windows;
        CHECK(found.contains({box, sense}));
      }
      CHECK(windows >= 6);
      for (const Feature& f : open.segmentation.features) {
        CHECK(f.is_uncut);
        CHECK_FALSE(f.node.is_valid());
        CHECK(f.volume_m3 == 0);
        CHECK(std::ranges::is_sorted(f.source_polygons));
      }
    }
  }

  TEST_CASE("every opening of a generated house without ground and roof is found by its ring") {
    generator::Options options;
    options.seed = 5;
    options.flush = 0.5;
    std::size_t openings = 0, found = 0;
    for (int i = 0; i < 20; ++i) {
      const generator::Body body = generator::generate(options, i);
      const Building whole = test::generated_building(body);
      const Segmented open = opened(whole, {ground_of(whole)});
      std::set<std::vector<int>> sets;
      for (const Feature& f : open.segmentation.features) sets.insert(f.source_polygons);
      for (int o = 0; o < std::ssize(body.objects); ++o) {
        if (body.objects[static_cast<std::size_t>(o)].kind != generator::Class::window) continue;
        std::vector<int> polygons;
        for (int p = 0; p < std::ssize(body.polygons); ++p)
          if (body.polygons[static_cast<std::size_t>(p)].owner.object == o) polygons.push_back(p);
        ++openings;
        found += sets.contains(polygons) ? 1 : 0;
      }
    }
    CHECK(openings > 300);
    CHECK(found >= openings * 99 / 100);
  }

  TEST_CASE("shuffling changes no ring feature") {
    for (const Building& read : test::samples().buildings) {
      const Building sample = test::in_order(read);
      CAPTURE(sample.id);
      const Segmented plain = opened(sample, {sample.polygons[0].source});
      CHECK_FALSE(plain.segmentation.features.empty());
      for (const std::uint64_t seed : {1U, 2U}) {
        std::vector<int> origin;
        const Building shuffled = test::in_order(test::shuffled(sample, seed, &origin), &origin);
        std::set<int> gone;
        for (int p = 0; p < std::ssize(origin); ++p)
          if (origin[static_cast<std::size_t>(p)] == sample.polygons[0].source) gone.insert(p);
        CHECK(boxes_of(opened(shuffled, gone)) == boxes_of(plain));
      }
    }
  }

  TEST_CASE("a moved building has as many ring features") {
    for (const Building& sample : test::samples().buildings) {
      CAPTURE(sample.id);
      const std::set<int> gone{sample.polygons[0].source};
      const Building moved = test::mapped(sample, [](Vec3 p) { return p + Vec3{16, 32, 8}; });
      const Segmented here = opened(sample, gone), there = opened(moved, gone);
      CHECK(there.segmentation.features.size() == here.segmentation.features.size());
    }
  }

  TEST_CASE("where every ring has its cut no ring feature is added") {
    for (const test::NamedBody& body : test::bodies()) {
      CAPTURE(body.name);
      Segmented s = test::segmented(body.make());
      const std::size_t before = s.segmentation.features.size();
      add_ring_features(s.building, s.solid, s.segmentation);
      CHECK(s.segmentation.features.size() == before);
    }
    for (const Building& sample : test::samples().buildings) {
      CAPTURE(sample.id);
      Segmented s = test::segmented(sample);
      const std::size_t before = s.segmentation.features.size();
      add_ring_features(s.building, s.solid, s.segmentation);
      CHECK(s.segmentation.features.size() == before);
    }
  }

  TEST_CASE("a ring that no cut frees is an uncut feature and is not removed") {
    // As if no cut had been found: the tree's only feature is taken out of the record.
    Segmented s = test::segmented(test::in_whole_facets(test::pocket()));
    REQUIRE(s.segmentation.features.size() == 1);
    const Box box = s.segmentation.features[0].box;
    s.segmentation.features.clear();
    for (Cell& cell : s.segmentation.cells) cell.feature = FeatureId{};
    add_ring_features(s.building, s.solid, s.segmentation);
    REQUIRE(s.segmentation.features.size() == 1);
    const Feature& f = s.segmentation.features[0];
    CHECK(f.is_uncut);
    CHECK(f.sense == Sense::hole);
    CHECK(length(f.box.min - box.min) < 1e-6);
    CHECK(length(f.box.max - box.max) < 1e-6);
    const Remainder left = remove_features(s.solid, s.segmentation, {FeatureId{0}});
    CHECK(left.removed.empty());
    REQUIRE(left.refused.size() == 1);
    CHECK(left.refused[0].reason == "no single cut isolates it: only its ring is known");
  }

  TEST_CASE(
      "windows of an open building are apart whether triangles without area are there or not") {
    for (const test::Slivers slivers : {test::Slivers::kept, test::Slivers::left_out}) {
      Building building = test::block_with_row(slivers);
      building = test::in_triangles(building);
      const Segmented s = opened(building, {0, 1});  // without its ground
      const auto pocket = [](long x) {
        return std::pair(Box6{x, 0, 1000, x + 2000, 150, 2000}, Sense::hole);
      };
      CHECK(boxes_of(s) == std::multiset{pocket(2000), pocket(7000)});
    }
  }

  TEST_CASE("a pane that floats in a hole of an open wall belongs to the opening") {
    Building building = test::in_whole_facets(
        test::BoxBody().add({0, 0, 0}, {10, 8, 6}).remove({2, 0, 1}, {3, 0.125, 2}).build());
    std::set<int> gone;  // the niche: what is left is a hole
    for (const Polygon& polygon : building.polygons) {
      Box box;
      for (const int v : polygon.rings[0]) box.grow(building.vertices[static_cast<std::size_t>(v)]);
      if (box.max.x <= 3 && box.min.x >= 2) gone.insert(polygon.source);
    }
    REQUIRE(gone.size() == 5);
    Polygon pane;
    pane.source = static_cast<int>(building.polygons.size());
    pane.rings.resize(1);
    for (const Vec3 p :
         {Vec3{2.1, 0.25, 1.1}, {2.9, 0.25, 1.1}, {2.9, 0.25, 1.9}, {2.1, 0.25, 1.9}})
      pane.rings[0].push_back(test::add_vertex(building, p));
    building.polygons.push_back(pane);
    const Segmented s = opened(building, gone);
    REQUIRE(s.segmentation.features.size() == 1);
    const Feature& f = s.segmentation.features[0];
    CHECK(f.sense == Sense::hole);
    CHECK(f.source_polygons == std::vector{pane.source});
    CHECK(length(f.box.min - Vec3{2, 0, 1}) < 1e-3);
    CHECK(length(f.box.max - Vec3{3, 0.25, 2}) < 1e-3);
  }

  TEST_CASE("the front and the back of a frame are one opening") {
    Building building = test::plain_block();
    std::vector<int> ring = test::front_ring(building, 2, 1, 3, 2);
    test::front_wall(building).rings.emplace_back(ring.rbegin(), ring.rend());
    const auto rectangle = [&](double y, double inset) {
      std::vector<int> corners;
      for (const Vec3 p : {Vec3{2 + inset, y, 1 + inset},
                           {3 - inset, y, 1 + inset},
                           {3 - inset, y, 2 - inset},
                           {2 + inset, y, 2 - inset}})
        corners.push_back(test::add_vertex(building, p));
      return corners;
    };
    const auto add = [&](std::vector<std::vector<int>> rings, bool is_turned) {
      Polygon polygon;
      polygon.source = static_cast<int>(building.polygons.size());
      if (is_turned)
        for (auto& corners : rings) std::ranges::reverse(corners);
      polygon.rings = std::move(rings);
      building.polygons.push_back(std::move(polygon));
    };
    for (const bool is_back : {false, true}) {
      const double y = is_back ? 0.17 : 0.01;
      std::vector<int> inner = rectangle(y, 0.05);
      std::ranges::reverse(inner);
      add({rectangle(y, 0), inner}, is_back);
      add({rectangle(is_back ? 0.1 : 0.08, 0.05)}, is_back);
    }
    const Segmented s = opened(building, {ground_of(building)});
    std::vector<double> areas_m2;
    for (const Feature& f : s.segmentation.features)
      if (std::abs(f.box.min.x - 2) < 1e-3 && std::abs(f.box.max.x - 3) < 1e-3)
        areas_m2.push_back(f.new_area_m2);
    CHECK(areas_m2.size() == 1);
    CHECK(s.segmentation.features.size() == 2);  // and the glass
  }
}

}  // namespace oriel
