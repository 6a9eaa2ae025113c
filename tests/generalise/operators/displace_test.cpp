#include "generalise/generalise.h"
#include "generalise/operators/operators.h"
#include "generalise/operators/separate.h"
#include "kernel/base/index.h"
#include "tests/generalise/line.h"
#include "tests/generalise/operators/drawn_wall.h"
#include "tests/support/flush.h"
#include "tests/support/shapes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <rapidcheck.h>

using namespace oriel;
using namespace oriel::test;

namespace {

/// What separate() is asked for; multiples of a quarter, so that sums are exact.
struct Asked {
  std::vector<double> wished, weights;
  std::vector<Separation> separations;
};

Asked any_asked() {
  Asked asked;
  const int places = *rc::gen::inRange(1, 6);
  for (int i = 0; i < places; ++i) {
    asked.wished.push_back(*rc::gen::inRange(-12, 13) * 0.25);
    asked.weights.push_back(*rc::gen::inRange(1, 4));
  }
  const int separations = *rc::gen::inRange(0, 9);
  for (int s = 0; s < separations; ++s) {
    const int before = *rc::gen::inRange(-1, places), after = *rc::gen::inRange(-1, places);
    if (before != after)
      asked.separations.push_back({before, after, *rc::gen::inRange(-8, 9) * 0.25});
  }
  return asked;
}

double place_in(const std::vector<double>& places, int i) {
  return i == Separation::kFixed ? 0 : places[at(i)];
}

bool holds(const Separation& one, const std::vector<double>& places) {
  return place_in(places, one.after) - place_in(places, one.before) >= one.least - 2e-6;
}

double cost_of(const Asked& asked, const std::vector<double>& places) {
  double cost = 0;
  for (std::size_t i = 0; i < places.size(); ++i)
    cost += asked.weights[i] * (places[i] - asked.wished[i]) * (places[i] - asked.wished[i]);
  return cost;
}

/// By longest paths (Bellman and Ford): the separations contradict each other if there is a cycle
/// of positive length.
bool can_hold(const std::vector<Separation>& separations, std::size_t places) {
  std::vector<double> longest(places + 1, 0);  // the fixed place last
  const auto node = [&](int i) { return i == Separation::kFixed ? places : at(i); };
  for (std::size_t round = 0; round <= places + 1; ++round) {
    bool is_changed = false;
    for (const auto& [before, after, least] : separations)
      if (longest[node(before)] + least > longest[node(after)] + 1e-9) {
        longest[node(after)] = longest[node(before)] + least;
        is_changed = true;
      }
    if (!is_changed) return true;
  }
  return false;
}

/// Those of `chosen` separations as equalities, all others left out: the least cost there is for
/// them; nothing if they contradict each other.
std::optional<std::vector<double>> tight(const Asked& asked, unsigned chosen) {
  const std::size_t count = asked.wished.size();
  std::vector<std::optional<double>> offset(count + 1);  // within a part; the fixed place last
  std::vector<double> places(count, 0);
  const auto node = [&](int i) { return i == Separation::kFixed ? count : at(i); };
  for (std::size_t first = count + 1; first-- > 0;) {
    if (offset[first]) continue;
    std::vector<std::size_t> part{first};
    offset[first] = 0;
    for (std::size_t next = 0; next < part.size(); ++next)
      for (std::size_t s = 0; s < asked.separations.size(); ++s) {
        if ((chosen >> s & 1U) == 0) continue;
        const auto [before, after, least] = asked.separations[s];
        for (const auto& [from, to, by] : {std::tuple(node(before), node(after), least),
                                           std::tuple(node(after), node(before), -least)}) {
          if (from != part[next]) continue;
          const double there = *offset[from] + by;
          if (offset[to] && std::abs(*offset[to] - there) > 1e-9) return std::nullopt;
          if (offset[to]) continue;
          offset[to] = there;
          part.push_back(to);
        }
      }
    double sum = 0, weight = 0;
    for (const std::size_t i : part)
      if (i < count) {
        sum += asked.weights[i] * (asked.wished[i] - *offset[i]);
        weight += asked.weights[i];
      }
    const double origin = first == count || weight == 0 ? 0 : sum / weight;
    for (const std::size_t i : part)
      if (i < count) places[i] = origin + *offset[i];
  }
  return places;
}

/// The least cost over all sets of separations that may be tight.
double least_cost(const Asked& asked) {
  double least = std::numeric_limits<double>::infinity();
  for (unsigned chosen = 0; chosen < 1U << asked.separations.size(); ++chosen)
    if (const auto places = tight(asked, chosen);
        places && std::ranges::all_of(asked.separations,
                                      [&](const Separation& one) { return holds(one, *places); }))
      least = std::min(least, cost_of(asked, *places));
  return least;
}

/// One step for each hole and imprint.
Plan displacing(const Line& line, std::map<std::string, double> numbers) {
  Plan plan{1000, {}, {}};
  for (int i = 0; i < std::ssize(line.segmentation.features); ++i)
    if (line.segmentation.features[at(i)].sense != Sense::protrusion)
      plan.steps.push_back({{i}, "displace", "test", numbers, {}});
  return plan;
}

double apart_m(const Box& a, const Box& b) {
  const double x = std::max({0.0, a.min.x - b.max.x, b.min.x - a.max.x});
  const double z = std::max({0.0, a.min.z - b.max.z, b.min.z - a.max.z});
  return std::hypot(x, z);
}

double nearest_m(const std::vector<Box>& boxes) {
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < boxes.size(); ++i)
    for (std::size_t j = i + 1; j < boxes.size(); ++j)
      least = std::min(least, apart_m(boxes[i], boxes[j]));
  return least;
}

}  // namespace

