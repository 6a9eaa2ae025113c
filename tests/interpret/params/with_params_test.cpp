#include "interpret/params/with_params.h"

#include "interpret/evaluate/pack_values.h"
#include "tests/interpret/random_scene.h"

#include <array>

#include <rapidcheck.h>

using namespace oriel;
using namespace oriel::test;

namespace {

/// A pack in which params stand everywhere where they can.
const std::string kParamsEverywhere =
    "schema: oriel/1\n"
    "pack: {name: t, version: 1.0.0}\n"
    "hosts:\n"
    "  roof: 0 deg .. $steep\n"
    "  wall: $steep .. $lean\n"
    "  ground: 105 deg .. 180 deg\n"
    "  ground_reach: $reach\n"
    "params:\n"
    "  steep: {value: 75 deg, range: 60 deg .. 110 deg}\n"
    "  lean: {value: 100 deg, range: 70 deg .. 110 deg}\n"
    "  reach: {value: 0.5 m, range: 0.1 m .. 2 m}\n"
    "  sill: {value: 0.8 m, range: 0.2 m .. 3 m}\n"
    "  widest: {value: 3 m, range: 0.5 m .. 6 m}\n"
    "  same: {value: 10 %, range: 1 % .. 80 %}\n"
    "  enough: {value: 0.3, range: -0.2 .. 0.9}\n"
    "  close: {value: 0.4, range: 0.1 .. 1}\n"
    "  company: {value: 0.1, range: 0 .. 0.4}\n"
    "  few: {value: 1, range: 0 .. 4}\n"
    "  many: {value: 3, range: 0.5 .. 6}\n"
    "classes:\n"
    "  opening: {abstract: true, typical: {per building: 1 .. 5}}\n"
    "  window: {is: opening, typical: {per facade: $few .. $many}}\n"
    "  door: {is: opening, typical: {per building: $few ..}}\n"
    "relations: {like: {within: same facade, where: a ~ other.a by $same}}\n"
    "rules:\n"
    "  - {id: opening.any, label: opening, require: 'width in 0.2 m .. $widest'}\n"
    "  - id: window.w\n"
    "    label: window\n"
    "    require: [self is opening, host is wall, count(like where is opening) >= 1]\n"
    "    score:\n"
    "      - base_height: {rise: 0.1 m .. $sill, fall: 2 m .. 9 m}\n"
    "      - width: {fall: 0.5 m .. $widest}\n"
    "  - id: door.d\n"
    "    label: door\n"
    "    require: [self is opening]\n"
    "    unless: [base_height > $sill]\n"
    "    score: [height: {rise: 1 m .. 2 m, fall: 2 m .. 2 m + $widest}]\n"
    "decide: {min_score: $enough, ambiguous_below: $close, evidence: $company}\n"
    "surfaces: [{id: g, type: GroundSurface, when: 'inclination in $lean .. 180 deg'}]\n"
    "generalise: [{id: o, scale: '1:500 ..', for: window, when: 'a < $sill', do: omit}]\n";

RuleBase everywhere() {
  auto checked = load_pack(kParamsEverywhere, "everywhere.yaml");
  for (const Issue& issue : checked.issues) CHECK(issue.severity != Severity::error);
  REQUIRE(checked.value);
  return *checked.value;
}

/// The same pack with other values in its text.
std::string text_with(const std::vector<ParamValue>& values, const RuleBase& base) {
  std::string text = kParamsEverywhere;
  for (const ParamValue& value : values) {
    const std::string start = "  " + value.name + ": {value: ";
    const std::size_t begin = text.find(start) + start.size();
    const std::string assigned = to_string(value, base);
    text.replace(begin, text.find(',', begin) - begin, assigned.substr(assigned.find('=') + 2));
  }
  return text;
}

/// "CODE place sentence" of each.
std::string refusals(const Checked<RuleBase>& checked) {
  std::string text;
  for (const Issue& issue : checked.issues) text += to_string(issue) + "\n";
  return text;
}

std::string refusals(const std::vector<std::string>& assignments) {
  return refusals(with_params(everywhere(), assignments));
}

}  // namespace

