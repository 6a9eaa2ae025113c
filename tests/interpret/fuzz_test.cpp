#include "tests/interpret/support.h"

#include <random>
#include <string_view>

using namespace oriel;
using namespace oriel::test;

namespace {

/// Changes a text in one of the ways that people and cats on keyboards do.
class Mutator {
 public:
  explicit Mutator(unsigned seed) : random_(seed) {}

  std::string mutated(std::string text) {
    const std::size_t changes = 1 + below(4);
    for (std::size_t i = 0; i < changes && !text.empty(); ++i) change(text);
    return text;
  }

 private:
  std::size_t below(std::size_t bound) { return random_() % bound; }

  void change(std::string& text) {
    static constexpr std::string_view kBytes = "[]{}:,#&*!|>'\"%@`$()~=<>.- \n\tayn019\x7f\xc3\xff";
    static constexpr std::string_view kWords[] = {" not ",  " exists(host where ",
                                                  "(",      " in [",
                                                  "1e9 m",  "mm@map",
                                                  " self.", " is ",
                                                  "1:50",   "\n  - ",
                                                  ": ",     "&a ",
                                                  "*a",     "!!str ",
                                                  "...",    "---\n",
                                                  "? ",     "$",
                                                  "count(", " .. "};
    const std::size_t at = below(text.size());
    switch (below(6)) {
      case 0:
        text[at] = kBytes[below(kBytes.size())];
        break;
      case 1:
        text.erase(at, 1 + below(12));
        break;
      case 2:
        text.insert(at, kWords[below(std::size(kWords))]);
        break;
      case 3:
        text.insert(below(text.size()), text.substr(at, below(200)));
        break;
      case 4:
        text.resize(at);
        break;
      default:
        text.insert(at, std::string(1 + below(80), kBytes[below(kBytes.size())]));
    }
  }

  std::mt19937 random_;
};

Scene small_scene() {
  Scene scene;
  const FeatureId wall = scene.add({{"sense", "protrusion"}, {"a", 4.0}, {"height", 2.0}});
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
        CHECK_FALSE(issue.code.empty());
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
