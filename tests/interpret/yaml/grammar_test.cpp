#include "interpret/yaml/grammar.h"

#include "interpret/language/source.h"
#include "interpret/pack/pack_grammar.h"
#include "interpret/plan/profile_grammar.h"
#include "interpret/testing/test_grammar.h"
#include "interpret/yaml/known_keys.h"
#include "interpret/yaml/section.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;
using namespace oriel::rules;

namespace {

/// The grammar of packs in which rules may have a colour.
Grammar with_colours() {
  std::string schema = pack_grammar().schema();
  const std::string before = R"("priority": {"type": "integer")";
  const std::size_t at = schema.find(before);
  REQUIRE(at != std::string::npos);
  return Grammar(schema.insert(at, R"("colour": {"type": "string", "description": "on maps"}, )"));
}

/// What is found in a map that is called a rule.
std::vector<SpannedFinding> findings_in_rule(const std::string& text, const Grammar& grammar) {
  const Source source("t.yaml", text);
  Findings findings(source);
  const auto node = parse_yaml({0, source.text().size()}, findings);
  REQUIRE(node);
  const YamlSection section(*node, "a rule", grammar.keys("rule"), findings);
  return findings.spanned();
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("a key that is added to the grammar is read and meant by keys that are misspelt") {
    const Grammar grammar = with_colours();
    CHECK(grammar.has_key("colour"));
    CHECK_FALSE(pack_grammar().has_key("colour"));
    CHECK(findings_in_rule("{id: r, colour: red}", grammar).empty());
    CHECK_FALSE(findings_in_rule("{id: r, colour: red}", pack_grammar()).empty());
    const auto findings = findings_in_rule("{id: r, colur: red}", grammar);
    REQUIRE(findings.size() == 1);
    CHECK(findings[0].sentence.find("did you mean 'colour'?") != std::string::npos);
  }

  TEST_CASE("a map is called as its definition or as the key that it is the value of") {
    CHECK(pack_grammar().keys("param") == std::vector<std::string>{"value", "range", "why"});
    CHECK(pack_grammar().keys("with") == std::vector<std::string>{"by", "of", "as"});
    CHECK(pack_grammar().keys("")[0] == "schema");
    CHECK(profile_grammar().keys("invariants") == pack_grammar().keys("invariants"));
    CHECK_THROWS_AS(static_cast<void>(pack_grammar().keys("no such map")), std::out_of_range);
  }

  TEST_CASE("keys of packs and profiles and tests are known but letters are not") {
    for (const char* key : {"require", "enlarge", "ratio", "footprint-edge-m", "tests_for"})
      CHECK_MESSAGE(is_known_yaml_key(key), key);
    for (const char* word : {"a", "width", "residential", ""})
      CHECK_FALSE_MESSAGE(is_known_yaml_key(word), word);
  }
}
