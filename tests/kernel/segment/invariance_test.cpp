#include "io/records/stage_json.h"
#include "kernel/describe/describe.h"
#include "tests/support/changed.h"
#include "tests/support/corpus.h"
#include "tests/support/houses.h"
#include "tests/support/segmented.h"

#include <array>
#include <map>
#include <numbers>
#include <set>

#include <doctest/doctest.h>

namespace oriel {
namespace {

using test::bodies;
using test::segmented;
using test::Segmented;

std::string json_of(const Segmented& s) {
  return segmentation_json(s.building, s.segmentation, describe(s.building, s.segmentation).table);
}

/// What is left of features when places are forgotten: of each sense the volumes and the values,
/// in order.
using Summary = std::map<std::pair<Sense, std::size_t>, std::array<std::vector<double>, 2>>;
Summary summary_of(const Segmentation& s) {
  Summary out;
  for (const Feature& f : s.features) {
    auto& [volumes, values] = out[{f.sense, f.planes.size()}];
    volumes.push_back(f.volume_m3);
    values.push_back(f.value.value_or(0));
  }
  for (auto& [kind, lists] : out)
    for (auto& list : lists) std::ranges::sort(list);
  return out;
}

void check_same(const Segmentation& p, const Segmentation& q, double relative) {
  CHECK(p.stats.leaves == q.stats.leaves);
  CHECK(p.stats.inner == q.stats.inner);
  const Summary a = summary_of(p), b = summary_of(q);
  CHECK(a.size() == b.size());
  for (const auto& [kind, lists] : a) {
    REQUIRE(b.contains(kind));
    for (std::size_t l = 0; l < 2; ++l) {
      REQUIRE(lists[l].size() == b.at(kind)[l].size());
      for (std::size_t i = 0; i < lists[l].size(); ++i)
        CHECK(lists[l][i] == doctest::Approx(b.at(kind)[l][i]).epsilon(relative));
    }
  }
}

/// Boxes, senses and volumes to the last bit.
std::multiset<std::tuple<int, double, double, double, double, double, double, double>> places_of(
    const Segmentation& s) {
  std::multiset<std::tuple<int, double, double, double, double, double, double, double>> places;
  for (const Feature& f : s.features)
    places.insert({static_cast<int>(f.sense), f.box.min.x, f.box.min.y, f.box.min.z, f.box.max.x,
                   f.box.max.y, f.box.max.z, f.volume_m3});
  return places;
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("the same input gives the same bytes twice") {
    for (const auto& [name, make] : bodies())
      for (const Order order : {Order::natural, Order::paper}) {
        CAPTURE(std::string(name));
        CHECK(json_of(segmented(make(), order)) == json_of(segmented(make(), order)));
      }
    for (const Building& building : test::samples().buildings)
      CHECK(json_of(segmented(building)) == json_of(segmented(building)));
  }

  TEST_CASE("shuffling the input changes no box and no sense and no volume") {
    std::vector<Building> all = test::samples().buildings;
    for (const auto& [name, make] : bodies()) all.push_back(make());
    for (Building& building : all) {
      building = test::in_order(building);
      for (const Order order : {Order::natural, Order::paper}) {
        CAPTURE(building.id);
        const Segmented s = segmented(building, order);
        for (std::uint64_t seed = 0; seed < 3; ++seed) {
          const Segmented other = segmented(test::in_order(test::shuffled(building, seed)), order);
          CHECK(places_of(other.segmentation) == places_of(s.segmentation));
          CHECK(other.segmentation.stats.candidates == s.segmentation.stats.candidates);
        }
      }
    }
  }

  TEST_CASE("turning and mirroring keep counts and values and volumes") {
    const Vec3 axis = normalised({1, 2, 3});
    for (const auto& [name, make] : bodies()) {
      CAPTURE(std::string(name));
      const Building building = make();
      const auto by = [&](Vec3 about, double radians) {
        return test::mapped(building, [=](Vec3 p) { return test::turned(p, about, radians); });
      };
      for (const Order order : {Order::natural, Order::paper}) {
        CAPTURE(to_string(order));
        const Segmented s = segmented(building, order);
        check_same(segmented(by({0, 0, 1}, std::numbers::pi / 2), order).segmentation,
                   s.segmentation, 1e-5);
        check_same(segmented(by({0, 0, 1}, 0.7), order).segmentation, s.segmentation, 1e-4);
        check_same(segmented(test::mirrored(building), order).segmentation, s.segmentation, 1e-5);
        // Off the vertical there is no ground in which outlines are free.
        if (order == Order::paper)
          check_same(segmented(by(axis, 1), order).segmentation, s.segmentation, 1e-4);
      }
    }
  }

  TEST_CASE("a building far from the origin is segmented to the same bytes but for its frame") {
    for (const auto& [name, make] : bodies()) {
      CAPTURE(std::string(name));
      const Building building = test::framed(make());
      const Vec3 shift{600000, 5000000, 500};
      const Building moved = test::framed(test::mapped(make(), [&](Vec3 p) { return p + shift; }));
      const Segmented s = segmented(building), t = segmented(moved);
      CHECK(places_of(s.segmentation) == places_of(t.segmentation));
    }
  }

  TEST_CASE("scaling with the tolerances keeps counts and values") {
    for (const auto& [name, make] : bodies())
      for (const double scale : {0.001, 100.0}) {
        CAPTURE(std::string(name));
        CAPTURE(scale);
        SegmentOptions options;
        const Segmented s = segmented(make(), options);
        options.tolerances.plane_offset_m *= scale;
        options.tolerances.weld_m *= scale;
        const Segmented t =
            segmented(test::mapped(make(), [&](Vec3 p) { return scale * p; }), options);
        CHECK(t.segmentation.stats.leaves == s.segmentation.stats.leaves);
        CHECK(t.segmentation.stats.inner == s.segmentation.stats.inner);
        CHECK(t.segmentation.features.size() == s.segmentation.features.size());
      }
  }

  TEST_CASE("noise of a millimetre keeps counts and moves values by less than a tenth") {
    SegmentOptions options;
    options.tolerances.plane_offset_m = 0.005;
    options.tolerances.weld_m = 0.004;
    options.tolerances.value_rel = 0.05;
    for (const auto& [name, make] : bodies()) {
      CAPTURE(std::string(name));
      const Building whole = test::in_whole_facets(make());
      const Segmented s = segmented(whole, options);
      for (std::uint64_t seed = 0; seed < 3; ++seed) {
        const Segmented t = segmented(test::with_noise(whole, 0.001, seed), options);
        check_same(t.segmentation, s.segmentation, 0.1);
      }
    }
  }
}

}  // namespace
}  // namespace oriel
