#include "interpret/relabelling/relabelling.h"

#include "interpret/params/find_fault.h"
#include "interpret/params/with_params.h"
#include "tests/interpret/random_scene.h"

#include <rapidcheck.h>

using namespace oriel;
using namespace oriel::test;

namespace {

/// A rule that asks for labels of others, one that asks twice, a relation and evidence that move
/// with params, and scores.
const std::string kMovingPack =
    "schema: oriel/1\n"
    "pack: {name: t, version: 1.0.0}\n"
    "params:\n"
    "  low: {value: 0.6 m, range: 0 m .. 4 m}\n"
    "  deep: {value: 0.4 m, range: 0 m .. 2 m}\n"
    "  near: {value: 1 m, range: 0.1 m .. 6 m}\n"
    "  steep: {value: 75 deg, range: 10 deg .. 85 deg}\n"
    "  least: {value: 0.3, range: 0 .. 1}\n"
    "  help: {value: 0.02, range: 0 .. 0.05}\n"
    "classes: {opening: {abstract: true}, window: {}, door: {}, block: {}}\n"
    "relations: {close: {within: same facade, where: abs(base_height - other.base_height) <= "
    "$near}}\n"
    "hosts: {wall: $steep .. 105 deg}\n"
    "rules:\n"
    "  - {id: opening.a, label: opening, require: sense = hole and depth <= $deep}\n"
    "  - {id: opening.b, label: opening, require: [exists(close where is opening), sense = "
    "imprint]}\n"
    "  - {id: door.a, label: door, require: [self is opening, base_height <= $low, host is wall]}\n"
    "  - id: window.a\n"
    "    label: window\n"
    "    require: [self is opening]\n"
    "    unless: [base_height <= $low and count(same_facade where is opening) < 3]\n"
    "    score: [{a: {rise: $deep .. $deep + 1 m, fall: 3 m .. 4 m}}, {count(close where is "
    "opening): {rise: 0 .. 3}}]\n"
    "  - {id: block.a, label: block, require: [sense = protrusion, none(close where depth > "
    "self.depth)]}\n"
    "decide: {min_score: $least, ambiguous_below: 0.1, evidence: $help, otherwise: unknown}\n";

}  // namespace

TEST_SUITE("interpret/relabelling") {
  TEST_CASE("labels with another value are those of a pack that states it") {
    const std::vector<RuleBase> packs{load(kMovingPack),
                                      load_pack_file("residential").value.value()};
    std::size_t others = 0;
    CHECK(rc::check("labels", [&] {
      const RuleBase& base = packs[*rc::gen::inRange<std::size_t>(0, packs.size())];
      const Scene scene = random_scene(*rc::gen::arbitrary<std::uint64_t>(), 24);
      const FeatureTable table = scene.table();
      const FeatureGraph graph = scene.graph();
      const Interpretation as_said = interpret(base, table, graph);
      const rules::Pack& pack = base.pack();
      const rules::RuleUses uses(pack);
      rules::Relabelling relabelling(pack, base.values(), uses, table, graph);
      for (int i = 0; i < 8; ++i) {
        const auto number = *rc::gen::inRange<std::size_t>(0, pack.params.size());
        const rules::Param& param = pack.params[number];
        const auto [low, high] = param.range.value_or(std::pair(param.value, param.value));
        const double value = low + (high - low) * *rc::gen::inRange(0, 41) / 40;
        const ParamValue assigned{param.name, value};
        const auto stated = with_params(base, {&assigned, 1}).value;
        rules::PackValues values = base.values();
        values.set(pack, number, value);
        RC_ASSERT(rules::find_fault(pack, values).has_value() != stated.has_value());
        if (!stated) continue;
        const auto& choices = relabelling.choices(pack, values, uses.affected_by({&number, 1}));
        const Interpretation said = interpret(*stated, table, graph);
        for (std::size_t row = 0; row < table.rows(); ++row) {
          const rules::Choice& choice = choices[row];
          const std::string rule =
              choice.rule < 0 ? "" : pack.rules[static_cast<std::size_t>(choice.rule)].id;
          RC_ASSERT(rule == said.verdicts[row].rule.text());
          RC_ASSERT(choice.score == said.verdicts[row].score);
          others += said.verdicts[row].label != as_said.verdicts[row].label ? 1 : 0;
        }
      }
    }));
    CHECK(others > 100);
  }
}
