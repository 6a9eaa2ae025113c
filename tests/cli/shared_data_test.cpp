#include "tests/cli/command.h"
#include "tests/support/corpus.h"
#include "tests/support/shared.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace fs = std::filesystem;

namespace {

std::vector<std::string> stripped_files(const fs::path& folder) {
  std::vector<std::string> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.path().string().ends_with(".stripped.city.json")) files.push_back(entry.path());
  std::ranges::sort(files);
  return files;
}

/// Lines that begin with "error: ".
long errors_in(const std::string& text) {
  std::istringstream lines(text);
  long count = 0;
  for (std::string line; std::getline(lines, line);) count += line.starts_with("error: ") ? 1 : 0;
  return count;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("every file of the shared data is labelled or set aside with a reason") {
    ORIEL_NEEDS_SHARED(shared);
    // A call a folder: a start of the program takes as long as a house.
    std::map<fs::path, std::vector<std::string>> folders;
    for (const std::string& file : stripped_files(shared / "data"))
      folders[fs::path(file).parent_path()].push_back(file);
    REQUIRE(folders.size() > 9);
    for (const auto& [name, files] : folders) {
      CAPTURE(name);
      const Folder out;
      std::vector<std::string> arguments{"label", "-o", out / ""};
      arguments.insert(arguments.end(), files.begin(), files.end());
      const Outcome outcome = run(arguments);
      const long rejected = errors_in(outcome.err);
      CHECK(outcome.exit == (rejected > 0 ? 3 : 0));
      // One building a file: set aside or not.
      const long all = static_cast<long>(files.size());
      CHECK(outcome.says(
          fmt::format("{} of {} building{} labelled", all - rejected, all, all == 1 ? "" : "s")));
      CHECK(outcome.says(fmt::format("; {} rejected", rejected)) == (rejected > 0));
      for (const std::string& file : files) {
        CAPTURE(file);
        std::ifstream written(out / fs::path(file).filename().string());
        CHECK(json::accept(written));
      }
    }
  }

  TEST_CASE("slow: most published buildings become solids and levels") {
    ORIEL_NEEDS_SHARED(shared);
    const Folder folder;
    const auto done_by = [&](std::vector<std::string> arguments,
                             const std::vector<std::string>& inputs) {
      arguments.insert(arguments.end(), inputs.begin(), inputs.end());
      const Outcome outcome = run(arguments);
      const std::vector<std::string> lines = lines_of(outcome.err);
      REQUIRE(!lines.empty());
      CAPTURE(lines.back());
      return std::stoi(lines.back());  // "799 of 853 buildings closed ..."
    };
    // Issue 29, finding 10.
    CHECK(done_by({"repair", "-o", folder / "delfshaven.city.json"},
                  {shared / "data/delfshaven/delfshaven.city.json"}) >= 740);
    const auto surveyed =
        oriel::test::files_in(shared / "data" / "ingolstadt", ".stripped.city.json");
    CHECK(done_by({"generalise", "--scale", "1:1000", "-o", folder / "surveyed/"}, surveyed) >= 17);
  }

  TEST_CASE("buildings that made label run for ever or crash are labelled or set aside") {
    ORIEL_NEEDS_SHARED(shared);
    for (const char* name : {"hang-insets-real.city.jsonl", "hang-insets.city.jsonl",
                             "hang-noise-5mm.stripped.city.json", "crash-ground-facet.city.jsonl",
                             "crash-conformance-file.city.json"}) {
      CAPTURE(name);
      const Outcome outcome = run({"label", shared / "data/faults" / name});
      CHECK((outcome.exit == 0 || outcome.exit == 3));
      CHECK(outcome.says(" of 1 building"));
    }
  }

  TEST_CASE("a door is found level with the floor of its loggia as well as behind a threshold") {
    ORIEL_NEEDS_SHARED(shared);
    for (const char* name : {"mini_level.city.json", "mini_threshold.city.json"}) {
      CAPTURE(name);
      CHECK(run({"label", shared / "data/faults" / name}).says(": 1 door, 1 loggia"));
    }
  }

  TEST_CASE("a block keeps its walls and windows where a closed hole would cost them") {
    ORIEL_NEEDS_SHARED(shared);
    const std::string block = shared / "data/delft-blocks/yitong_4.stripped.city.json";
    const Outcome outcome = run({"label", block});
    CHECK(outcome.exit == 0);
    CHECK(outcome.says("can be seen from outside"));
    CHECK(outcome.says(" window"));
    CHECK_FALSE(outcome.says("E310"));
  }

  TEST_CASE("a district of which every hole is closed is segmented to the end") {
    ORIEL_NEEDS_SHARED(shared);
    const std::string district = shared / "data/delfshaven/delfshaven.city.json";
    const Outcome outcome = run({"label", district, "--close", "any"});
    CHECK(outcome.says("853 of 853 buildings labelled"));
  }

  TEST_CASE("the houses of random3dcity are all segmented and labelled as the truth says") {
    ORIEL_NEEDS_SHARED(shared);
    const Folder folder;
    const std::string data = shared / "data/random3dcity";
    std::vector<std::string> arguments{"label", "--features", folder / "parts.jsonl"};
    for (const std::string& file : stripped_files(data)) arguments.push_back(file);
    REQUIRE(arguments.size() == 3 + 76);
    const Outcome outcome = run(arguments);
    CHECK(outcome.exit == 0);
    CHECK(outcome.says("76 of 76 buildings labelled"));
    const Outcome scored = run({"score", folder / "parts.jsonl", "--truth", data, "--json"});
    REQUIRE(scored.exit == 0);
    const json classes = json::parse(scored.out)["classes"];
    CHECK(classes["window"]["f1"].get<double>() >= 0.97);
    CHECK(classes["door"]["f1"].get<double>() >= 0.95);
    CHECK(classes["chimney"]["f1"].get<double>() >= 0.90);
    CHECK(classes["dormer"]["f1"].get<double>() >= 0.80);
  }

  TEST_CASE("openings of the surveyed buildings are named whether the building is closed or not") {
    ORIEL_NEEDS_SHARED(shared);
    const Folder folder;
    const std::string data = shared / "data/ingolstadt";
    std::vector<std::string> arguments{"label", "--features", folder / "parts.jsonl"};
    for (const std::string& file : stripped_files(data)) arguments.push_back(file);
    REQUIRE(arguments.size() == 3 + 19);
    const Outcome outcome = run(arguments);
    CHECK(outcome.exit == 0);
    CHECK(outcome.says("19 of 19 buildings labelled"));
    const Outcome scored = run({"score", folder / "parts.jsonl", "--truth", data, "--json"});
    REQUIRE(scored.exit == 0);
    const json classes = json::parse(scored.out)["classes"];
    CHECK(classes["window"]["recall"].get<double>() >= 0.96);
    CHECK(classes["window"]["precision"].get<double>() >= 0.92);
    CHECK(classes["door"]["f1"].get<double>() >= 0.70);
  }

  TEST_CASE("a tile of the 3DBAG is segmented and the rest has reasons") {
    ORIEL_NEEDS_SHARED(shared);
    const Folder folder;
    const std::string tile = shared / "data/3dbag/tile_5910.city.jsonl";
    const Outcome outcome = run({"label", tile, "--lod", "2.2", "-o", folder / "out.city.jsonl"});
    CHECK(outcome.exit == 3);
    CHECK(outcome.says("211 of 212 buildings labelled"));
    CHECK(outcome.says("; 1 rejected ("));
    CHECK(errors_in(outcome.err) == 1);
    const std::string out = bytes_of(folder / "out.city.jsonl"), in = bytes_of(tile);
    CHECK(std::ranges::count(out, '\n') == std::ranges::count(in, '\n'));
    CHECK(folder.names() == std::vector<std::string>{"out.city.jsonl"});
  }
}