TEST_SUITE("generalise") {
  TEST_CASE("places are separated by the least squares that any set of tight separations gives") {
    CHECK(rc::check([] {
      const Asked asked = any_asked();
      const Separated found = separate(asked.wished, asked.separations, asked.weights);
      RC_ASSERT(found.places.has_value() == can_hold(asked.separations, asked.wished.size()));
      if (!found.places) return;
      for (const Separation& one : asked.separations) RC_ASSERT(holds(one, *found.places));
      RC_ASSERT(std::abs(cost_of(asked, *found.places) - least_cost(asked)) < 1e-4);
    }));
  }

  TEST_CASE("separations that find no room are too long by what is lacking and only together") {
    CHECK(rc::check([] {
      Asked asked = any_asked();
      asked.separations.push_back({0, Separation::kFixed, 3});
      asked.separations.push_back({Separation::kFixed, 0, *rc::gen::inRange(-8, 9) * 0.25});
      const Separated found = separate(asked.wished, asked.separations, asked.weights);
      if (found.places) return;
      std::vector<Separation> crowded;
      for (const std::size_t s : found.crowded) crowded.push_back(asked.separations[s]);
      RC_ASSERT(!can_hold(crowded, asked.wished.size()));
      crowded.front().least -= found.lacking;
      RC_ASSERT(can_hold(crowded, asked.wished.size()));
      for (std::size_t s = 0; s < crowded.size(); ++s) {
        std::vector<Separation> fewer = crowded;
        fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(s));
        RC_ASSERT(can_hold(fewer, asked.wished.size()));
      }
    }));
  }

  TEST_CASE("what has room stays where it is to the last bit") {
    const std::vector<double> wished{0.1, 1.7, 3.3};
    const auto found = separate(wished, {{0, 1, 1}, {1, 2, 1}, {Separation::kFixed, 0, 0}});
    REQUIRE(found.places);
    CHECK(*found.places == wished);
  }

  TEST_CASE("windows too near to each other move apart in their order by the least shifts") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6});
    for (const double x : {1.0, 2.1, 3.2, 7.0}) body.remove({x, 0, 3}, {x + 1, 0.2, 4});
    const Line line = line_of(body.build());
    const auto out = carried(line, displacing(line, {{"gap", 0.5}}));
    CHECK(volume_m3(out.solid) == doctest::Approx(volume_m3(line.solid)).epsilon(1e-6));
    const auto boxes = openings_in_front(out.solid);
    REQUIRE(boxes.size() == 4);
    CHECK(nearest_m(boxes) >= 0.5);
    CHECK(boxes[1].min.x == doctest::Approx(2.1).epsilon(0.01));
    // The last has room enough: it stays as it was.
    CHECK(boxes[3].min.x == 7);
    CHECK(out.changed.size() == 2);
    for (const auto& refused : out.refused) CHECK(refused.code == Code::none);
    for (const Box& box : boxes) CHECK(box.min.z == 3);
  }

  TEST_CASE("two rows too near to each other go up and down as rows and keep their columns") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6});
    for (const double x : {1.0, 4.0, 7.0}) {
      body.remove({x, 0, 1.5}, {x + 1, 0.2, 2.7});
      body.remove({x, 0, 2.9}, {x + 1, 0.2, 4.1});
    }
    const Line line = line_of(body.build());
    const auto out = carried(line, displacing(line, {{"gap", 0.5}}));
    CHECK(out.refused.empty());
    CHECK(out.changed.size() == 6);
    const auto boxes = openings_in_front(out.solid);
    REQUIRE(boxes.size() == 6);
    CHECK(nearest_m(boxes) >= 0.5);
    for (std::size_t i = 0; i < 6; i += 2) {
      CHECK(boxes[i].min.z == boxes[0].min.z);
      CHECK(boxes[i + 1].min.z == boxes[1].min.z);
      CHECK(boxes[i].min.x == boxes[i + 1].min.x);
    }
    CHECK(2.7 - boxes[0].max.z == doctest::Approx(boxes[1].min.z - 2.9).epsilon(1e-3));
  }

  TEST_CASE("windows move off a door that stays on the ground") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6}).remove({4, 0, 0}, {5, 0.2, 2.2});
    for (const double x : {3.0, 5.1}) body.remove({x, 0, 1}, {x + 0.9, 0.2, 2});
    const Line line = line_of(body.build());
    Plan plan = displacing(line, {{"gap", 0.4}});
    std::erase_if(plan.steps, [&](const Step& step) {
      return line.segmentation.features[step.feature.index()].box.min.z < 0.1;
    });
    const auto out = carried(line, plan);
    CHECK(out.refused.empty());
    CHECK(out.changed.size() == 2);
    const auto boxes = openings_in_front(out.solid);
    REQUIRE(boxes.size() == 2);
    CHECK(boxes[0].max.x == doctest::Approx(3.6).epsilon(1e-3));
    CHECK(boxes[1].min.x == doctest::Approx(5.4).epsilon(1e-3));
    for (const Box& box : boxes) CHECK(box.min.z == 1);
  }

  TEST_CASE("flush windows move apart as outlines") {
    Building building = plain_block();
    for (const double x : {1.0, 2.1, 7.0}) add_pane(building, x, 3.5, x + 1, 4.5);
    const Line line = line_of(building);
    const auto out = carried(line, displacing(line, {{"gap", 0.5}}));
    CHECK(out.changed.size() == 2);
    CHECK(volume_m3(out.solid) == volume_m3(line.solid));
    for (const auto& refused : out.refused) CHECK(refused.code == Code::none);
  }

  TEST_CASE("a row that its wall has no room for stays and others on the wall move") {
    BoxBody body;
    body.add({0, 0, 0}, {10, 8, 6});
    for (int i = 0; i < 6; ++i) body.remove({0.3 + 1.6 * i, 0, 3.5}, {1.7 + 1.6 * i, 0.2, 4.5});
    for (const double x : {1.0, 2.1}) body.remove({x, 0, 1}, {x + 1, 0.2, 2});
    const Line line = line_of(body.build());
    const auto out = carried(line, displacing(line, {{"gap", 0.3}}));
    CHECK(out.changed.size() == 2);
    REQUIRE(out.refused.size() == 6);
    for (const auto& refused : out.refused) {
      CHECK(refused.code == Code::G403);
      CHECK(refused.reason.starts_with("its wall has no room for the row: "));
    }
  }
}
