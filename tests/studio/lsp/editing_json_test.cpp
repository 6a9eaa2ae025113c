#include "studio/lsp/editing_json.h"

#include <string>

#include <doctest/doctest.h>

using namespace oriel;

namespace {

using OrderedJson = nlohmann::ordered_json;

const std::string kPack =
    "schema: oriel/1\npack: {name: town, version: 1.0.0}\nparams:\n"
    "  sill: {value: 0.9 m, why: \xF0\x9F\x8F\xA0 sills}\nclasses:\n  window: {}\nrules:\n"
    "  - id: w\n    label: window\n    require: [a > $sill]\nemit: {window: {type: Window}}\n";

OrderedJson ask(OrderedJson body, int status = 200) {
  if (!body.contains("text")) body["text"] = kPack;
  const studio::Reply reply = studio::answer_language(body.dump(), "town.yaml");
  CAPTURE(reply.json);
  CHECK(reply.status == status);
  return OrderedJson::parse(reply.json);
}

}  // namespace

TEST_SUITE("studio/lsp") {
  TEST_CASE("the page is answered what an editor is") {
    const auto items = ask({{"verb", "complete"}, {"line", 10}, {"column", 20}})["items"];
    REQUIRE(items.size() == 1);
    CHECK(items[0]["label"] == "$sill");
    CHECK(items[0]["from_column"] == 19);
    CHECK(ask({{"verb", "hover"}, {"line", 10}, {"column", 21}})["text"] ==
          "sill: param, 0.9 m\n\xF0\x9F\x8F\xA0 sills");
    CHECK(ask({{"verb", "hover"}, {"line", 11}, {"column", 99}}).is_null());
    CHECK(ask({{"verb", "definition"}, {"line", 10}, {"column", 21}})["line"] == 4);
    CHECK(ask({{"verb", "format"}}).contains("text"));
    CHECK(ask({{"verb", "format"}, {"text", "a: ["}}).contains("findings"));
    const auto outline = ask({{"verb", "outline"}})["items"];
    CHECK(outline.back()["name"] == "emit");
    CHECK(ask({{"verb", "definition"},
               {"line", 1},
               {"column", 12},
               {"text", "extends: residential\n"}})
              .is_null());
    const auto edits =
        ask({{"verb", "rename"}, {"line", 10}, {"column", 21}, {"name", "parapet"}})["edits"];
    CHECK(edits.size() == 2);
    CHECK(edits[0]["text"] == "parapet");
  }

  TEST_CASE("findings stand where the editor counts with their fixes") {
    std::string text = kPack;
    text.replace(text.find("why: "), 5, "wy: ");
    const auto findings = studio::findings_json(EditedPack(text, "town.yaml"));
    REQUIRE(findings.size() == 1);
    CHECK(findings[0]["code"] == "R209");
    CHECK(findings[0]["advice"] == "did you mean 'why'?");
    CHECK(findings[0]["line"] == 4);
    CHECK(findings[0]["column"] == 24);
    CHECK(findings[0]["end_column"] == 26);
    CHECK(findings[0]["fixes"][0]["edits"][0]["text"] == "why");
    const auto asked = [&](int column) {
      return ask({{"verb", "fixes"}, {"text", text}, {"line", 4}, {"column", column}})["fixes"];
    };
    CHECK(asked(25) == findings[0]["fixes"]);
    CHECK(asked(3).empty());
  }

  TEST_CASE("what cannot be answered is refused with a sentence") {
    CHECK(ask({{"verb", "sing"}}, 400).contains("error"));
    CHECK(ask({{"verb", "rename"}, {"line", 10}, {"column", 21}, {"name", "two words"}}, 409)
              .contains("error"));
    for (const char* body : {"", "[]", "{", "{\"verb\": 7}", "{\"verb\": \"hover\"}"})
      CHECK(studio::answer_language(body, "").status == 400);
  }
}
