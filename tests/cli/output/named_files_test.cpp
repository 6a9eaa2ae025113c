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

/// Nothing was read or written: the folder is as it was.
void check_refused(const Folder& folder, const Words& arguments) {
  std::vector<std::string> before;
  for (const std::string& name : folder.names()) before.push_back(name + bytes_of(folder / name));
  const Outcome outcome = run(arguments);
  CAPTURE(arguments);
  CAPTURE(outcome.err);
  CHECK(outcome.exit == 2);
  CHECK(outcome.says("E602"));
  std::vector<std::string> after;
  for (const std::string& name : folder.names()) after.push_back(name + bytes_of(folder / name));
  CHECK(after == before);
}

TEST_SUITE("cli") {
  TEST_CASE("two outputs of one file are wrong usage in every command") {
    const Folder folder;
    const std::string in = folder.write("in.city.json", cubes({"a"}).dump());
    const std::string lines = folder.write("in.city.jsonl", cube_lines({"a"}));
    const std::string parts = folder.write("parts.csv", "building,id\n");
    const std::string truth = folder.write("a.truth.json", "{}");
    const std::string x = folder / "x.city.json", csv = folder / "x.csv", json = folder / "x.json";
    for (const Words& arguments : std::vector<Words>{
             {"segment", in, "-o", csv, "--features", csv},
             {"segment", in, "--features", json, "--timings", json},
             {"label", in, "-o", x, "--features", x},
             {"label", in, "-o", x, "--timings", x},
             {"label", in, "-o", folder / "y.city.json", "--table", "energy=" + csv, "--table",
              "envelope=" + csv},
             {"label", in, "--table", "energy", "--timings", "-"},
             {"label", in, "-o", "-", "--timings", "-"},
             {"label", in, "-o", folder / "s.status.json", "--to", "cityjson", "--status",
              folder / "s"},
             {"label", in, "-o", folder / "out/", "--features", folder / "out/in.city.json"},
             {"generalise", in, "--scale", "1:500", "-o", x, "--explain", x},
             {"generalise", in, "--scale", "1:500", "-o", x, "--metrics", x},
             {"generalise", in, "--scale", "1:500", "-o", x, "--explain", json, "--metrics", json},
             {"generalise", in, "--series", "1:500", "-o", folder / "s", "--timings",
              folder / "s.1-500.city.json"},
             {"generalise", in, "--series", "1:500", "-o", folder / "s", "--features",
              folder / "s.oplog.jsonl"},
             {"repair", in, "-o", x, "--report", x},
             {"view", in, "-o", x, "--timings", x},
             {"cat", in, "-o", x + "l", "--timings", x + "l"},
             {"collect", lines, "-o", x, "--timings", x},
             {"split", lines, "--count", "1", "-o", folder / "d", "--timings",
              folder / "d/split.json"},
             {"score", parts, "--truth", truth, "--per-building", csv, "--curve", csv}})
      check_refused(folder, arguments);
  }

  TEST_CASE("an output that is an input is wrong usage in every command") {
    const Folder folder;
    const std::string in = folder.write("in.city.json", cubes({"a"}).dump());
    const std::string lines = folder.write("000000.city.jsonl", cube_lines({"a"}));
    const std::string level = folder.write("s.1-500.city.json", cubes({"a"}).dump());
    const std::string parts = folder.write("parts.csv", "building,id\n");
    const std::string truth = folder.write("a.truth.json", "{}");
    const std::string pack = folder.write("p.yaml", "pack: x\n");
    folder.write("s.oplog.jsonl", "{}\n");
    for (const Words& arguments :
         std::vector<Words>{{"segment", in, "-o", in},
                            {"label", in, "-o", in},
                            {"label", in, "-o", folder.path().string() + "/"},
                            {"label", in, "--timings", in},
                            {"label", "-", "-o", in, "--to", "cityjsonseq"},
                            {"generalise", in, "--scale", "1:500", "-o", in},
                            {"generalise", level, "--series", "1:500", "-o", folder / "s"},
                            {"generalise", "--at", "1:600", "--from", folder / "s", "-o", level},
                            {"repair", in, "-o", in},
                            {"repair", in, "-o", folder / "x.city.json", "--report", in},
                            {"explain", in, "f", "--timings", in},
                            {"view", in, "-o", in},
                            {"view", in, "--after", level, "-o", level},
                            {"validate", in, "-o", in},
                            {"cat", lines, "-o", lines},
                            {"collect", lines, "-o", lines},
                            {"split", lines, "--count", "1", "-o", folder.path().string()},
                            {"merge", lines, "--split", in, "-o", lines},
                            {"merge", lines, "--split", in, "-o", in},
                            {"interpret", parts, "-o", parts},
                            {"score", parts, "--truth", truth, "--curve", truth},
                            {"score", parts, "--truth", truth, "--per-building", parts},
                            {"rules", "test", pack, "--junit", pack}}) {
      if (arguments[1] != "-") {
        check_refused(folder, arguments);
        continue;
      }
      const Outcome outcome = run(arguments, {.in = cube_lines({"a"})});
      CHECK(outcome.exit != 2);  // a pipe is no file
      folder.write("in.city.json", cubes({"a"}).dump());
    }
  }

  TEST_CASE("with force an input is replaced by the whole output") {
    const std::string before = cubes({"a"}).dump();
    for (const Words& words : std::vector<Words>{
             {"label"}, {"generalise", "--scale", "1:500"}, {"repair"}, {"label", "--jobs", "2"}}) {
      const Folder folder;
      const std::string in = folder.write("in.city.json", before);
      Words arguments = words;
      for (const char* word : {"IN", "-o", "IN"}) arguments.emplace_back(word);
      for (std::string& word : arguments)
        if (word == "IN") word = in;
      const Outcome refused = run(arguments);
      CHECK(refused.exit == 2);
      CHECK(refused.says("-o: E602 '" + in + "' is an input, which would be overwritten; name " +
                         "another file, or replace it with --force"));
      CHECK(bytes_of(in) == before);
      arguments.emplace_back("--force");
      const Outcome outcome = run(arguments);
      CAPTURE(outcome.err);
      CHECK(outcome.exit == 0);
      CHECK(bytes_of(in) != before);
      CHECK(folder.names() == Words{"in.city.json"});
    }
  }

  TEST_CASE("with force an input stays where the output is not whole") {
    const Folder folder;
    const std::string lines = cube_lines({"a", "b"}) + "{\"broken\n";
    const std::string in = folder.write("in.city.jsonl", lines);
    const Outcome outcome = run({"label", in, "-o", in, "--force"});
    CAPTURE(outcome.err);
    CHECK(outcome.exit == 6);
    CHECK(outcome.says("1 record could not be read and would be lost by --force"));
    CHECK(bytes_of(in) == lines);
    CHECK(run({"label", in, "-o", in, "--force"}, {.file_limit = 1}).exit == 6);
    CHECK(bytes_of(in) == lines);
  }

  TEST_CASE("force replaces no stream by some of its records") {
    const Words selections[] = {{"--id", "a"},
                                {"--bbox", "0,0,1,1"},
                                {"--cotype", "Building"},
                                {"--random", "2"},
                                {"--id", "a", "--exclude"}};
    for (const Words& words :
         std::vector<Words>{{"label"}, {"generalise", "--scale", "1:500"}, {"repair"}})
      for (const Words& selection : selections) {
        const Folder folder;
        const std::string in = folder.write("in.city.jsonl", cube_lines({"a", "b"}));
        Words arguments = words;
        for (const std::string& word : {in, std::string("-o"), in, std::string("--force")})
          arguments.push_back(word);
        arguments.insert(arguments.end(), selection.begin(), selection.end());
        check_refused(folder, arguments);
        CHECK(run(arguments).says(
            "-o: E602 '" + in +
            "' is an input, which would be overwritten: only the records that " +
            "--id, --bbox, --cotype, --random and --exclude select would be kept; name another " +
            "file"));
      }
  }

  TEST_CASE("with force a file of which one building is selected keeps the others") {
    for (const Words& words :
         std::vector<Words>{{"label"}, {"generalise", "--to-lod", "1.2"}, {"repair"}}) {
      const Folder folder;
      const std::string in = folder.write("in.city.json", cubes({"a", "b"}).dump());
      const nlohmann::json whole = cubes({"a", "b"})["CityObjects"]["b"];
      Words arguments = words;
      for (const std::string& word : {in, std::string("-o"), in, std::string("--force"),
                                      std::string("--id"), std::string("a")})
        arguments.push_back(word);
      CHECK(run(arguments).exit == 0);
      CHECK(nlohmann::json::parse(bytes_of(in))["CityObjects"]["b"] == whole);
    }
  }

  TEST_CASE("force replaces no input by another format nor a mesh nor a series") {
    const Folder folder;
    const std::string city = folder.write("in.city.json", cubes({"a"}).dump());
    const std::string level = folder.write("s.1-500.city.json", cubes({"a"}).dump());
    const std::string mesh = folder.write("in.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    check_refused(folder, {"label", city, "-o", city, "--to", "obj", "--force"});
    check_refused(folder, {"repair", mesh, "-o", mesh, "--force"});
    check_refused(folder,
                  {"generalise", "--series", "1:500", level, "-o", folder / "s", "--force"});
    CHECK(run({"label", mesh, "-o", mesh, "--force"})
              .says("overwritten: obj would keep only what oriel reads of it; name another file"));
  }

  TEST_CASE("with force a record that cannot be read does not keep another file from being there") {
    const Folder folder;
    const std::string in = folder.write("in.city.jsonl", cube_lines({"a"}) + "{\"broken\n");
    CHECK(run({"label", in, "-o", folder / "out.city.jsonl", "--force"}).exit == 3);
    CHECK(lines_of(bytes_of(folder / "out.city.jsonl")).size() == 2);
  }

  TEST_CASE("force replaces no rules and no file by what is said about it") {
    const Folder folder;
    const std::string in = folder.write("in.city.json", cubes({"a"}).dump());
    check_refused(folder, {"label", in, "-o", folder / "x.city.json", "--timings", in, "--force"});
    const std::string pack =
        folder.write("p.yaml",
                     "schema: oriel/1\npack: {name: t, version: 1.0.0}\nclasses: {window: {}}\n"
                     "rules: [{id: w, label: window, require: natural}]\n");
    check_refused(folder,
                  {"label", in, "--rules", pack, "-o", pack, "--to", "cityjson", "--force"});
  }

  TEST_CASE("other spellings links and hard links are the same file") {
    const Folder folder;
    const std::string in = folder.write("in.city.json", cubes({"a"}).dump());
    fs::create_symlink(in, folder / "link.city.json");
    fs::create_hard_link(in, folder / "hard.city.json");
    fs::create_directory(folder / "d");
    fs::create_directory_symlink(folder.path(), folder / "again");
    for (const std::string name : {"link.city.json", "hard.city.json", "d/../in.city.json",
                                   "./in.city.json", "again/in.city.json"})
      check_refused(folder, {"label", in, "-o", folder / name});
    check_refused(folder, {"label", in, "-o", folder / "x.city.json", "--timings",
                           folder / "again/x.city.json"});
  }

  TEST_CASE("what is no regular file may be named twice") {
    const Folder folder;
    const std::string in = folder.write("in.city.json", cubes({"a"}).dump());
    CHECK(
        run({"label", in, "-o", "/dev/null", "--to", "cityjson", "--timings", "/dev/null"}).exit ==
        0);
  }
}

}  // namespace