TEST_SUITE("interpret/params") {
  TEST_CASE("a pack with params set says what a text with these values says") {
    const RuleBase base = everywhere();
    int accepted = 0;
    CHECK(rc::check([&] {
      const auto seed = *rc::gen::inRange<std::uint64_t>(0, 1'000'000);
      Draws draws(seed);
      std::vector<ParamValue> values;
      for (const PackParam& param : params_of(base)) {
        if (draws.below(3) > 0) continue;
        const int steps = param.name == "few" ? 4 : 10;
        values.push_back(
            {param.name, draws.between(param.range->first, param.range->second, steps)});
      }
      const auto set = with_params(base, values);
      const auto text = load_pack(text_with(values, base), "everywhere.yaml");
      RC_ASSERT(set.value.has_value() == text.value.has_value());
      if (!set.value) return;
      ++accepted;
      const Scene scene = random_scene(seed, 12);
      RC_ASSERT(labels(*set.value, scene) == labels(*text.value, scene));
      const rules::PackValues& p = set.value->values();
      const rules::PackValues& q = text.value->values();
      RC_ASSERT(static_cast<const rules::PackSettings&>(p) == q);
      RC_ASSERT(p.params == q.params);
      const rules::Pack& pack = base.pack();
      for (std::size_t c = 0; c < pack.classes.size(); ++c)
        for (std::size_t i = 0; i < pack.classes[c].typical.size(); ++i)
          RC_ASSERT(p.count_of(pack, pack.classes[c].typical[i]) ==
                    q.count_of(text.value->pack(), text.value->pack().classes[c].typical[i]));
    }));
    CHECK(accepted > 10);
  }

  TEST_CASE("the digest says which values were set and nothing else changes") {
    const RuleBase base = everywhere();
    const std::array<std::string, 2> one{"sill=1.2 m", "widest = 250 cm"};
    const std::array<std::string, 2> other{"widest=2.5m", "sill=120 cm"};
    const RuleBase set = with_params(base, one).value.value();
    CHECK(set.sha256() != base.sha256());
    CHECK(set.sha256() == with_params(base, other).value.value().sha256());
    CHECK(set.files() == base.files());
    CHECK(params_of(set)[3].value == 1.2);
    CHECK(params_of(set)[4].value == 2.5);
    CHECK(params_of(base)[3].value == 0.8);
    const std::array<std::string, 1> same{"sill=0.8 m"};
    CHECK(with_params(base, same).value.value().sha256() == base.sha256());
  }

  TEST_CASE("an assignment that cannot be made is refused at its place") {
    CHECK(refusals({"sil=1 m"}) == "sil=1 m: R206 unknown param 'sil'; did you mean 'sill'?\n");
    CHECK(refusals({"sill"}) ==
          "sill: R211 this sets no param; expected its name, '=' and a value, such as 'steep=75 "
          "deg'\n");
    CHECK(refusals({"sill="}) == "sill=: R211 'sill' needs a value, such as 0.8 m\n");
    CHECK(refusals({"sill=1"}) == "sill=1: R231 a length is needed here: write 1 m\n");
    CHECK(refusals({"sill=20 deg"}) ==
          "sill=20 deg: R230 '20 deg' is an angle; a length is needed here\n");
    CHECK(refusals({"sill=4 m"}) ==
          "sill=4 m: R212 4 m is outside the range of 'sill', 0.2 m .. 3 m\n");
    CHECK(refusals({"sill=1 m", "same=5 %", "sill=2 m"}) ==
          "sill=2 m: R202 the param 'sill' is set twice\n");
    CHECK(refusals({"few=1.5"}) ==
          "few=1.5: R212 with this value the pack would be refused at everywhere.yaml:22:47: "
          "'$few' is a count: a whole number, 0 or more, at most 1000000\n");
  }

  TEST_CASE("every wrong assignment is reported at once") {
    CHECK(refusals({"sil=1 m", "close=2", "widest=1"}) ==
          "sil=1 m: R206 unknown param 'sil'; did you mean 'sill'?\n"
          "widest=1: R231 a length is needed here: write 1 m\n");
  }

  TEST_CASE("a value with which the pack could not be loaded is refused") {
    CHECK(refusals({"lean=110 deg"}) ==
          "lean=110 deg: R212 with this value the pack would be refused at everywhere.yaml:5:9: "
          "wall, roof and ground overlap\n");
    CHECK(refusals({"sill=1 m", "steep=105 deg"}) ==
          "steep=105 deg: R212 with this value the pack would be refused at everywhere.yaml:5:9: "
          "'$steep .. $lean' is an empty range: its low end is above its high end\n");
    CHECK(refusals({"company=0.3"}).find("at most half of 'ambiguous_below'") != std::string::npos);
    CHECK(refusals({"sill=2.5 m"}).find("begins before the rise") != std::string::npos);
  }

  TEST_CASE("numbers are written so that they are read as the same numbers") {
    const RuleBase base = everywhere();
    CHECK(to_string(ParamValue{"sill", 0.1 + 0.2}, base) == "sill = 0.30000000000000004 m");
    CHECK(to_string(ParamValue{"enough", 1e-7}, base) == "enough = 0.0000001");
    CHECK(rc::check([&] {
      const double value = *rc::gen::inRange(1, 1'000'000) / 1e6 * 2.8 + 0.2;
      const std::array<std::string, 1> text{to_string(ParamValue{"sill", value}, base)};
      const auto read = read_assignments(base, text);
      RC_ASSERT(read.value && read.value->front().value == value);
    }));
  }
}
