#include "tests/interpret/support.h"

#include <filesystem>
#include <fstream>
#include <unistd.h>

using namespace oriel;
using namespace oriel::test;

namespace {

/// A folder of packs that is gone afterwards.
class Packs {
 public:
  Packs() {
    static int count = 0;
    folder_ = std::filesystem::temp_directory_path() /
              fmt::format("oriel-packs-{}-{}", ::getpid(), ++count);
    std::filesystem::create_directories(folder_);
  }
  Packs(const Packs&) = delete;
  Packs& operator=(const Packs&) = delete;
  ~Packs() { std::filesystem::remove_all(folder_); }

  [[nodiscard]] std::string path(const std::string& name) const { return folder_ / name; }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path(name)) << text;
  }
  /// All findings, with the names of files alone.
  [[nodiscard]] std::string findings(const std::string& name) const {
    std::string printed;
    for (Issue issue : load_pack_file(path(name)).issues) {
      issue.place.file = std::filesystem::path(issue.place.file).filename();
      printed += to_string(issue) + "\n";
    }
    return printed;
  }
  [[nodiscard]] RuleBase load(const std::string& name) const {
    CHECK(findings(name).empty());
    auto checked = load_pack_file(path(name));
    REQUIRE(checked.value);
    return *checked.value;
  }

 private:
  std::filesystem::path folder_;
};

std::string header(const std::string& extends) {
  return "schema: oriel/1\npack: {name: upper, version: 1.0.0}\nextends: " + extends + "\n";
}

const std::string kBase = pack_with(
    "params: {low: {value: 1 m, range: 0 m .. 2 m}}\n"
    "rules:\n"
    "  - {id: w, label: window, require: base_height > $low}\n"
    "  - {id: d, label: door, require: base_height <= $low}\n");

