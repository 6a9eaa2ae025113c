#include "tests/interpret/support.h"

using namespace oriel;
using namespace oriel::test;

namespace {

/// A pack whose only line_fault is in `line`, which is line 4.
std::string line_fault(const std::string& line) {
  return findings(pack_with(line + "\nrules: []\n"));
}

/// A pack whose only line_fault is in its one rule, which begins on line 5.
std::string fault_in_rule(const std::string& lines) {
  return findings(pack_with("rules:\n" + lines));
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("all findings come at once in the order of the text") {
    const std::string found = findings(
        "schema: oriel/2\n"
        "pack: {name: t}\n"
        "params: {p: {value: 1 meter}}\n"
        "clases: {}\n"
        "rules:\n"
        "  - {id: a, label: window, require: heigth > 1}\n");
    const std::vector<std::string> expected = {"t.yaml:1:9: R212",  "t.yaml:2:7: R210",
                                               "t.yaml:3:23: R233", "t.yaml:4:1: R209",
                                               "t.yaml:6:20: R205", "t.yaml:6:37: R204"};
    std::size_t at = 0;
    for (const std::string& place : expected) {
      const std::size_t next = found.find(place, at);
      CHECK_MESSAGE(next != std::string::npos, place);
      at = next == std::string::npos ? at : next;
    }
  }

  TEST_CASE("an unknown key is named with what was probably meant") {
    CHECK(line_fault("clases: {}") ==
          "t.yaml:4:1: R209 unknown key 'clases' in a pack; did you mean 'classes'?\n"
          "clases: {}\n"
          "^~~~~~\n");
  }

  TEST_CASE("the rest of a text after a comma gets advice") {
    CHECK(line_fault("params: {p: {value: 1 m, why: small, but not too small}}")
              .starts_with("t.yaml:4:38: R209 inside { } a comma ends a text; a text with a comma "
                           "needs quotes: write 'why: \"small, but not too small\"'\n"));
  }

  TEST_CASE("a key that is needed is missed where its map begins") {
    CHECK(fault_in_rule("  - id: w\n    require: sense = hole\n") ==
          "t.yaml:5:5: R210 the rule 'w' needs the key 'label'\n"
          "  - id: w\n"
          "    ^\n");
    CHECK(fault_in_rule("  - {id: w, label: window, require: []}\n")
              .starts_with("t.yaml:5:37: R210 a rule needs a condition under 'require'\n"));
    CHECK(line_fault("params: {p: {why: because}}") ==
          "t.yaml:4:13: R210 the param 'p' needs the key 'value'\n"
          "params: {p: {why: because}}\n"
          "            ^\n");
  }

  TEST_CASE("a value of the wrong type is refused") {
    CHECK(fault_in_rule("  - {id: w, label: [window], require: sense = hole}\n") ==
          "t.yaml:5:20: R211 a label is a text, but here is a list; write one value, as in "
          "'label: window'\n"
          "  - {id: w, label: [window], require: sense = hole}\n"
          "                   ^\n");
    CHECK(fault_in_rule("  - {id: w, label: window, priority: high, require: sense = hole}\n") ==
          "t.yaml:5:38: R211 a priority is a whole number, not 'high'\n"
          "  - {id: w, label: window, priority: high, require: sense = hole}\n"
          "                                     ^~~~\n");
    CHECK(findings(pack_with("rules: {w: 1}\n")) ==
          "t.yaml:4:8: R211 'rules' is a list, but here is a map; an entry of it begins with '- ': "
          "write '- w: 1'\n"
          "rules: {w: 1}\n"
          "       ^\n");
    CHECK(findings("- schema\n") ==
          "t.yaml:1:1: R211 a pack is a map, but here is a list\n"
          "- schema\n"
          "^\n");
  }

  TEST_CASE("a value outside its bounds is refused") {
    CHECK(line_fault("params: {p: {value: 6 m, range: 0.3 m .. 1 m}}")
              .starts_with("t.yaml:4:21: R212 the value is outside its range\n"));
    CHECK(
        line_fault("params: {p: {value: 6 m, range: 1 m .. 0.3 m}}")
            .starts_with("t.yaml:4:33: R212 an empty range: its low end is above its high end\n"));
    CHECK(line_fault("decide: {min_score: 1.5}")
              .starts_with("t.yaml:4:21: R212 'min_score' lies in 0 .. 1\n"));
    CHECK(line_fault("decide: {otherwise: window}")
              .starts_with("t.yaml:4:21: R212 'otherwise' is one of unknown, not 'window'\n"));
    CHECK(line_fault("hosts: {wall: 60 deg .. 120 deg, roof: 0 deg .. 75 deg}")
              .starts_with("t.yaml:4:8: R212 wall, roof and ground overlap\n"));
    CHECK(findings("schema: oriel/1\npack: {name: t, version: 1.0}\nrules: []\n")
              .starts_with(
                  "t.yaml:2:26: R212 a version is three numbers such as 1.0.0, not '1.0'\n"));
    CHECK(fault_in_rule("  - id: w\n    label: window\n    require: sense = hole\n"
                        "    score: [a: {rise: 0 m .. 1 m, weight: 0}]\n")
              .starts_with("t.yaml:8:43: R212 a weight is more than 0, at most 1000000\n"));
    CHECK(fault_in_rule("  - id: w\n    label: window\n    require: sense = hole\n"
                        "    score: [a: {rise: 0 m .. 2 m, fall: 1 m .. 3 m}]\n")
              .starts_with("t.yaml:8:16: R212 the fall begins before the rise has ended\n"));
  }

  TEST_CASE("invariants of a pack are numbers above 0 that it knows") {
    const auto loaded =
        load_pack(pack_with("invariants: {eaves-m: 0.5, volume-pct: 5}\nrules: []\n"), "t.yaml");
    REQUIRE(loaded.value);
    CHECK(loaded.value->limits() == Limits{.volume_pct = 5, .eaves_m = 0.5});
    CHECK(load_pack(pack_with("rules: []\n"), "t.yaml").value->limits() == Limits{});
    CHECK(line_fault("invariants: {eaves-m: -1}")
              .starts_with("t.yaml:4:23: R211 'eaves-m' is more than 0\n"));
    CHECK(line_fault("invariants: {eaves: 1}").starts_with("t.yaml:4:14: R209 "));
    CHECK(line_fault("invariants: [1]").starts_with("t.yaml:4:13: R211 "));
  }

  TEST_CASE("entries for groups name one that is declared") {
    CHECK(line_fault("generalise: [{id: r, scale: \"1:1000 ..\", for: group row, do: omit}]")
              .starts_with("t.yaml:4:47: R253 unknown group 'row'; the pack has no 'groups'\n"));
  }

  TEST_CASE("names that cannot be told from the language are refused") {
    CHECK(findings("schema: oriel/1\npack: {name: t, version: 1.0.0}\n"
                   "classes: {wall: {}, Window: {}, in: {}}\nrules: []\n") ==
          "t.yaml:3:11: R216 a class cannot be called 'wall': this name has a meaning of its own\n"
          "classes: {wall: {}, Window: {}, in: {}}\n"
          "          ^~~~\n"
          "t.yaml:3:21: R216 a class cannot be called 'Window': a name is a small letter, then "
          "small letters, digits and _\n"
          "classes: {wall: {}, Window: {}, in: {}}\n"
          "                    ^~~~~~\n"
          "t.yaml:3:33: R216 a class cannot be called 'in': this is a word of the language\n"
          "classes: {wall: {}, Window: {}, in: {}}\n"
          "                                ^~\n");
    CHECK(line_fault("macros: {depth: sense = hole}")
              .starts_with("t.yaml:4:10: R216 a macro cannot be called 'depth': there is an "
                           "attribute of this name\n"));
    CHECK(fault_in_rule("  - {id: Window 1, label: window, require: sense = hole}\n")
              .starts_with("t.yaml:5:10: R216 a rule cannot be called 'Window 1': an id is names "
                           "joined by points, such as door.ground\n"));
  }

  TEST_CASE("a rule id that stands twice is refused") {
    CHECK(fault_in_rule("  - {id: w, label: window, require: sense = hole}\n"
                        "  - {id: w, label: door, require: sense = hole}\n") ==
          "t.yaml:6:10: R240 there is a rule 'w' already\n"
          "  - {id: w, label: door, require: sense = hole}\n"
          "         ^\n");
    CHECK(line_fault("generalise: [{id: a, scale: \"1:5 ..\", for: any, do: omit}, "
                     "{id: a, scale: \"1:9 ..\", for: any, do: omit}]")
              .starts_with("t.yaml:4:65: R240 there is an entry 'a' already\n"));
  }

  TEST_CASE("params and macros that nothing uses are warned of") {
    const auto checked = load_pack(
        pack_with("params: {p: {value: 1 m}}\nmacros: {deep: depth > 1 m}\nrules: []\n"), "t.yaml");
    CHECK(checked.value);
    REQUIRE(checked.issues.size() == 2);
    CHECK(checked.issues[0].severity == Severity::warning);
    CHECK(to_string(checked.issues[0]) ==
          "t.yaml:4:10: R241 the param 'p' is never used\n"
          "params: {p: {value: 1 m}}\n"
          "         ^");
    CHECK(to_string(checked.issues[1]) ==
          "t.yaml:5:10: R242 the macro 'deep' is never used\n"
          "macros: {deep: depth > 1 m}\n"
          "         ^~~~");
  }

  TEST_CASE("a macro that nothing uses is checked all the same") {
    CHECK(line_fault("macros: {deep: depth > 1}")
              .find("t.yaml:4:24: R231 'depth' is a length: write 1 m") != std::string::npos);
  }

  TEST_CASE("a circle in the class tree is refused") {
    CHECK(findings("schema: oriel/1\npack: {name: t, version: 1.0.0}\n"
                   "classes: {a: {is: b}, b: {is: a}}\nrules: []\n")
              .starts_with("t.yaml:3:11: R244 the class 'a' is its own ancestor\n"));
  }

  TEST_CASE("a class tree that is too deep is refused") {
    std::string classes = "classes:\n  c0: {}\n";
    for (int i = 1; i <= 16; ++i) classes += fmt::format("  c{}: {{is: c{}}}\n", i, i - 1);
    CHECK(findings("schema: oriel/1\npack: {name: t, version: 1.0.0}\n" + classes + "rules: []\n")
              .starts_with("t.yaml:20:3: R213 a class tree is no deeper than 16 levels\n"));
  }

  TEST_CASE("an abstract class neither scores nor has a priority") {
    CHECK(
        fault_in_rule("  - {id: o, label: opening, priority: 3, require: sense = hole}\n")
            .starts_with("t.yaml:5:5: R232 'opening' is abstract: it holds or not, and has neither "
                         "score nor priority\n"));
  }

  TEST_CASE("scales are checked") {
    const auto found = [](const std::string& scale) {
      return line_fault("generalise: [{id: a, scale: " + scale + ", for: any, do: omit}]");
    };
    CHECK(found("\"1:1000 .. 1:2500\"").empty());
    CHECK(found("\"1:1000 ..\"").empty());
    CHECK(found("1:1000 .. 1:2500").empty());
    CHECK(found("\"1:1000\"") ==
          "t.yaml:4:30: R250 a scale is a range: write \"1:1000 ..\" for this scale and all "
          "that are smaller\n"
          "generalise: [{id: a, scale: \"1:1000\", for: any, do: omit}]\n"
          "                             ^~~~~~\n");
    CHECK(found("\"1000 ..\"").starts_with("t.yaml:4:30: R250 "));
    CHECK(found("\"1:0 ..\"").starts_with("t.yaml:4:30: R250 "));
    CHECK(found("\"1:2500 .. 1:1000\"")
              .starts_with(
                  "t.yaml:4:30: R250 the scale range is empty: the larger scale comes first\n"));
  }

  TEST_CASE("operators are known by name and take their own arguments") {
    const auto found = [](const std::string& operation) {
      return line_fault("generalise: [{id: a, scale: \"1:9 ..\", for: any, do: " + operation +
                        "}]");
    };
    CHECK(found("omit").empty());
    CHECK(found("omitt").starts_with(
        "t.yaml:4:53: R251 unknown operator 'omitt'; did you mean 'omit'?\n"));
    CHECK(found("{displace: {to: 0.5 mm@map, gap: 10 cm}}").empty());
    CHECK(found("merge").empty());
    CHECK(found("{merge: {to: 1 m}}").starts_with("t.yaml:4:61: R211 'merge' has no arguments"));
    CHECK(found("collapse").empty());
    CHECK(found("{enlarge: {to: 0.5 mm@map, anchor: sill, gap: 10 cm}}").empty());
    CHECK(found("{typify: {ratio: 50 %}}").empty());
    CHECK(found("{enlarge: {anchor: top}}")
              .starts_with("t.yaml:4:72: R211 'anchor' is one of centre, sill, not 'top'\n"));
    CHECK(found("{enlarge: {into: 1 m}}").starts_with("t.yaml:4:64: R209 "));
    CHECK(found("{enlarge: {to: 1 m2}}").starts_with("t.yaml:4:68: R230 "));
    CHECK(found("{omit: {to: 1 m}}")
              .starts_with("t.yaml:4:60: R211 'omit' has no arguments: write do: omit\n"));
  }

  TEST_CASE("what belongs to a feature goes, moves or grows with it") {
    const auto found = [](const std::string& operation, const std::string& as) {
      return line_fault("generalise: [{id: a, scale: \"1:9 ..\", for: any, do: " + operation +
                        ", with: {by: beside, as: " + as + "}}]");
    };
    for (const char* as : {"goes", "moves", "grows"}) CHECK(found("displace", as).empty());
    CHECK(found("displace", "stays")
              .starts_with("t.yaml:4:86: R211 'as' is one of goes, moves, grows, not 'stays'\n"));
    CHECK(found("omit", "goes").empty());
    for (const char* as : {"moves", "grows"})
      CHECK(found("omit", as)
                .starts_with("t.yaml:4:82: R211 'as' says what becomes of things when the feature "
                             "is drawn again, and "
                             "'omit' only takes it away: leave it out\n"));
  }

  TEST_CASE("codes and types of what is written are checked") {
    CHECK(line_fault("emit: {window: {type: Windo}}")
              .starts_with("t.yaml:4:23: R212 an emitted type is one of Window, Door, "
                           "BuildingInstallation, not 'Windo'; did you mean 'Window'?\n"));
    CHECK(line_fault("emit: {window: {type: BuildingInstallation, function: {sig3d: 1070}}}") ==
          "t.yaml:4:63: R211 a code is a text: write \"1070\"\n"
          "emit: {window: {type: BuildingInstallation, function: {sig3d: 1070}}}\n"
          "                                                              ^~~~\n");
    CHECK(line_fault("emit: {windw: {type: Window}}")
              .starts_with("t.yaml:4:8: R205 unknown class 'windw'; did you mean 'window'?\n"));
  }
}
