#include "tests/cli/command.h"
#include "tests/cli/cubes.h"
#include "tests/support/shared.h"

#include <algorithm>
#include <filesystem>
#include <random>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

using Names = std::vector<std::string>;

/// Cubes with one that is no solid and one line that is cut off.
std::string city() {
  Names ids;
  for (int i = 0; i < 40; ++i) ids.push_back(fmt::format("cube-{}", i));
  const std::string lines = cube_lines(ids);
  const auto at = lines.find("\"cube-17\"");
  return lines.substr(0, at) + '\n' + lines.substr(lines.find('\n', at) + 1);
}

std::string split(const Folder& folder, const std::string& input, const Names& how) {
  Names arguments{"split", input, "-o", folder / "shards/"};
  arguments.insert(arguments.end(), how.begin(), how.end());
  CHECK(run(arguments).exit == 3);
  return folder / "shards/split.json";
}

Names shard_names(const std::string& list) {
  Names names;
  const json shards = json::parse(bytes_of(list))["shards"];
  for (const json& shard : shards) names.push_back(shard["name"]);
  return names;
}

/// Labels every shard, in the order given; returns the labelled files in that order.
Names label(const Folder& folder, const Names& names, const std::string& jobs) {
  Names files;
  for (const std::string& name : names) {
    files.push_back(folder / ("done-" + name + "/" + name + ".city.jsonl"));
    std::filesystem::create_directory(folder / ("done-" + name));
    const Outcome outcome =
        run({"label", folder / ("shards/" + name + ".city.jsonl"), "-o", files.back(), "--status",
             folder / ("done-" + name + "/" + name), "-j", jobs});
    CHECK(outcome.exit == 0);
  }
  return files;
}

