#include "generalise/operators/omit.h"

#include "tests/generalise/line.h"
#include "tests/support/shapes.h"

#include <algorithm>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::test;

namespace {

/// A block of 10 x 8 x 6 m: 480 m3, 6 facets.
BoxBody block() { return BoxBody().add({0, 0, 0}, {10, 8, 6}); }

Plan omit_all(const Line& line) {
  Plan plan{20000, {}, {}};
  for (int i = 0; i < std::ssize(line.segmentation.features); ++i)
    plan.steps.push_back({FeatureId{i}, "omit", "test"});
  return plan;
}

Remainder without_all(const Line& line) {
  return omit(line.solid, line.segmentation, omit_all(line), {});
}

/// All features gone, nothing refused, and the bare block left without a seam.
void check_bare(const BoxBody& body, std::size_t features) {
  const Line line = line_of(body.build());
  REQUIRE(line.segmentation.features.size() == features);
  const Remainder rest = without_all(line);
  CHECK(rest.refused.empty());
  CHECK(rest.removed.size() == features);
  CHECK(is_closed(rest.solid));
  CHECK(rest.solid.facets.size() == 6);
  CHECK(volume_m3(rest.solid) == doctest::Approx(480).epsilon(1e-9));
}

}  // namespace

TEST_SUITE("generalise") {
  TEST_CASE("a recess is filled without a seam") {
    check_bare(block().remove({2, 0, 1}, {3, 0.2, 2}), 1);
  }

  TEST_CASE("a block on the roof is cut without a seam") {
    check_bare(block().add({4, 4, 6}, {5, 5, 7}), 1);
  }

  TEST_CASE("a recess that reaches the ground is filled") {
    check_bare(block().remove({2, 0, 0}, {3, 0.2, 2}), 1);
  }

  TEST_CASE("a block at the wall that stands on the ground is cut") {
    check_bare(block().add({2, -1, 0}, {4, 0, 1}), 1);
  }

  TEST_CASE("a cavity is filled") { check_bare(block().remove({2, 2, 2}, {4, 4, 4}), 1); }

  TEST_CASE("a hole that runs through the wall is filled") {
    const Line line = line_of(block().remove({2, 0, 2}, {3, 8, 3}).build());
    const Remainder rest = without_all(line);
    CHECK(is_closed(rest.solid));
    CHECK(volume_m3(rest.solid) == doctest::Approx(480).epsilon(1e-9));
    CHECK(rest.solid.facets.size() == 6);
  }

  TEST_CASE("what sits on a feature goes with it") {
    const Line line =
        line_of(block().add({3, 3, 6}, {6, 6, 8}).remove({4, 3, 6.5}, {5, 3.2, 7.5}).build());
    REQUIRE(line.segmentation.features.size() == 2);
    Plan plan{20000, {}, {}};
    for (int i = 0; i < 2; ++i)
      if (line.segmentation.features[static_cast<std::size_t>(i)].sense == Sense::protrusion)
        plan.steps.push_back({FeatureId{i}, "omit", "test"});
    REQUIRE(plan.steps.size() == 1);
    const Remainder rest = omit(line.solid, line.segmentation, plan, {});
    CHECK(rest.removed.size() == 2);
    CHECK(volume_m3(rest.solid) == doctest::Approx(480).epsilon(1e-9));
    CHECK(rest.solid.facets.size() == 6);
  }

  TEST_CASE("only the features of the plan go") {
    const Line line =
        line_of(block().remove({2, 0, 1}, {3, 0.2, 2}).remove({5, 0, 1}, {6, 0.25, 2}).build());
    REQUIRE(line.segmentation.features.size() == 2);
    for (int i = 0; i < 2; ++i) {
      const Remainder rest =
          omit(line.solid, line.segmentation, Plan{1, {{FeatureId{i}, "omit", ""}}, {}}, {});
      const Feature& gone = line.segmentation.features[static_cast<std::size_t>(i)];
      CHECK(rest.removed == std::vector<FeatureId>{FeatureId{i}});
      CHECK(volume_m3(rest.solid) ==
            doctest::Approx(volume_m3(line.solid) + gone.volume_m3).epsilon(1e-9));
      CHECK(rest.solid.facets.size() == 11);
    }
  }

  TEST_CASE("no part of more than half of the building goes") {
    // Under a roof that juts out the walls are a feature of 10.92 m: at 1:25000 too small.
    const Line line = line_of_sample("hip");
    const auto main = std::ranges::find_if(line.segmentation.features, [&](const Feature& f) {
      return f.sense == Sense::protrusion && f.volume_m3 > volume_m3(line.solid) / 2;
    });
    REQUIRE(main != line.segmentation.features.end());
    const FeatureId id{static_cast<int>(main - line.segmentation.features.begin())};
    const Coarser coarser = generalised(line, 25000);
    CHECK(std::ranges::find(coarser.plan.steps, id, &Step::feature) != coarser.plan.steps.end());
    CHECK(!std::ranges::binary_search(coarser.generalised.removed, id));
    REQUIRE(coarser.issues.size() == 1);
    CHECK(coarser.issues[0].severity == Severity::warning);
    CHECK(coarser.issues[0].place.feature == line.table().id(id));
    CHECK(coarser.issues[0].sentence ==
          "is not omitted at 1:25000: more than half of the building would go");
  }

  TEST_CASE("no sample loses more than a tenth of its volume at any scale") {
    for (const std::string& name : samples()) {
      const Line line = line_of_sample(name);
      for (const double scale : {5000., 10000., 25000., 50000.}) {
        CAPTURE(name);
        CAPTURE(scale);
        CHECK(volume_m3(generalised(line, scale).generalised.solid) > 0.9 * volume_m3(line.solid));
      }
    }
  }

  TEST_CASE("a sample without all its features is a convex body") {
    for (const std::string& name : samples()) {
      if (name == "hip") continue;  // see above
      CAPTURE(name);
      const Line line = line_of_sample(name);
      const Remainder rest = without_all(line);
      CHECK(rest.refused.empty());
      CHECK(is_closed(rest.solid));
      CHECK(rest.solid.facets.size() <= 7);
      CHECK(segment(line.building(), rest.solid).features.empty());
    }
  }

  TEST_CASE("steps of other operators are not omissions") {
    const Line line = line_of(block().remove({2, 0, 1}, {3, 0.2, 2}).build());
    const Remainder rest =
        omit(line.solid, line.segmentation, Plan{1, {{FeatureId{0}, "enlarge", ""}}, {}}, {});
    CHECK(rest.removed.empty());
    CHECK(rest.solid.facets.size() == line.solid.facets.size());
  }
}
