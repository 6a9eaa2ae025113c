#include "interpret/learn/count_variants.h"

#include "tests/interpret/learn/random_samples.h"

#include <algorithm>
#include <thread>

#include <rapidcheck.h>

using namespace oriel;
using namespace oriel::test;

namespace {

const std::string kSmallPack =
    "schema: oriel/1\n"
    "pack: {name: t, version: 1.0.0}\n"
    "hosts: {roof: 0 deg .. $steep, wall: $steep .. 105 deg}\n"
    "params:\n"
    "  steep: {value: 75 deg, range: 60 deg .. 100 deg}\n"
    "  sill: {value: 0.8 m, range: 0.2 m .. 2 m}\n"
    "  same: {value: 20 %, range: 1 % .. 80 %}\n"
    "  enough: {value: 0.3, range: 0 .. 0.9}\n"
    "  company: {value: 0.1, range: 0 .. 0.2}\n"
    "  many: {value: 3, range: 1 .. 6}\n"
    "classes:\n"
    "  opening: {abstract: true}\n"
    "  low: {abstract: true}\n"
    "  window: {is: opening, typical: {per facade: 1 .. $many}}\n"
    "  wide: {is: window}\n"
    "  door: {is: opening, typical: {per building: 1 ..}}\n"
    "relations: {like: {within: same facade, where: width ~ other.width by $same}}\n"
    "rules:\n"
    "  - {id: opening.any, label: opening, require: 'sense in [hole, imprint] and width >= 0.4 "
    "m'}\n"
    "  - {id: low.foot, label: low, require: 'base_height <= $sill'}\n"
    "  - {id: low.on, label: low, require: 'host is low'}\n"
    "  - id: window.w\n"
    "    label: window\n"
    "    require: [self is opening and host is wall]\n"
    "    unless: [exists(inside where is opening)]\n"
    "    score:\n"
    "      - base_height: {rise: 0.1 m .. $sill + 0.2 m, fall: 3 m .. 9 m}\n"
    "      - count(like where is opening): {rise: 0 .. 3}\n"
    "  - id: door.d\n"
    "    label: door\n"
    "    require: [self is opening, self is low]\n"
    "    score: [height: {rise: 1 m .. 2 m, fall: 2 m .. 4 m}]\n"
    "  - id: wide.w\n"
    "    label: wide\n"
    "    require: [self is opening and self is window and width >= 2 m, not exists(beside where is "
    "door)]\n"
    "decide: {min_score: $enough, ambiguous_below: 0.4, evidence: $company, company: [alike, "
    "like]}\n";

/// A param in two rules of which one asks for the class of the other, and one in a rule that asks
/// for its own class.
const std::string kChainedPack =
    "schema: oriel/1\n"
    "pack: {name: t, version: 1.0.0}\n"
    "params:\n"
    "  w: {value: 1 m, range: 0.1 m .. 5 m}\n"
    "  low: {value: 3 m, range: 0.1 m .. 9 m}\n"
    "classes: {opening: {abstract: true}, low: {abstract: true}, window: {}, door: {}}\n"
    "rules:\n"
    "  - {id: opening.any, label: opening, require: 'width >= $w'}\n"
    "  - {id: low.any, label: low, require: 'base_height <= $low or exists(beside where is low)'}\n"
    "  - {id: window.w, label: window, require: 'self is opening and height >= $w - 1 m'}\n"
    "  - {id: door.d, label: door, require: 'self is low', priority: 1}\n";

/// Every param at some values, everything that can be left out, and some of both.
std::vector<Variant> variants_of(const RuleBase& rules, std::uint64_t seed) {
  Draws draws(seed);
  std::vector<Variant> variants{Variant{"as it is", {}, {}, {}}};
  for (const PackParam& param : params_of(rules))
    for (int i = 0; i < 2; ++i)
      variants.push_back(variant_with(
          rules, {{param.name, draws.between(param.range->first, param.range->second, 5)}}));
  const auto ablated = ablations(rules);
  for (std::size_t i = 0; i < ablated.size(); ++i) {
    variants.push_back(ablated[i]);
    if (i % 5 != 0) continue;
    Variant both = variants[1 + i % (variants.size() - 1)];
    both.name = "both " + ablated[i].name;
    if (both.without.empty()) both.without = ablated[i].without;
    variants.push_back(std::move(both));
  }
  std::erase_if(variants,
                [&](const Variant& variant) { return !with_variant(rules, variant).value; });
  return variants;
}

/// True if counts and labels are those of interpret() and score() with each variant by itself.
bool is_as_by_itself(const RuleBase& rules, const std::vector<Variant>& variants,
                     const std::vector<Sample>& samples) {
  const auto counted = count_variants(rules, variants, samples, {}, for_each_in_turn, true);
  REQUIRE(counted.value);
  const VariantCounts& counts = *counted.value;
  for (std::size_t v = 0; v < variants.size(); ++v) {
    const RuleBase alone = with_variant(rules, variants[v]).value.value();
    for (std::size_t s = 0; s < samples.size(); ++s) {
      const auto labels = labels_of(alone, samples[s]);
      for (std::size_t row = 0; row < labels.size(); ++row)
        if (counts.label(v, s, row) != counts.labels().find(labels[row])) return false;
      const Score expected = score(predictions_of(samples[s], labels), samples[s].truth);
      const std::size_t only[] = {s};
      if (!is_same(counts.total(v, only), expected.classes)) return false;
      std::size_t missed = 0;
      for (std::size_t object = 0; object < samples[s].truth.size(); ++object)
        missed += counts.is_found(v, s, object) ? 0 : 1;
      std::size_t found = 0;
      for (const auto& [label, count] : expected.classes) found += count.true_positives;
      if (missed + found != samples[s].truth.size()) return false;
    }
  }
  return true;
}

}  // namespace

