#include "examples/generator/command.h"
#include "io/records/truth.h"
#include "tests/support/boxes.h"
#include "tests/support/changed.h"
#include "tests/support/corpus.h"
#include "tests/support/houses.h"
#include "tests/support/segmented.h"

#include <map>
#include <set>
#include <sstream>

#include <doctest/doctest.h>
#include <rapidcheck.h>

namespace oriel {
namespace {

using test::segmented;
using test::Segmented;

/// The setting under which the trees of simple bodies stay the same (docs/solidify.md).
Tolerances same_tree(double noise_m) {
  Tolerances tolerances;
  tolerances.plane_offset_m = 5 * noise_m;
  tolerances.weld_m = 10 * noise_m;
  tolerances.value_rel = 0.05;
  return tolerances;
}

/// What noise may not change, and the values and volumes that it may move.
struct Shape {
  std::size_t leaves, inner, features;
  friend bool operator==(const Shape&, const Shape&) = default;
};

Shape shape_of(const Segmented& s) {
  return {s.segmentation.stats.leaves, s.segmentation.stats.inner, s.segmentation.features.size()};
}

std::vector<double> values_of(const Segmented& s) {
  std::vector<double> values;
  for (const Feature& f : s.segmentation.features) values.push_back(f.value.value_or(0));
  std::ranges::sort(values);
  return values;
}

/// Both as they come, in pieces, and one polygon a facet: a piece has few vertices to tell its
/// plane by.
std::vector<Building> ways_to_tell(const Building& building) {
  return {building, test::in_whole_facets(building)};
}

void check_noise_changes_no_count(const Building& building, const Tolerances& tolerances,
                                  std::uint64_t seeds) {
  for (const Order order : {Order::natural, Order::paper}) {
    SegmentOptions options;
    options.order = order;
    options.tolerances = tolerances;
    const Segmented s = segmented(building, options);
    const std::vector<double> values = values_of(s);
    for (std::uint64_t seed = 0; seed < seeds; ++seed) {
      CAPTURE(to_string(order));
      CAPTURE(seed);
      const Segmented t = segmented(test::with_noise(building, 0.001, seed), options);
      CHECK(shape_of(t) == shape_of(s));
      CHECK(t.solid.facets.size() == s.solid.facets.size());
      const std::vector<double> noisy = values_of(t);
      REQUIRE(noisy.size() == values.size());
      for (std::size_t i = 0; i < values.size(); ++i)
        CHECK(noisy[i] == doctest::Approx(values[i]).epsilon(0.05));
    }
  }
}

/// A block with pockets in its front and blocks on its top, none near another, of sizes that differ
/// by a factor of two or not at all: what is equal stays so and what is not stays apart.
Building random_block() {
  test::BoxBody body;
  body.add({0, 0, 0}, {12, 8, 9});
  const auto sizes = rc::gen::element(0.4, 0.8, 1.6);
  const auto slots = *rc::gen::unique<std::vector<int>>(rc::gen::inRange(0, 24));
  for (const int slot : slots) {
    const double x = 2 * (slot % 6) + 0.2, v = 2 * (slot / 6 % 2) + 0.5, w = *sizes, h = *sizes,
                 depth = *sizes;
    if (slot < 12)
      body.remove({x, 0, v}, {x + w, depth, v + h});
    else
      body.add({x, v + 3, 9}, {x + w, v + 3 + h, 9 + depth});
  }
  return body.build();
}

/// Windows and doors that the truth has and the segmentation without noise finds, and those of them
/// that it finds with noise.
struct NoisyRecall {
  std::size_t without = 0, with = 0, buildings = 0, set_aside = 0;
  std::set<std::string> lost;
};

/// The windows and doors that are recessed and that a feature has the box of, at IoU 0.8.
std::set<std::string> openings_found(const Building& building, const Tolerances& tolerances,
                                     const GroundTruth& truth, const Solid& solid) {
  SegmentOptions options;
  options.tolerances = tolerances;
  const Segmentation segmentation = segment(building, solid, options);
  std::set<std::string> found;
  for (const TruthObject& object : truth.objects) {
    if (object.label != "window" && object.label != "door") continue;
    if (object.faces.empty() || object.is_detectable == false) continue;
    const Box box = object.feature_aabb.value_or(object.aabb);
    if (std::ranges::any_of(segmentation.features, [&](const Feature& f) {
          return test::iou_of(f.box.moved(building.frame.origin_m), box) >= 0.8;
        }))
      found.insert(object.id);
  }
  return found;
}

void count(const Building& building, const GroundTruth& truth, double noise_m,
           const Tolerances& tolerances, NoisyRecall& recall) {
  const auto clean = solidify(building, {});
  if (!clean.value) return;
  ++recall.buildings;
  const auto without = openings_found(building, {}, truth, *clean.value);
  recall.without += without.size();
  const Building noisy = test::with_noise(building, noise_m, 1);
  const auto solid = solidify(noisy, tolerances);
  recall.set_aside += !solid.value;
  const auto with = solid.value ? openings_found(noisy, tolerances, truth, *solid.value)
                                : std::set<std::string>{};
  for (const std::string& id : without)
    if (with.contains(id))
      ++recall.with;
    else
      recall.lost.insert(building.id + " " + id);
}

/// Of all buildings of the files whose truth is there.
NoisyRecall recall_of(const std::vector<std::string>& files, const std::vector<GroundTruth>& truths,
                      double noise_m, const Tolerances& tolerances) {
  std::map<std::string, const GroundTruth*> truth_of;
  for (const GroundTruth& truth : truths) truth_of[truth.building] = &truth;
  NoisyRecall recall;
  for (const std::string& file : files) {
    Reader reader(file);
    while (const auto record = reader.next())
      if (record->value)
        for (const Building& building : record->value->buildings)
          count(building, *truth_of.at(building.id), noise_m, tolerances, recall);
  }
  MESSAGE("noise of " << noise_m * 1000 << " mm, plane_offset " << tolerances.plane_offset_m * 1000
                      << " mm: " << recall.with << " of " << recall.without
                      << " windows and doors of " << recall.buildings << " buildings");
  return recall;
}

NoisyRecall recall_of(const std::filesystem::path& folder, double noise_m,
                      const Tolerances& tolerances) {
  std::vector<GroundTruth> truths;
  for (const std::string& file : test::files_in(folder, ".truth.json"))
    truths.push_back(read_truth(file).value.value());
  return recall_of(test::files_in(folder, ".stripped.city.json"), truths, noise_m, tolerances);
}

/// Houses of the generator with every feature there is.
NoisyRecall recall_of_generated(std::vector<const char*> more, double noise_m,
                                const Tolerances& tolerances) {
  const std::filesystem::path folder =
      std::filesystem::path(ORIEL_BINARY_DIR) / "tests" / "noise-houses";
  std::filesystem::create_directories(folder);
  const std::string houses = (folder / "houses.city.jsonl").string(),
                    truths = (folder / "houses.truth.jsonl").string();
  std::vector<const char*> arguments{"oriel-generate", "--seed",  "77",
                                     "--count",        "30",      "-o",
                                     houses.c_str(),   "--truth", truths.c_str()};
  arguments.insert(arguments.end(), more.begin(), more.end());
  std::ostringstream out, err;
  REQUIRE(generator::run_command(static_cast<int>(arguments.size()), arguments.data(), out, err) ==
          0);
  const NoisyRecall recall =
      recall_of({houses}, read_truths(truths).value.value(), noise_m, tolerances);
  std::filesystem::remove_all(folder);
  return recall;
}

/// The setting for noise of 5 mm (docs/solidify.md).
Tolerances for_5_mm() {
  Tolerances tolerances;
  tolerances.plane_offset_m = 0.008;
  return tolerances;
}

void check_all_found(const NoisyRecall& recall, std::size_t at_least) {
  for (const std::string& lost : recall.lost) MESSAGE("lost: " << lost);
  CHECK(recall.set_aside == 0);
  CHECK(recall.without >= at_least);
  CHECK(recall.with == recall.without);
}

void check_nearly_all_found(const NoisyRecall& recall, std::size_t at_least) {
  CHECK(recall.set_aside == 0);
  CHECK(recall.without >= at_least);
  CHECK(static_cast<double>(recall.with) >= 0.98 * static_cast<double>(recall.without));
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("a millimetre of noise changes no count of a body under the setting for it") {
    for (const auto& [name, make] : test::bodies())
      for (const Building& building : ways_to_tell(make())) {
        CAPTURE(std::string(name));
        check_noise_changes_no_count(building, same_tree(0.001), 4);
      }
  }

  // At the default tolerances a millimetre is half of plane_offset_m. Bodies with facets of one
  // plane far apart, or with more than three planes through a point, may come out in more cells.
  TEST_CASE("a millimetre of noise changes no count of plain bodies at the default tolerances") {
    using namespace test;
    for (const auto make : {two_boxes_on_a_slab, pocket, three_notches, long_notch, corner_notch,
                            six_pockets, l_of_boxes, gabled_house, full_house})
      for (const Building& building : ways_to_tell(make()))
        check_noise_changes_no_count(building, {}, 4);
  }

  TEST_CASE("a millimetre of noise changes no count of random blocks with pockets") {
    CHECK(rc::check([] {
      const Building building = random_block();
      const auto seed = *rc::gen::arbitrary<std::uint64_t>();
      for (const Order order : {Order::natural, Order::paper}) {
        SegmentOptions options;
        options.order = order;
        options.tolerances = same_tree(0.001);
        const Segmented s = segmented(building, options),
                        t = segmented(test::with_noise(building, 0.001, seed), options);
        RC_ASSERT(shape_of(s) == shape_of(t));
      }
    }));
  }

  TEST_CASE("a millimetre of noise hides no window and no door at the default tolerances") {
    ORIEL_NEEDS_SHARED(shared);
    check_all_found(recall_of(shared / "data" / "random3dcity", 0.001, {}), 2400);
    check_all_found(recall_of(shared / "data" / "ogc-simple-house", 0.001, {}), 2);
    check_all_found(recall_of(shared / "data" / "ingolstadt", 0.001, {}), 10);
  }

  TEST_CASE("five millimetres of noise hide hardly a window or door under the setting for it") {
    ORIEL_NEEDS_SHARED(shared);
    check_nearly_all_found(recall_of(shared / "data" / "random3dcity", 0.005, for_5_mm()), 2400);
    check_nearly_all_found(recall_of(shared / "data" / "ogc-simple-house", 0.005, for_5_mm()), 2);
    check_nearly_all_found(recall_of(shared / "data" / "ingolstadt", 0.005, for_5_mm()), 10);
  }

  TEST_CASE(
      "slow: noise hides hardly a window or door of generated houses, whole or in triangles") {
    for (const auto& more : {std::vector<const char*>{}, {"--triangulate"}}) {
      check_all_found(recall_of_generated(more, 0.001, {}), 800);
      check_nearly_all_found(recall_of_generated(more, 0.005, for_5_mm()), 800);
    }
  }
}

}  // namespace
}  // namespace oriel