Scene two() {
  Scene scene;
  scene.add({{"base_height", 0.5}});
  scene.add({{"base_height", 1.5}});
  return scene;
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("a pack takes from another what it does not say itself") {
    const Packs packs;
    packs.write("base.yaml", kBase);
    packs.write("same.yaml", header("base.yaml"));
    CHECK(labels(packs.load("same.yaml"), two()) == Labels{"door", "window"});
    CHECK(packs.load("same.yaml").name() == "upper");
    packs.write("param.yaml", header("base.yaml") + "params: {low: {value: 0.2 m}}\n");
    CHECK(labels(packs.load("param.yaml"), two()) == Labels{"window", "window"});
    packs.write("rule.yaml", header("base.yaml") +
                                 "rules: [{id: w, label: window, require: base_height > 2 m}]\n");
    CHECK(labels(packs.load("rule.yaml"), two()) == Labels{"door", "-"});
    packs.write("added.yaml", header("base.yaml") +
                                  "classes: {bay: {}}\nrules: [{id: b, label: "
                                  "bay, require: base_height > 1 m, priority: 1}]\n"
                                  "emit: {bay: {type: BuildingInstallation}}\n");
    CHECK(labels(packs.load("added.yaml"), two()) == Labels{"door", "bay"});
    packs.write("removed.yaml", header("base.yaml") + "rules: [{id: d, remove: true}]\n");
    CHECK(labels(packs.load("removed.yaml"), two()) == Labels{"-", "window"});
  }

  TEST_CASE("invariants are replaced one by one") {
    const Packs packs;
    packs.write("base.yaml", kBase + "invariants: {eaves-m: 0.5, volume-pct: 5}\n");
    packs.write("same.yaml", header("base.yaml"));
    CHECK(packs.load("same.yaml").limits() == Limits{.volume_pct = 5, .eaves_m = 0.5});
    packs.write("upper.yaml", header("base.yaml") + "invariants: {eaves-m: 1, ridge-m: 2}\n");
    CHECK(packs.load("upper.yaml").limits() == Limits{.volume_pct = 5, .ridge_m = 2, .eaves_m = 1});
  }

  TEST_CASE("the range of a param holds for who overrides it") {
    const Packs packs;
    packs.write("base.yaml", kBase);
    packs.write("upper.yaml", header("base.yaml") + "params: {low: {value: 3 m}}\n");
    CHECK(packs.findings("upper.yaml") ==
          "upper.yaml:4:23: R212 the value is outside its range\n"
          "params: {low: {value: 3 m}}\n"
          "                      ^~~\n");
  }

  TEST_CASE("findings in a pack beneath show its own lines") {
    const Packs packs;
    packs.write("base.yaml", pack_with("rules: [{id: w, label: window, require: heigth > 1 m}]\n"));
    packs.write("upper.yaml", header("base.yaml"));
    CHECK(packs.findings("upper.yaml") ==
          "base.yaml:4:41: R204 unknown attribute 'heigth'; did you mean 'height'?\n"
          "rules: [{id: w, label: window, require: heigth > 1 m}]\n"
          "                                        ^~~~~~\n");
  }

  TEST_CASE("packs extend one another in a chain but not in a circle") {
    const Packs packs;
    packs.write("base.yaml", kBase);
    packs.write("middle.yaml", header("base.yaml") + "params: {low: {value: 0.2 m}}\n");
    packs.write("top.yaml", header("middle.yaml") + "rules: [{id: d, remove: true}]\n");
    CHECK(labels(packs.load("top.yaml"), two()) == Labels{"window", "window"});
    packs.write("base.yaml", header("top.yaml") + "rules: []\n");
    CHECK(packs.findings("top.yaml").find("base.yaml:3:10: R246 the pack extends itself") == 0);
    packs.write("itself.yaml", header("itself.yaml"));
    CHECK(packs.findings("itself.yaml").find("itself.yaml:3:10: R246") == 0);
  }

  TEST_CASE("a chain of packs has an end") {
    const Packs packs;
    packs.write("p0.yaml", kBase);
    for (int i = 1; i <= 9; ++i)
      packs.write(fmt::format("p{}.yaml", i), header(fmt::format("p{}.yaml", i - 1)));
    CHECK(packs.findings("p8.yaml").empty());
    CHECK(packs.findings("p9.yaml").find("R246 a pack has no more than 8 packs") !=
          std::string::npos);
  }

  TEST_CASE("nothing outside the folder of a pack is read") {
    const Packs inside, outside;
    outside.write("base.yaml", kBase);
    for (const std::string& name :
         {outside.path("base.yaml"), std::string("../base.yaml"), std::string("a/base.yaml"),
          std::string(".hidden"), std::string("a~b.yaml"), std::string("a|b.yaml"),
          std::string("\"\"")}) {
      inside.write("upper.yaml", header(name));
      CHECK(inside.findings("upper.yaml").find("upper.yaml:3:") == 0);
      CHECK(inside.findings("upper.yaml").find("R246 after 'extends'") != std::string::npos);
    }
    std::filesystem::create_symlink(outside.path("base.yaml"), inside.path("link.yaml"));
    inside.write("upper.yaml", header("link.yaml"));
    CHECK(inside.findings("upper.yaml").find("R200 there is no pack 'link.yaml'") !=
          std::string::npos);
    // A pack that came as text has no folder.
    CHECK(test::findings(header("base.yaml")).find("t.yaml:3:10: R200") == 0);
  }

  TEST_CASE("the default pack is extended by its name") {
    const RuleBase base =
        load(header("residential") + "params: {door_height: {value: 1.9 m, why: taller people}}\n");
    const auto residential = load_pack_file("residential");
    REQUIRE(residential.value);
    CHECK(base.labels() == residential.value->labels());
    CHECK(base.rule_count() == residential.value->rule_count());
    CHECK(base.codelists() == residential.value->codelists());
    CHECK(base.sha256() != residential.value->sha256());
    CHECK(base.sha256().size() == 64);
  }

  TEST_CASE("an id that stands twice above is found although it replaces one beneath") {
    const Packs packs;
    packs.write("base.yaml", kBase);
    packs.write("upper.yaml", header("base.yaml") +
                                  "rules:\n  - {id: d, label: door, require: natural}\n"
                                  "  - {id: d, label: door, require: natural}\n"
                                  "  - {id: x, remove: true}\n");
    CHECK(packs.findings("upper.yaml").find("upper.yaml:6:10: R240") != std::string::npos);
    CHECK(packs.findings("upper.yaml").find("upper.yaml:7:5: R246 no pack beneath has this id") !=
          std::string::npos);
  }
}
