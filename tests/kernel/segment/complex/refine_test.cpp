#include "kernel/segment/complex/refine.h"

#include "kernel/base/random.h"

#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

constexpr double kReach_m = 0.00025;
constexpr Vec3 kUp{0, 0, 1};

/// Corners nearer to each other than the reach, as planes at a small angle give them.
std::vector<Chord> crowded_chords(std::uint64_t seed, VertexPool& pool) {
  Random random(seed);
  const auto jitter = [&] { return random.between(-3, 3) * (random.chance(0.5) ? 1e-4 : 1e-7); };
  const int count = random.between(4, 24);
  for (int v = 0; v < count; ++v)
    pool.add({random.between(0, 2) + jitter(), random.between(0, 2) + jitter(), 0});
  std::vector<Chord> chords;
  for (int outline = random.between(1, 6); outline > 0; --outline) {
    const int first = random.below(count);
    int from = first;
    for (int more = random.between(2, 7); more > 0; --more) {
      const int to = more == 1 ? first : random.below(count);
      if (to != from) chords.push_back({from, to, outline, random.chance(0.5) ? 1 : -1});
      from = to;
    }
  }
  return chords;
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("chords that two vertices beside each other cut are cut to an end") {
    VertexPool pool({}, kReach_m);
    // The diagonal of a rectangle that is far thinner than the reach turns into the other one.
    const int a = pool.add({0, 0, 0}), b = pool.add({2.8e-7, 0, 0});
    const int c = pool.add({2.8e-7, 1, 0}), d = pool.add({0, 1, 0});
    Work work(10'000);
    const auto edges =
        refine({{a, c, 0, 1}, {c, d, 0, 1}, {b, a, 0, 1}}, PlaneAxes(kUp), pool, work);
    CHECK_FALSE(work.is_used_up());
    CHECK_FALSE(edges.empty());
  }

  TEST_CASE("however near to each other corners are the cutting of chords ends") {
    int cut = 0;
    for (std::uint64_t seed = 0; seed < 400; ++seed) {
      CAPTURE(seed);
      VertexPool pool({}, kReach_m);
      const std::vector<Chord> chords = crowded_chords(seed, pool);
      Work work(200'000);
      const auto edges = refine(chords, PlaneAxes(kUp), pool, work);
      CHECK_FALSE(work.is_used_up());
      cut += edges.size() > chords.size() ? 1 : 0;
    }
    CHECK(cut > 50);
  }

  TEST_CASE("no edge comes of chords once the work is used up") {
    VertexPool pool({}, kReach_m);
    Work work(10);
    CHECK(refine(crowded_chords(1, pool), PlaneAxes(kUp), pool, work).empty());
    CHECK(work.is_used_up());
  }
}

}  // namespace
}  // namespace oriel
