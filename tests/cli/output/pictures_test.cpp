#include "tests/cli/command.h"

#include <filesystem>
#include <iterator>
#include <string>
#include <utility>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;

namespace {

const std::string kHouse = sample("house");
const std::string kTruth = kHouse.substr(0, kHouse.find(".stripped")) + ".truth.json";

/// How often a text occurs in another one.
std::size_t count_in(const std::string& text, const std::string& what) {
  std::size_t count = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1))
    ++count;
  return count;
}

/// A file of one building whose solid lacks a face.
std::string without_a_face(const std::string& text) {
  auto model = nlohmann::json::parse(text);
  auto& shells = model["CityObjects"].begin().value()["geometry"][0]["boundaries"];
  shells[0].erase(0);
  return model.dump();
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a picture of a building is a file of the format that its name says") {
    const Folder folder;
    for (const auto& [name, begin] :
         {std::pair("a.png", "\x89PNG"), {"a.svg", "<?xml"}, {"a.pdf", "%PDF-"}}) {
      CAPTURE(name);
      const Outcome outcome = run({"view", kHouse, "-o", folder / name});
      CHECK(outcome.exit == 0);
      CHECK(outcome.says("1 of 1 building shown"));
      CHECK(bytes_of(folder / name).starts_with(begin));
    }
  }

  TEST_CASE("a picture of scales has a panel for each with what is drawn") {
    const Folder folder;
    REQUIRE(run({"view", kHouse, "--scales", "1:1000,1:5000", "-o", folder / "a.svg"}).exit == 0);
    const std::string svg = bytes_of(folder / "a.svg");
    CHECK(count_in(svg, "</text>") > 3);
    CHECK(svg.find(">1:1000: 18 openings<") != std::string::npos);
    CHECK(svg.find(">1:5000: 0 openings<") != std::string::npos);
  }

  TEST_CASE("what cannot be drawn at a scale is said and set aside") {
    const Folder folder;
    const std::string open = folder.write("open.city.json", without_a_face(bytes_of(kHouse)));
    const Outcome outcome =
        run({"view", open, "--close", "none", "--scales", "1:5000", "-o", folder / "a.svg"});
    CHECK(outcome.exit == 3);
    CHECK(outcome.says("G404"));
    CHECK(bytes_of(folder / "a.svg").find("1:5000: not drawn") != std::string::npos);
  }

  TEST_CASE("before and after stand beside each other and what differs is marked") {
    const Folder folder;
    REQUIRE(
        run({"generalise", kHouse, "--scale", "1:2500", "-o", folder / "small.city.json"}).exit ==
        0);
    const std::string mark = "#d00050";
    REQUIRE(
        run({"view", kHouse, "--after", folder / "small.city.json", "-o", folder / "a.svg"}).exit ==
        0);
    CHECK(count_in(bytes_of(folder / "a.svg"), mark) > 3);
    REQUIRE(run({"label", kHouse, "-o", folder / "same.city.json"}).exit == 0);
    REQUIRE(
        run({"view", kHouse, "--after", folder / "same.city.json", "-o", folder / "b.svg"}).exit ==
        0);
    CHECK(count_in(bytes_of(folder / "b.svg"), mark) == 0);
  }

  TEST_CASE("a picture of levels of detail says what was done for each") {
    const Folder folder;
    REQUIRE(run({"view", kHouse, "--to-lod", "2.0,1.0", "-o", folder / "a.svg"}).exit == 0);
    const std::string svg = bytes_of(folder / "a.svg");
    for (const char* text : {">LoD 2.0: 0 openings<", ">LoD 1.0: 0 openings<", ">omit "}) {
      CAPTURE(text);
      CHECK(svg.find(text) != std::string::npos);
    }
  }

  TEST_CASE("a picture of a feature shows it in its building and says why it is so called") {
    const Folder folder;
    REQUIRE(run({"view", kHouse, "--explain", "canopy 1", "-o", folder / "a.svg"}).exit == 0);
    const std::string svg = bytes_of(folder / "a.svg");
    for (const char* text : {">explained 1<", ">canopy: a ", "canopy.above_door"}) {
      CAPTURE(text);
      CHECK(svg.find(text) != std::string::npos);
    }
    CHECK(count_in(svg, "class=\"canopy\"") == 2);
    CHECK(run({"view", kHouse, "--explain", "window 1", "-o", folder / "b.svg"}).exit == 2);
    const Outcome unknown = run({"view", kHouse, "--explain", "cupola", "-o", folder / "b.svg"});
    CHECK(unknown.exit == 2);
    CHECK(unknown.says("no feature starts with 'cupola'"));
    CHECK(!std::filesystem::exists(folder / "b.svg"));
  }

  TEST_CASE("a picture marks what is right and wrong and missed by a truth") {
    const Folder folder;
    auto truth = nlohmann::json::parse(bytes_of(kTruth));
    REQUIRE(
        run({"view", kHouse, "--compare", kTruth, "--grid", "1x1", "-o", folder / "a.svg"}).exit ==
        0);
    CHECK(bytes_of(folder / "a.svg").find(">24 right, 0 wrong, 0 missed<") != std::string::npos);
    // This truth calls dormers bays and chimneys vents.
    for (auto& object : truth["objects"]) {
      if (object["class"] == "dormer") object["class"] = "bay";
      if (object["class"] == "chimney") object["class"] = "vent";
    }
    const std::string other = folder.write("other.truth.json", truth.dump());
    REQUIRE(
        run({"view", kHouse, "--compare", other, "--grid", "1x1", "-o", folder / "b.svg"}).exit ==
        0);
    CHECK(bytes_of(folder / "b.svg").find(">21 right, 3 wrong, 0 missed<") != std::string::npos);
    const Outcome some =
        run({"view", kHouse, sample("hip"), "--compare", other, "-o", folder / "c.svg"});
    CHECK(some.exit == 0);
    CHECK(some.says("compared with the truth: 21 right, 3 wrong, 0 missed"));
    CHECK(some.says("1 building is not in the truth"));
    const Outcome none = run({"view", sample("hip"), "--compare", other, "-o", folder / "d.svg"});
    CHECK(none.exit == 5);
    CHECK(none.says("E128"));
    CHECK(!std::filesystem::exists(folder / "d.svg"));
    const Outcome twice =
        run({"view", kHouse, "--compare", other, "--compare", kTruth, "-o", folder / "d.svg"});
    CHECK(twice.exit == 2);
    CHECK(twice.says("has two truths"));
    CHECK(run({"view", kHouse, "--compare", kHouse, "-o", folder / "c.svg"}).exit == 5);
  }

  TEST_CASE("objects of a truth that have no polygons are counted and said") {
    const Folder folder;
    auto truth = nlohmann::json::parse(bytes_of(kTruth));
    auto object = truth["objects"][0];
    object["id"] = "tower";
    object["class"] = "chimney";
    object["aabb"] = {100, 100, 0, 101, 101, 9};
    object.erase("feature_aabb");
    object["faces"] = {99999};
    truth["objects"].push_back(object);
    const std::string other = folder.write("other.truth.json", truth.dump());
    const Outcome outcome = run({"view", kHouse, "--compare", other, "-o", folder / "a.svg"});
    CHECK(outcome.exit == 0);
    CHECK(outcome.says("24 right, 0 wrong, 1 missed (1 of them without polygons)"));
    CHECK(bytes_of(folder / "a.svg").find(">missed ") == std::string::npos);
  }

  TEST_CASE("a PDF has a page for each sheet so that no building is left out") {
    const Folder folder;
    const Outcome outcome = run(
        {"view", kHouse, sample("row"), sample("hip"), "--grid", "2x1", "-o", folder / "a.pdf"});
    CHECK(outcome.exit == 0);
    CHECK(!outcome.says("no room"));
    CHECK(count_in(bytes_of(folder / "a.pdf"), "/Type /Page %") == 2);
  }

  TEST_CASE("a sheet has a panel for each building and says for how many there is no room") {
    const Folder folder;
    const std::string row = sample("row"), hip = sample("hip");
    const Outcome outcome =
        run({"view", kHouse, row, hip, "--grid", "2x1", "-o", folder / "a.svg"});
    CHECK(outcome.exit == 0);
    CHECK(outcome.says("--grid 2x1 has no room for 1 more building"));
    CHECK(count_in(bytes_of(folder / "a.svg"), "text-anchor=\"middle\"") == 2);
  }

  TEST_CASE("buildings that lie too far apart for one picture are refused and fit a sheet") {
    const Folder folder;
    const std::string far = sample("house-utm");
    const Outcome outcome = run({"view", kHouse, far, "-o", folder / "a.png"});
    CHECK(outcome.exit == 5);
    CHECK(outcome.says("E163"));
    CHECK(run({"view", kHouse, far, "--grid", "2x1", "-o", folder / "a.png"}).exit == 0);
  }

  TEST_CASE("a failed test of rules writes a picture with what it expected otherwise marked") {
    const Folder folder;
    folder.write("house.city.json", bytes_of(kHouse));
    const std::string given = "given: {building: house.city.json}, expect: ";
    const std::string tests =
        folder.write("r.test.yaml",
                     "tests_for: residential\n"
                     "fixtures: {hand: {features: {d: {a: 2 m}}}}\n"
                     "tests:\n"
                     "  - {name: right, " +
                         given +
                         "{counts: {window: 16}}}\n"
                         "  - {name: 'one / door', " +
                         given +
                         "{counts: {door: 1}}}\n"
                         "  - {name: one - door, " +
                         given +
                         "{counts: {door: 3}}}\n"
                         "  - {name: by hand, given: hand, expect: {d: door}}\n");
    const Outcome outcome = run({"rules", "test", tests, "--pictures", folder / "p/q"});
    CHECK(outcome.exit == 4);
    CHECK(outcome.out.find(":5:5: picture: one / door: " + folder / "p/q/r-one-door.svg") !=
          std::string::npos);
    CHECK(outcome.out.find(":7:5: no picture: by hand: ") != std::string::npos);
    CHECK(std::distance(std::filesystem::directory_iterator(folder / "p/q"), {}) == 2);
    const std::string both = bytes_of(folder / "p/q/r-one-door.svg");
    const std::string none = bytes_of(folder / "p/q/r-one-door-2.svg");
    CHECK(both.find(">one / door: 2 features labelled door, expected 1<") != std::string::npos);
    const std::string mark = "#d00050";
    CHECK(count_in(both, mark) > 0);  // one of the two doors is too many
    CHECK(count_in(none, mark) == 0);
    REQUIRE(run({"rules", "test", tests, "--pictures", folder / "again"}).exit == 4);
    CHECK(bytes_of(folder / "again/r-one-door.svg") == both);
  }

  TEST_CASE("tests of rules that pass write no picture and a folder that is a file is an error") {
    const Folder folder;
    folder.write("house.city.json", bytes_of(kHouse));
    const auto test_of = [&](const char* doors) {
      return folder.write("r.test.yaml",
                          "tests_for: residential\ntests:\n  - {name: doors, given: {building: "
                          "house.city.json}, expect: {counts: {door: " +
                              std::string(doors) + "}}}\n");
    };
    CHECK(run({"rules", "test", test_of("2"), "--pictures", folder / "p"}).exit == 0);
    CHECK_FALSE(std::filesystem::exists(folder / "p"));
    const std::string file = folder.write("file", "");
    const Outcome outcome = run({"rules", "test", test_of("1"), "--pictures", file});
    CHECK(outcome.exit == 6);
    CHECK(outcome.says("E601"));
  }
}
