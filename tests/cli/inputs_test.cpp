#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;

namespace {

namespace fs = std::filesystem;
using Words = std::vector<std::string>;

/// Every command that reads cities, with its outputs in a folder.
std::vector<Words> city_commands(const std::string& out) {
  return {{"segment", "--json"},
          {"label", "-o", out + "/labelled/"},
          {"generalise", "--scale", "1:1000", "-o", out + "/small/"},
          {"generalise", "--series", "1:500,1:2000", "-o", out + "/series"},
          {"repair", "-o", out + "/repaired/"},
          {"validate"},
          {"cat", "-o", out + "/cat.city.jsonl"},
          {"view", "-o", out + "/page.html"},
          {"score", "--surfaces"}};
}

Outcome run_on(Words command, const Words& inputs) {
  command.insert(command.begin() + 1, inputs.begin(), inputs.end());
  return run(command);
}

/// A folder with a city and what may lie beside one.
std::string mixed_folder(const Folder& folder) {
  const std::string city = folder / "city";
  fs::create_directories(city + "/deeper");
  folder.write("city/b.city.json", cubes({"b"}).dump());
  folder.write("city/a.json", cubes({"a"}).dump());
  folder.write("city/deeper/c.city.json", cubes({"c"}).dump());
  folder.write("city/house.truth.json", R"({"building": "a", "objects": []})");
  folder.write("city/parts.jsonl", R"({"building": "a", "id": "f"})");
  folder.write("city/notes.txt", "none");
  folder.write("city/out.gpkg", "SQLite format 3");
  return city;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a file given twice is read once and a warning names it and its other names") {
    const Folder folder;
    const std::string in = folder.write("in.city.json", cubes({"a"}).dump());
    const std::string link = folder / "link.city.json", hard = folder / "hard.city.json";
    fs::create_symlink(in, link);
    fs::create_hard_link(in, hard);
    const std::string dotted = folder / "./in.city.json";
    const std::string said = "warning: " + in + ": E602 is given ";
    for (const Words& command : city_commands(folder / "out")) {
      const Outcome outcome = run_on(command, {in, dotted});
      CAPTURE(command[0]);
      CAPTURE(outcome.err);
      CHECK(outcome.says(said + "twice, also as " + dotted + "; it is read once\n"));
      const int code = run_on(command, {in}).exit;
      CHECK(outcome.exit == code);
    }
    const Outcome often = run({"segment", "--json", in, link, hard, in});
    CHECK(often.says(said + "4 times, also as " + link + ", " + hard + "; it is read once\n"));
    CHECK(often.says("1 of 1 building segmented"));
    CHECK(lines_of(often.out).size() == 1);
    CHECK(run({"segment", "--json", in, in}).says(said + "twice; it is read once\n"));
  }

  TEST_CASE("a file given twice is one input and needs no folder for the output") {
    const Folder folder;
    const std::string in = folder.write("in.city.json", cubes({"a"}).dump());
    CHECK(run({"label", in, in, "-o", folder / "out.city.json"}).exit == 0);
    CHECK(folder.names() == Words{"in.city.json", "out.city.json"});
  }

  TEST_CASE("different files with the same bytes are read each") {
    const Folder folder;
    const std::string bytes = cubes({"a"}).dump();
    const Outcome outcome = run({"segment", "--json", folder.write("1.city.json", bytes),
                                 folder.write("2.city.json", bytes)});
    CHECK_FALSE(outcome.says("E602"));
    CHECK(outcome.says("2 of 2 buildings segmented"));
  }

  TEST_CASE("records and truths given twice are counted once") {
    const Folder folder;
    const std::string house = sample("house"), parts = folder / "parts.csv";
    const std::string truth = house.substr(0, house.find(".stripped")) + ".truth.json";
    REQUIRE(run({"label", house, "--features", parts}).exit == 0);
    const Outcome once = run({"score", parts, "--truth", truth});
    const Outcome twice = run({"score", parts, parts, "--truth", truth, "--truth", truth});
    CHECK(twice.out == once.out);
    CHECK(twice.exit == once.exit);
    CHECK(twice.says("warning: " + parts + ": E602 is given twice; it is read once\n"));
    CHECK(twice.says("warning: " + truth + ": E602 is given twice; it is read once\n"));
    const Outcome named = run({"interpret", parts, parts});
    CHECK(named.says("E602 is given twice"));
    CHECK(named.out == run({"interpret", parts}).out);
  }

  TEST_CASE("a folder means its files of buildings by name and not those in folders within it") {
    const Folder folder;
    const std::string city = mixed_folder(folder);
    const Words files{city + "/a.json", city + "/b.city.json"};
    for (const Words& command : city_commands(folder / "out")) {
      const Outcome of_folder = run_on(command, {city});
      const Outcome of_files = run_on(command, files);
      CAPTURE(command[0]);
      CAPTURE(of_folder.err);
      CHECK(of_folder.exit == of_files.exit);
      CHECK(of_folder.out == of_files.out);
      CHECK(of_folder.err == of_files.err);
    }
    CHECK(run({"label", city, "-o", folder / "labelled/"}).exit == 0);
    CHECK(fs::exists(folder / "labelled/a.city.json"));
    CHECK(fs::exists(folder / "labelled/b.city.json"));
    CHECK(run({"segment", "--json", city, "-v"})
              .says("note: " + city + ": E106 4 files in the folder hold no buildings"));
  }

  TEST_CASE("a folder and a file of it are read once") {
    const Folder folder;
    const std::string city = mixed_folder(folder);
    const Outcome outcome = run({"segment", "--json", city + "/b.city.json", city + "/"});
    CHECK(outcome.says("E602 is given twice"));
    CHECK(outcome.says("2 of 2 buildings segmented"));
  }

  TEST_CASE("of a folder only files of the format that --from names are read") {
    const Folder folder;
    const std::string city = mixed_folder(folder);
    REQUIRE(run({"label", sample("house"), "-o", city + "/house.obj"}).exit == 0);
    CHECK(run({"segment", city, "--from", "obj"}).says("1 of 1 building segmented"));
    CHECK(run({"segment", "--json", city}).says("3 of 3 buildings segmented"));
  }

  TEST_CASE("a folder without files of buildings is an unreadable input and the others are done") {
    const Folder folder;
    fs::create_directory(folder / "none");
    folder.write("none/notes.txt", "none");
    const std::string in = folder.write("in.city.json", cubes({"a"}).dump());
    for (const Words& command : city_commands(folder / "out")) {
      const Outcome outcome = run_on(command, {folder / "none"});
      CAPTURE(command[0]);
      CAPTURE(outcome.err);
      CHECK(outcome.exit == 5);
      CHECK(outcome.says("error: " + (folder / "none") +
                         ": E106 the folder has no file of buildings (folders within it are not "
                         "read); expected files in .city.json, .city.jsonl, .gml, .obj, .off, "
                         ".ply or .stl\n"));
    }
    const Outcome other = run({"segment", "--json", folder / "none", in});
    CHECK(other.exit == 5);
    CHECK(other.says("1 of 1 building segmented"));
    CHECK(run({"segment", folder / "none", "--from", "cityjson"}).says("E106"));
  }
}
