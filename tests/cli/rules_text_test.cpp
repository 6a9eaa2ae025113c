#include "tests/cli/command.h"

#include <doctest/doctest.h>

using namespace oriel::test;

namespace {

const std::string kPack =
    "schema:  oriel/1\npack: {name: t, version: 1.0.0}\nclasses: {window: {}}\n"
    "rules: [{id: w, label: window, require: natural}]   # all of it\n";

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("rules fmt prints and checks and writes the canonical form") {
    const Folder folder;
    const std::string pack = folder.write("p.yaml", kPack);
    const Outcome printed = run({"rules", "fmt", pack});
    CHECK(printed.exit == 0);
    CHECK(printed.out.starts_with("schema: oriel/1\n"));
    CHECK(printed.out.ends_with("  # all of it\n"));
    CHECK(bytes_of(pack) == kPack);
    CHECK(run({"rules", "fmt", "--check", pack}).exit == 4);
    CHECK(run({"rules", "fmt", "-w", pack}).exit == 0);
    CHECK(bytes_of(pack) == printed.out);
    CHECK(run({"rules", "fmt", "--check", pack}).exit == 0);
    CHECK(run({"rules", "fmt", "-w", "--check", pack}).exit == 2);
    CHECK(run({"rules", "fmt", "-w", "residential"}).exit == 2);
    const Outcome wrong = run({"rules", "fmt", folder.write("bad.yaml", "rules: []\n")});
    CHECK(wrong.exit == 4);
    CHECK(wrong.out.empty());
    CHECK(wrong.says("R210"));
  }

  TEST_CASE("the whole pack of the reference loads and passes its tests as printed there") {
    const std::string docs = bytes_of(std::string(ORIEL_SOURCE_DIR) + "/docs/rules.md");
    std::size_t at = docs.find("\n## A whole pack");
    const auto block = [&] {
      const std::string fence = "```yaml\n";
      const std::size_t begin = docs.find(fence, at) + fence.size();
      at = docs.find("```\n", begin);
      return docs.substr(begin, at - begin);
    };
    const Folder folder;
    const std::string pack = folder.write("residential.yaml", block());
    ++at;  // behind the closing fence
    folder.write("residential.test.yaml", block());
    folder.write("l-house.stripped.city.json", bytes_of(sample("l-house")));
    const Outcome checked = run({"rules", "check", pack});
    CHECK(checked.exit == 0);
    CHECK(checked.err.find("R2") == std::string::npos);
    const Outcome tested = run({"rules", "test", pack});
    CHECK(tested.exit == 0);
    CHECK(tested.out.find("3 of 3 tests passed") != std::string::npos);
    for (const char* scale : {"1:1000", "1:2000", "1:4000"})
      CHECK(run({"generalise", sample("l-house"), "--rules", pack, "--scale", scale, "-o",
                 folder / "out.city.json"})
                .exit == 0);
  }

  TEST_CASE("rules new writes a pack that passes its check and its tests at once") {
    const Folder folder;
    const Outcome made = run({"rules", "new", folder / "solar_panel"});
    CHECK(made.exit == 0);
    CHECK(folder.names() == std::vector<std::string>{"solar_panel.city.json",
                                                     "solar_panel.test.yaml", "solar_panel.yaml"});
    const std::string pack = folder / "solar_panel.yaml";
    CHECK(made.out.find("oriel rules test " + pack) != std::string::npos);
    CHECK(bytes_of(pack).find("my_class") == std::string::npos);
    const Outcome checked = run({"rules", "check", pack});
    CHECK(checked.exit == 0);
    CHECK(checked.err.empty());
    CHECK(run({"rules", "fmt", "--check", pack}).exit == 0);
    const Outcome tested =
        run({"rules", "test", pack, "--min-coverage", "100", "--min-conditions", "100"});
    CHECK(tested.exit == 0);
    CHECK(tested.out == folder / "solar_panel.test.yaml" +
                            ": 5 of 5 tests passed; 100.0 % of 1 rule held, 100.0 % of its "
                            "conditions both held and failed\n");
    CHECK(run({"label", folder / "solar_panel.city.json", "--rules", pack})
              .says("2 solar_panel, 6 window"));
  }

  TEST_CASE("rules new writes over nothing and refuses names that no class can have") {
    const Folder folder;
    folder.write("thing.test.yaml", "mine");
    const Outcome refused = run({"rules", "new", folder / "thing"});
    CHECK(refused.exit == 2);
    CHECK(refused.says("E604"));
    CHECK(refused.says("thing.test.yaml exists already"));
    CHECK(folder.names() == std::vector<std::string>{"thing.test.yaml"});
    CHECK(bytes_of(folder / "thing.test.yaml") == "mine");
    for (const char* name : {"Solar", "solar-panel", "1st", "and", ""}) {
      CAPTURE(name);
      const Outcome wrong = run({"rules", "new", folder / name});
      CHECK(wrong.exit == 2);
      CHECK(wrong.says("R216"));
    }
    CHECK(run({"rules", "new", folder / "window"}).says("is a class of residential"));
    CHECK(run({"rules", "new", folder / "no/such/thing"}).exit == 6);
    CHECK(folder.names().size() == 1);
  }

  TEST_CASE("rules show prints a pack as it is or merged") {
    const Folder folder;
    CHECK(run({"rules", "show", "residential"}).out ==
          bytes_of(std::string(ORIEL_SOURCE_DIR) + "/rules/residential.yaml"));
    folder.write("base.yaml", kPack);
    const std::string upper = folder.write(
        "upper.yaml", "schema: oriel/1\npack: {name: u, version: 1.0.0}\nextends: base.yaml\n");
    const Outcome merged = run({"rules", "show", "--merged", upper});
    CHECK(merged.exit == 0);
    CHECK(merged.out.find("extends") == std::string::npos);
    const std::string alone = folder.write("alone.yaml", merged.out);
    CHECK(run({"rules", "check", alone}).exit == 0);
    CHECK(run({"rules", "show", "--merged", alone}).out == merged.out);
    CHECK(run({"rules", "show", folder / "none.yaml"}).exit == 4);
  }
}
