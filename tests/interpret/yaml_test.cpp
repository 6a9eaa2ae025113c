#include "tests/interpret/support.h"

#include <filesystem>
#include <fstream>

#include <fmt/format.h>

using namespace oriel;
using namespace oriel::test;

TEST_SUITE("interpret") {
  TEST_CASE("a small pack loads without findings") {
    const RuleBase base = load(pack_requiring({"sense = hole"}));
    CHECK(base.name() == "t");
    CHECK(base.version() == "1.0.0");
    CHECK(base.file() == "t.yaml");
    CHECK(base.labels() == std::vector<std::string>{"window", "door"});
    CHECK(base.rule_count() == 1);
  }

  TEST_CASE("an empty pack is refused") {
    CHECK(findings("") == "t.yaml:1:1: R201 the file is empty\n\n^\n");
    CHECK(findings("# nothing\n") == "t.yaml:1:1: R201 the file is empty\n# nothing\n^\n");
  }

  TEST_CASE("broken YAML is refused at its place") {
    CHECK(findings("schema: oriel/1\npack: {name: t\nrules: []\n") ==
          "t.yaml:2:7: R201 the '{' that opens here is never closed; write 'pack: {name: t}'\n"
          "pack: {name: t\n"
          "      ^\n");
    CHECK(findings("schema: oriel/1\n\tpack: 1\n") ==
          "t.yaml:2:1: R201 there is a tab before this line; YAML is indented by spaces; write "
          "'pack: "
          "1'\n"
          "\tpack: 1\n"
          "^\n");
  }

  TEST_CASE("a quote that is never closed is refused where it opens") {
    CHECK(findings("schema: oriel/1\npack: \"t\n") ==
          "t.yaml:2:7: R201 the quote that opens here is not closed on its line; write 'pack: "
          "\"t\"'\n"
          "pack: \"t\n"
          "      ^\n");
  }

  TEST_CASE("an unquoted list of words inside a list in brackets gets advice") {
    CHECK(findings(pack_with("rules: [{id: w, label: window, require: [sense in [hole]]}]\n")) ==
          "t.yaml:4:51: R201 '[' in a text without quotes; in [ ] a text with brackets or commas "
          "needs quotes; write 'rules: [{id: w, label: window, require: [\"sense in "
          "[hole]\"]}]'\n"
          "rules: [{id: w, label: window, require: [sense in [hole]]}]\n"
          "                                                  ^\n");
  }

  TEST_CASE("a key that stands twice is refused") {
    CHECK(findings(pack_with("rules: []\nrules: []\n")) ==
          "t.yaml:5:1: R202 the key 'rules' occurs here twice\nrules: []\n^~~~~\n");
  }

  TEST_CASE("anchors aliases and tags are refused") {
    CHECK(findings(pack_with("rules: &r []\n")) ==
          "t.yaml:4:8: R203 a pack has no anchors (&name); write the value out, or use a macro\n"
          "rules: &r []\n"
          "       ^\n");
    CHECK(findings(pack_with("rules: *r\n")) ==
          "t.yaml:4:8: R203 a pack has no aliases (*name)\n"
          "rules: *r\n"
          "       ^\n");
    CHECK(findings(pack_with("rules: !list []\n")) ==
          "t.yaml:4:8: R203 a pack has no tags (!name)\n"
          "rules: !list []\n"
          "       ^\n");
  }

  TEST_CASE("aliases that would explode are refused before they do") {
    std::string text = "a: &a [x, x, x, x, x, x, x, x, x]\n";
    for (char c = 'b'; c < 'k'; ++c) {
      const char before = static_cast<char>(c - 1);
      text += fmt::format("{}: &{} [*{}, *{}]\n", c, c, before, before);
    }
    CHECK(findings(text).starts_with("t.yaml:1:4: R203 "));
  }

  TEST_CASE("a second document is refused") {
    CHECK(findings("schema: oriel/1\n---\npack: 1\n") ==
          "t.yaml:2:1: R203 a pack is one YAML document; take out what follows '---'\n"
          "---\n"
          "^\n");
  }

  TEST_CASE("a text that is not UTF-8 is refused at the byte") {
    CHECK(findings("schema: oriel/1\nname: b\xC3\xA4r \xE4\n")
              .starts_with("t.yaml:2:11: R200 this is not UTF-8 text\n"));
    CHECK(findings(std::string("schema: oriel/1\n\0", 17))
              .starts_with("t.yaml:2:1: R200 this is not UTF-8 text\n"));
    CHECK(findings("a: \xED\xA0\x80\n").starts_with("t.yaml:1:4: R200 "));
    CHECK(findings("a: \xC0\xAF\n").starts_with("t.yaml:1:4: R200 "));
  }

  TEST_CASE("a byte order mark and carriage returns do no harm") {
    CHECK(findings("\xEF\xBB\xBF" + pack_requiring({"sense = hole"})).empty());
    CHECK(findings("schema: oriel/1\r\npack: {name: t, version: 1.0.0}\r\nrules: []\r\nx: 1\r\n") ==
          "t.yaml:4:1: R209 unknown key 'x' in a pack (keys: schema, pack, extends, params, hosts, "
          "classes, relations, macros, rules, decide, iterate, groups, emit, surfaces, generalise, "
          "invariants)\n"
          "x: 1\n"
          "^\n");
  }

  TEST_CASE("columns count characters and not bytes") {
    CHECK(findings(pack_with("rules: [{id: w, \"gr\xC3\xB6\xC3\x9F"
                             "e\": 1, lable: window}]\n"))
              .find("t.yaml:4:29: R209 unknown key 'lable'") != std::string::npos);
  }

  TEST_CASE("packs beyond the limits are refused") {
    CHECK(findings(std::string(1024 * 1024 + 1, '#'))
              .starts_with("t.yaml:1:1: R213 a pack is no longer than 1 MiB\n"));
    CHECK(findings(std::string(65, '[') + std::string(65, ']'))
              .starts_with("t.yaml:1:65: R213 a pack nests no deeper than 64 levels\n"));
    CHECK(findings(std::string(200'000, '[')).find("R213 a pack nests no deeper than 64 levels") !=
          std::string::npos);
    std::string list = "[";
    for (int i = 0; i < 100'000; ++i) list += "1,";
    CHECK(findings(list + "]").find("R213 a pack has no more than 100000 YAML nodes") !=
          std::string::npos);
  }

  TEST_CASE("too many classes are refused") {
    std::string text = "schema: oriel/1\npack: {name: t, version: 1.0.0}\nclasses:\n";
    for (int i = 0; i < 257; ++i) text += "  c" + std::to_string(i) + ": {}\n";
    CHECK(findings(text + "rules: []\n") ==
          "t.yaml:4:3: R213 'classes' has no more than 256 entries\n"
          "  c0: {}\n"
          "  ^\n");
  }

  TEST_CASE("bare yes and on are refused as keys and as values") {
    CHECK(findings("schema: oriel/1\npack: {name: t, version: 1.0.0}\n"
                   "classes: {opening: {abstract: yes}, on: {}}\nrules: []\n") ==
          "t.yaml:3:31: R214 bare 'yes' is a yes or no to some YAML readers and a text to others; "
          "write true, false or \"yes\"\n"
          "classes: {opening: {abstract: yes}, on: {}}\n"
          "                              ^~~\n"
          "t.yaml:3:37: R214 bare 'on' is a yes or no to some YAML readers and a text to others; "
          "write true, false or \"on\"\n"
          "classes: {opening: {abstract: yes}, on: {}}\n"
          "                                    ^~\n");
  }

  TEST_CASE("a bare number in base 60 is refused") {
    const std::string found =
        findings(pack_with("rules: []\ngeneralise: [{id: a, scale: 1:50, for: any, do: omit}]\n"));
    CHECK(
        found.starts_with("t.yaml:5:29: R214 bare '1:50' is the number 110 in base 60 to some "
                          "YAML readers; write \"1:50\"\n"
                          "generalise: [{id: a, scale: 1:50, for: any, do: omit}]\n"
                          "                            ^~~~\n"));
  }

  TEST_CASE("a pack is found in a file or among those built in") {
    const auto path = std::filesystem::temp_directory_path() / "oriel_yaml_test.yaml";
    std::ofstream(path) << pack_requiring({"sense = whole"});
    const auto checked = load_pack_file(path.string());
    CHECK_FALSE(checked.value);
    REQUIRE(checked.issues.size() == 1);
    CHECK(checked.issues[0].place.file == path.string());
    CHECK(checked.issues[0].place.line == 8);
    std::filesystem::remove(path);

    CHECK(load_pack_file("residential").value);
    const auto missing = load_pack_file("no-such-pack.yaml");
    CHECK_FALSE(missing.value);
    REQUIRE(missing.issues.size() == 1);
    CHECK(to_string(missing.issues[0]) ==
          "no-such-pack.yaml: R200 there is no pack here that can be read; the packs built in are: "
          "cartographic, residential, surfaces-only");
    CHECK_FALSE(load_pack_file(std::filesystem::temp_directory_path().string()).value);
  }
}