TEST_SUITE("experiments") {
  TEST_CASE("variants of a small pack are counted as if each were run by itself") {
    const RuleBase rules = load(kSmallPack);
    CHECK(rc::check([&] {
      const auto seed = *rc::gen::inRange<std::uint64_t>(0, 1'000'000);
      const std::vector<Sample> samples{random_sample(seed, 12), random_sample(seed + 1, 9)};
      RC_ASSERT(is_as_by_itself(rules, variants_of(rules, seed), samples));
    }));
  }

  TEST_CASE("variants that change rules which ask for each other are counted as by themselves") {
    const RuleBase rules = load(kChainedPack);
    std::vector<Variant> variants;
    for (const PackParam& param : params_of(rules))
      for (int i = 1; i < 40; ++i)
        variants.push_back(variant_with(
            rules, {{param.name,
                     param.range->first + (param.range->second - param.range->first) * i / 40}}));
    for (std::uint64_t seed = 0; seed < 20; ++seed) {
      CAPTURE(seed);
      CHECK(is_as_by_itself(rules, variants, {random_sample(seed, 15)}));
    }
  }

  TEST_CASE("variants of a pack with rounds are counted as if each were run by itself") {
    const RuleBase rules = load(kSmallPack + "iterate: {rounds: 3}\n");
    for (std::uint64_t seed = 0; seed < 5; ++seed)
      CHECK(is_as_by_itself(rules, variants_of(rules, seed), {random_sample(seed, 12)}));
  }

  TEST_CASE("variants of the residential pack are counted as if each were run by itself") {
    const RuleBase rules = load_pack_file("residential").value.value();
    const auto all = variants_of(rules, 3);
    CHECK(all.size() > 250);
    std::vector<Variant> some;
    for (std::size_t i = 0; i < all.size(); i += 3) some.push_back(all[i]);
    CHECK(is_as_by_itself(rules, some, {random_sample(1, 40), random_sample(2, 20)}));
  }

  TEST_CASE("threads change nothing") {
    const RuleBase rules = load(kSmallPack);
    const auto variants = variants_of(rules, 1);
    std::vector<Sample> samples;
    for (std::uint64_t seed = 0; seed < 40; ++seed) samples.push_back(random_sample(seed, 6));
    const ForEachShare by_two = [](std::size_t count, const auto& work) {
      const auto half = [&](std::size_t first) {
        for (std::size_t i = first; i < count; i += 2) work(i);
      };
      std::jthread other(half, 1);
      half(0);
    };
    const auto one = count_variants(rules, variants, samples).value.value();
    const auto two = count_variants(rules, variants, samples, {}, by_two).value.value();
    for (std::size_t v = 0; v < variants.size(); ++v)
      for (std::size_t s = 0; s < samples.size(); ++s)
        CHECK(std::ranges::equal(one.counts(v, s), two.counts(v, s)));
  }

  TEST_CASE("a variant that cannot be is refused by its name") {
    const RuleBase rules = load(kSmallPack);
    const std::vector<Variant> variants{variant_with(rules, {{"sill", 1.0}}),
                                        variant_with(rules, {{"sill", 3.0}})};
    const auto counted = count_variants(rules, variants, {});
    CHECK(!counted.value);
    REQUIRE(counted.issues.size() == 1);
    CHECK(to_string(counted.issues[0]) ==
          "sill = 3 m: R212 3 m is outside the range of 'sill', 0.2 m .. 2 m");
  }
}
