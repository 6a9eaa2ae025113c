#include "tests/cli/command.h"

#include <algorithm>
#include <sys/stat.h>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;

namespace {

std::string residential() {
  return bytes_of(std::string(ORIEL_SOURCE_DIR) + "/rules/residential.yaml");
}

/// `label` and `rules check` with a bad pack: exit 4, the finding, and no output.
void check_refused(const std::string& text, const std::string& finding) {
  const Folder folder;
  const std::string pack = folder.write("my.yaml", text);
  const Outcome labelled =
      run({"label", sample("hip"), "--rules", pack, "-o", folder / "out.city.json"});
  CAPTURE(labelled.err);
  CHECK(labelled.exit == 4);
  CHECK(labelled.says("error: " + pack + finding));
  CHECK(labelled.out.empty());
  CHECK(folder.names() == std::vector<std::string>{"my.yaml"});
  const Outcome checked = run({"rules", "check", pack});
  CHECK(checked.exit == 4);
  CHECK(checked.err == labelled.err);
  CHECK(checked.out.empty());
}

/// ":line:column" of `word` in `text`.
std::string place_of(const std::string& text, const std::string& word) {
  const auto at = text.find(word);
  const auto begin = text.rfind('\n', at) + 1;
  const auto line = std::ranges::count(text.substr(0, at), '\n') + 1;
  return fmt::format(":{}:{}", line, at - begin + 1);
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a pack that extends a pipe is refused and does not wait for it") {
    const Folder folder;
    REQUIRE(::mkfifo((folder / "pipe.yaml").c_str(), 0600) == 0);
    const std::string pack = folder.write(
        "my.yaml",
        "schema: oriel/1\npack: {name: my, version: 1.0.0}\nextends: pipe.yaml\nrules: []\n");
    const Outcome checked = run({"rules", "check", pack});
    CHECK(checked.exit == 4);
    CHECK(checked.says("error: " + pack + ":3:10: R200 there is no pack 'pipe.yaml' here"));
  }

  TEST_CASE("a pack with a typo is refused with its place and a suggestion") {
    const std::string text =
        replaced(residential(),
                 "split_order <= 1 and base_height >=", "split_order <= 1 and base_heigth >=");
    check_refused(text,
                  place_of(text, "base_heigth") +
                      ": R204 unknown attribute 'base_heigth'; did you mean 'base_height'?\n");
    const Folder folder;
    const Outcome outcome = run({"rules", "check", folder.write("my.yaml", text)});
    CHECK(outcome.says(" ^~~~~~~~~~~\n"));
  }

  TEST_CASE("a pack with a unit error is refused") {
    const std::string text = replaced(residential(), "and a <= 4 m\n", "and a <= 4 m2\n");
    check_refused(text, place_of(text, "4 m2") + ": R230 'a' is a length and '4 m2' is an area");
  }

  TEST_CASE("a pack with a duplicate key is refused") {
    const std::string text = replaced(residential(), "  bay:      {}\n", "  bay: {}\n  bay: {}\n");
    const auto twin = place_of(text, "bay: {}\n  bay");  // the line before
    const int line = std::stoi(twin.substr(1)) + 1;
    check_refused(text, fmt::format(":{}:3: R202 the key 'bay' occurs here twice", line));
  }

  TEST_CASE("a pack that is missing is refused with the names of those there are") {
    const Folder folder;
    const Outcome outcome = run(
        {"label", sample("hip"), "--rules", folder / "no.yaml", "-o", folder / "out.city.json"});
    CHECK(outcome.exit == 4);
    CHECK(outcome.says("no.yaml: R200 "));
    CHECK(outcome.says("residential"));
    CHECK(folder.names().empty());
  }

  TEST_CASE("a pack whose name is misspelt is suggested") {
    const Folder folder;
    const auto check_suggested = [&](const std::string& name, const std::string& sentence) {
      for (const std::vector<std::string>& call :
           {std::vector<std::string>{"label", sample("hip"), "--rules", name},
            {"rules", "check", name}}) {
        const Outcome outcome = run(call);
        CHECK(outcome.exit == 4);
        CHECK(outcome.err ==
              "error: " + name + ": R200 there is no pack here that can be read" + sentence + "\n");
      }
    };
    check_suggested("residental", "; did you mean 'residential'?");
    check_suggested("Residential.yaml", "; did you mean 'residential'?");
    check_suggested(folder / "residential.yaml",
                    "; did you mean 'residential', which is built in?");
  }

  TEST_CASE("a broken pack is told before a broken input") {
    const Folder folder;
    const Outcome outcome = run({"label", folder / "no.city.json", "--rules", "nothing"});
    CHECK(outcome.exit == 4);
    CHECK(!outcome.says("E101"));
  }

  TEST_CASE("rules check says what a good pack is") {
    const Outcome outcome = run({"rules", "check", "residential"});
    CHECK(outcome.exit == 0);
    CHECK(outcome.out.starts_with("residential: pack residential "));
    CHECK(outcome.err.empty());
  }

  TEST_CASE("rules check --json has all findings as one array") {
    const Folder folder;
    const std::string text = replaced(residential(), "and a <= 4 m\n", "and a <= 4 m2\n");
    const std::string pack = folder.write("my.yaml", text);
    const Outcome bad = run({"rules", "check", pack, "--json"});
    CHECK(bad.exit == 4);
    CHECK(bad.err.empty());
    const auto findings = nlohmann::json::parse(bad.out);
    REQUIRE(findings.size() == 1);
    CHECK(findings[0]["code"] == "R230");
    CHECK(findings[0]["file"] == pack);
    CHECK(fmt::format(":{}:{}", findings[0]["line"].get<int>(), findings[0]["column"].get<int>()) ==
          place_of(text, "4 m2"));
    const Outcome good = run({"rules", "check", "residential", "--json"});
    CHECK(good.exit == 0);
    CHECK(good.out == "[]\n");
  }

  TEST_CASE("rules check goes on after a bad pack") {
    const Outcome outcome = run({"rules", "check", "nothing", "residential"});
    CHECK(outcome.exit == 4);
    CHECK(outcome.says("nothing: R200"));
    CHECK(outcome.out.starts_with("residential: pack residential "));
  }
}
