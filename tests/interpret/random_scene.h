#pragma once

#include "interpret/params/with_params.h"
#include "interpret/relabelling/variant.h"
#include "tests/interpret/support.h"

#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

namespace oriel::test {

/// Small numbers that depend on nothing but the seed.
class Draws {
 public:
  explicit Draws(std::uint64_t seed) : state_(seed * 2862933555777941757ULL + 3037000493ULL) {}

  /// 0 … count - 1.
  int below(int count) {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<int>((state_ >> 33U) % static_cast<std::uint64_t>(count));
  }
  /// One of the steps from low to high, so that ties and values on a bound occur.
  double between(double low, double high, int steps) {
    return low + (high - low) * below(steps + 1) / steps;
  }

 private:
  std::uint64_t state_;
};

/// Features such as the kernel finds them, at random: openings and blocks on walls and roofs, some
/// of them in others, some values missing.
inline Scene random_scene(std::uint64_t seed, int features) {
  Draws draws(seed);
  Scene scene;
  std::vector<int> facade, storey, host;
  for (int i = 0; i < features; ++i) {
    const double width = draws.between(0.1, 6, 59), height = draws.between(0.1, 4, 39);
    const double base = draws.between(0, 9, 45), depth = draws.between(0.02, 2, 33);
    const bool is_on_wall = draws.below(4) > 0;
    const char* senses[] = {"hole", "imprint", "protrusion", "protrusion"};
    Values values{{"sense", senses[draws.below(4)]},
                  {"width", width},
                  {"height", height},
                  {"depth", depth},
                  {"a", std::max(width, height)},
                  {"b", std::min(width, height)},
                  {"c", std::min(depth, 0.5)},
                  {"base_height", base},
                  {"top", base + height},
                  {"volume", width * height * depth},
                  {"along", draws.between(0, 12, 24)},
                  {"inclination", 90.0},
                  {"recess", draws.below(2) == 0 ? 0.0 : depth},
                  {"lod", 3.0},
                  {"host_inclination", is_on_wall ? draws.between(70, 108, 19) : 40.0},
                  {"split_order", static_cast<double>(draws.below(3))}};
    if (draws.below(9) == 0) values.erase(draws.below(2) == 0 ? "depth" : "base_height");
    scene.add(values);
    facade.push_back(draws.below(3));
    storey.push_back(draws.below(3));
    host.push_back(i > 0 && draws.below(3) == 0 ? draws.below(i) : -1);
  }
  for (int i = 0; i < features; ++i) {
    if (host[static_cast<std::size_t>(i)] >= 0)
      scene.put_on(FeatureId{host[static_cast<std::size_t>(i)]}, FeatureId{i});
    for (int j = 0; j < i; ++j) {
      const auto p = static_cast<std::size_t>(i), q = static_cast<std::size_t>(j);
      if (facade[p] == facade[q]) scene.relate_both("same_facade", FeatureId{i}, FeatureId{j});
      if (storey[p] == storey[q]) scene.relate_both("same_storey", FeatureId{i}, FeatureId{j});
      if (facade[p] != facade[q]) continue;
      if (draws.below(3) == 0) scene.relate_both("beside", FeatureId{i}, FeatureId{j});
      if (draws.below(3) == 0) scene.relate_both("alike", FeatureId{i}, FeatureId{j});
    }
  }
  return scene;
}

/// The variant as a pack of its own, or what with_params() refuses of it.
inline Checked<RuleBase> with_variant(const RuleBase& base, const Variant& variant) {
  Checked<RuleBase> set = with_params(base, std::span(variant.params));
  if (!set.value || variant.without.empty()) return set;
  rules::Ablation ablation(base.pack());
  set.value = RuleBase(std::make_shared<rules::Pack>(ablation.without(variant.without)),
                       set.value->values(), set.value->sha256());
  return set;
}

}  // namespace oriel::test
