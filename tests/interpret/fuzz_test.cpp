#include "tests/interpret/mutator.h"
#include "tests/interpret/support.h"

using namespace oriel;
using namespace oriel::test;

namespace {

Scene small_scene() {
  Scene scene;
  const FeatureId wall = scene.add({{"sense", "protrusion"}, {"a", 4.0}, {"base_height", 2.0}});
  scene.put_on(wall, scene.add({{"sense", "hole"}, {"width", 1.0}, {"host_inclination", 90.0}}));
  scene.relate_both("same_facade", FeatureId{0}, FeatureId{1});
  return scene;
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("mutated packs are loaded or refused and never crash") {
    const std::string pack(*embedded_pack("residential"));
    const Scene scene = small_scene();
    std::size_t loaded = 0, refused = 0;
    for (unsigned seed = 0; seed < 1500; ++seed) {
      const std::string text = Mutator(seed).mutated(pack);
      const auto checked = load_pack(text, "mutated.yaml");
      CHECK(checked.value.has_value() != has_errors(checked.issues));
      for (const Issue& issue : checked.issues) {
        CHECK(issue.place.line >= 1);
        CHECK(issue.place.column >= 1);
        CHECK(issue.code != Code::none);
      }
      if (checked.value) labels(*checked.value, scene);
      ++(checked.value ? loaded : refused);
    }
    // Both kinds must come, else nothing was tested.
    CHECK(loaded > 50);
    CHECK(refused > 500);
  }

  TEST_CASE("mutated conditions are loaded or refused and never crash") {
    const std::string condition =
        "(a > 1 m or not b in 0.3 m .. max(c, 2 m)) and exists(contains where self.a ~ other.a by "
        "10 "
        "% and none(host where is door)) and sense in [hole, imprint] and host is wall";
    const Scene scene = small_scene();
    std::size_t loaded = 0;
    for (unsigned seed = 0; seed < 4000; ++seed) {
      const auto checked =
          load_pack(pack_requiring({Mutator(seed).mutated(condition)}), "mutated.yaml");
      CHECK(checked.value.has_value() != has_errors(checked.issues));
      if (!checked.value) continue;
      ++loaded;
      labels(*checked.value, scene);
    }
    CHECK(loaded > 20);
  }
}