Outcome merge(const Names& files, const std::string& list, const std::string& out) {
  Names arguments{"merge", "--split", list, "-o", out};
  arguments.insert(arguments.end(), files.begin(), files.end());
  return run(arguments);
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("one hash comes of any number of jobs and size and order of shards") {
    const Folder whole;
    const std::string input = whole.write("in.city.jsonl", city());
    REQUIRE(run({"label", input, "-o", whole / "out.city.jsonl"}).exit == 3);
    const std::string expected = bytes_of(whole / "out.city.jsonl");
    std::mt19937 random(7);
    for (const Names& how :
         {Names{"--count", "7"}, Names{"--count", "16"}, Names{"--bytes", "3000"}})
      for (const std::string jobs : {"1", "2", "4", "8"}) {
        CAPTURE(how[1]);
        CAPTURE(jobs);
        const Folder folder;
        const std::string list = split(folder, input, how);
        Names names = shard_names(list);
        CHECK(names.size() > 2);
        std::ranges::shuffle(names, random);
        Names files = label(folder, names, jobs);
        for (int order = 0; order < 3; ++order) {
          std::ranges::shuffle(files, random);
          const Outcome merged = merge(files, list, folder / "out.city.jsonl");
          CAPTURE(merged.err);
          CHECK(merged.exit == 0);
          CHECK((bytes_of(folder / "out.city.jsonl") == expected));
        }
      }
  }

  TEST_CASE("shards of a grid hold what lies in one cell and all that there is") {
    const Folder folder;
    const std::string list =
        split(folder, folder.write("in.city.jsonl", city()), {"--grid", "100"});
    const Names names = shard_names(list);
    CHECK(names.size() == 1);  // cube_lines puts every cube at the same place
    const Folder apart;
    std::string b = cube_lines({"b"});
    for (auto at = b.find("[4000,"); at != std::string::npos; at = b.find("[4000,", at + 1))
      b.replace(at, 6, "[500000,");  // 500 m wide: its middle is in another cell
    b.erase(0, b.find('\n') + 1);
    const std::string lines = cube_lines({"a", "c"}) + b;
    const std::string input = apart.write("in.city.jsonl", lines);
    CHECK(run({"split", input, "-o", apart / "s", "--grid", "100"}).exit == 0);
    const json cells = json::parse(bytes_of(apart / "s/split.json"));
    REQUIRE(cells["shards"].size() == 2);
    CHECK(cells["shards"][0]["features"] == 2);
    CHECK(bytes_of(apart / "s/000001.city.jsonl").find("\"id\":\"b\"") != std::string::npos);
    CHECK(cells["features"] == 3);
  }

  TEST_CASE("merge says what is missing or strange or twice there") {
    const Folder folder;
    const std::string list =
        split(folder, folder.write("in.city.jsonl", city()), {"--count", "10"});
    const Names files = label(folder, shard_names(list), "1");
    const std::string out = folder / "out.city.jsonl";
    Outcome outcome = merge({files[0], files[2], files[3]}, list, out);
    CHECK(outcome.exit == 5);
    CHECK(outcome.says("E118 shard 000001 is missing"));
    auto twice = files;
    twice.push_back(folder / "shards/000002.city.jsonl");
    CHECK(merge(twice, list, out).says("E118 is the same shard as"));
    twice.back() = sample("hip");
    CHECK(merge(twice, list, out).says("E118 is not a shard of"));
    CHECK(!std::filesystem::exists(out));
  }

  TEST_CASE("merge checks hashes and counts") {
    const Folder folder;
    const std::string list =
        split(folder, folder.write("in.city.jsonl", city()), {"--count", "10"});
    const Names names = shard_names(list), files = label(folder, names, "1");
    const std::string out = folder / "out.city.jsonl", text = bytes_of(files[1]);
    const auto put = [&](const std::string& bytes) {
      folder.write("done-" + names[1] + "/" + names[1] + ".city.jsonl", bytes);
      return merge(files, list, out);
    };
    CHECK(put(replaced(text, "cube-", "cubf-")).says("is not the output that 000001.status.json"));
    CHECK(put(text.substr(0, text.size() - 5)).says("E118 ends within a line"));
    std::filesystem::remove(folder / ("done-" + names[1] + "/" + names[1] + ".status.json"));
    const std::string shorter = text.substr(0, text.rfind('\n', text.size() - 2) + 1);
    CHECK(put(shorter).says("has 10 lines; shard 000001 has 11"));
    CHECK(!std::filesystem::exists(out));
    CHECK(put(text).exit == 0);
  }

  TEST_CASE("merge without status files refuses the copy of another shard") {
    const Folder folder;
    const std::string list =
        split(folder, folder.write("in.city.jsonl", city()), {"--count", "10"});
    const std::string out = folder / "out.city.jsonl", stem = folder / "shards/00000";
    const auto merged = [&] {
      Names files;
      for (const char* number : {"0", "1", "2", "3"})
        files.push_back(stem + number + ".city.jsonl");
      return merge(files, list, out);
    };
    CHECK(merged().exit == 0);
    const std::string second = bytes_of(stem + "1.city.jsonl");
    std::filesystem::copy_file(stem + "0.city.jsonl", stem + "1.city.jsonl",
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::remove(out);
    const Outcome twice = merged();
    CHECK(twice.exit == 5);
    CHECK(twice.says("shards/000001.city.jsonl: E118 has other features than shard 000001"));
    CHECK(twice.says("shards/000001.city.jsonl:2: cube-0: E207 an earlier line has this id"));
    // The same features in another order are not the shard either.
    auto lines = lines_of(second);
    std::swap(lines[1], lines[2]);
    folder.write("shards/000001.city.jsonl", fmt::format("{}\n", fmt::join(lines, "\n")));
    CHECK(merged().says("E118 has other features than shard 000001, or another order"));
    CHECK_FALSE(std::filesystem::exists(out));
    folder.write("shards/000001.city.jsonl", second);
    CHECK(merged().exit == 0);
    folder.write("shards/split.json",
                 replaced(bytes_of(list), "\"features\": 10", "\"features\": -1"));
    CHECK(merged().says("split.json: E118 is not a list of shards: a count is -1"));
  }

  TEST_CASE("merge names a status file that is damaged whatever is damaged in it") {
    const Folder folder;
    const std::string list =
        split(folder, folder.write("in.city.jsonl", city()), {"--count", "40"});
    const Names files = label(folder, shard_names(list), "1");
    const std::string out = folder / "out.city.jsonl", name = "done-000000/000000.status.json";
    const std::string text = bytes_of(folder / name);
    const json status = json::parse(text);
    std::vector<std::string> damaged{"",         "[]",         "5", text.substr(0, text.size() / 2),
                                     text + "}", "\xff" + text};
    std::set<std::string> places;
    const json members = status.flatten();
    for (const auto& [pointer, value] : members.items())
      for (json::json_pointer at(pointer); !at.empty(); at.pop_back())
        if (!pointer.starts_with("/features")) places.insert(at.to_string());
    for (const std::string& place : places)
      for (const json& other : {json(), json(-1), json{{"a", 0.5}}}) {
        json changed = status;
        changed[json::json_pointer(place)] = other;
        damaged.push_back(changed.dump());
      }
    int named = 0;
    for (const std::string& bytes : damaged) {
      CAPTURE(bytes);
      folder.write(name, bytes);
      const Outcome outcome = merge(files, list, out);
      // What merge does not read may be anything.
      CHECK((outcome.exit == 0 || outcome.exit == 5));
      CHECK_FALSE(outcome.says("E901"));
      named += outcome.says("000000.status.json") ? 1 : 0;
    }
    CHECK(named > 30);
  }

  TEST_CASE("merge names the damaged status file of the shared cases") {
    ORIEL_NEEDS_SHARED(shared);
    const Folder folder;
    const std::string list =
        split(folder, folder.write("in.city.jsonl", city()), {"--count", "40"});
    const Names files = label(folder, shard_names(list), "1");
    folder.write("done-000000/000000.status.json",
                 bytes_of(shared / "data/cases/bounds/merge-e901.status.json"));
    const Outcome outcome = merge(files, list, folder / "out.city.jsonl");
    CHECK(outcome.exit == 5);
    CHECK(outcome.says(
        "000000.status.json: E202 is not a status that oriel wrote: key 'input_sha256' not found"));
  }

  TEST_CASE("merge follows the hashes through the stages") {
    const Folder folder;
    const std::string list =
        split(folder, folder.write("in.city.jsonl", city()), {"--count", "20"});
    const Names names = shard_names(list), labelled = label(folder, names, "1");
    Names arguments{"merge", "--split", list, "-o", folder / "out.city.jsonl"}, redrawn;
    for (std::size_t i = 0; i < names.size(); ++i) {
      const std::string stem = folder / names[i];
      REQUIRE(run({"generalise", labelled[i], "--scale", "1:5000", "-o", stem + ".city.jsonl",
                   "--status", stem})
                  .exit == 0);
      arguments.push_back(stem + ".city.jsonl");
    }
    CHECK(run(arguments).says("was not made from shard 000000"));
    for (const std::string& name : names)
      arguments.insert(arguments.end(), {"--through", folder / ("done-" + name)});
    const Outcome outcome = run(arguments);
    CAPTURE(outcome.err);
    CHECK(outcome.exit == 0);
  }
}
