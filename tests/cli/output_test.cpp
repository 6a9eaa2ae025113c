#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <unistd.h>

#include <doctest/doctest.h>
#include <fmt/format.h>

using namespace oriel::test;

namespace {

using Names = std::vector<std::string>;

/// What the command says when it cannot write: exit 6 and the reason, nothing left over.
void check_unwritable(const Folder& folder, const Outcome& outcome, const std::string& message) {
  CAPTURE(outcome.err);
  CHECK(outcome.exit == 6);
  CHECK(outcome.says(message));
  for (const std::string& name : folder.names()) CHECK(name.find(".tmp-") == std::string::npos);
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("what a full disk takes of a printed pack is never called a success") {
    const Outcome shown = run({"rules", "show", "residential"}, {.stdout_file = "/dev/full"});
    CHECK(shown.exit == 6);
    CHECK(shown.says("error: stdout: E601 cannot be written: "));
    CHECK_FALSE(shown.says("Success"));
  }

  TEST_CASE("a folder that cannot be made is an output that failed") {
    const Folder folder;
    folder.write("file", "");
    check_unwritable(folder, run({"label", sample("hip"), "-o", folder / "file/sub/"}),
                     "file/sub/hip.stripped.city.json: E601 cannot be written: Not a directory");
    CHECK(folder.names() == Names{"file"});
  }

  TEST_CASE("an output in a folder that is not there is an output that failed") {
    const Folder folder;
    check_unwritable(folder, run({"label", sample("hip"), "-o", folder / "no/out.city.json"}),
                     "no/out.city.json: E601 cannot be written: No such file or directory");
    CHECK(folder.names().empty());
  }

  TEST_CASE("a directory as output file is an output that failed") {
    const Folder folder;
    std::filesystem::create_directory(folder / "d.csv");
    check_unwritable(folder, run({"label", sample("hip"), "--features", folder / "d.csv"}),
                     "d.csv: E601 cannot be written: Is a directory");
    check_unwritable(folder, run({"segment", sample("hip"), "-o", folder / "d.csv"}),
                     "d.csv: E601 cannot be written: Is a directory");
    CHECK(folder.names() == Names{"d.csv"});
  }

  TEST_CASE("an output that failed leaves the old file as it was") {
    const Folder folder;
    const std::string old = folder.write("out.city.json", "old");
    check_unwritable(
        folder, run({"label", sample("hip"), "-o", old, "--features", folder / "no/parts.csv"}),
        "no/parts.csv: E601 cannot be written: No such file or directory");
    CHECK(bytes_of(old) == "old");
    CHECK(folder.names() == Names{"out.city.json"});
  }

  TEST_CASE("a folder that is read-only is an output that failed") {
    const Folder folder;
    const std::string input = folder.write("in.city.jsonl", cube_lines({"a"}));
    std::filesystem::permissions(
        folder.path(), std::filesystem::perms::owner_read | std::filesystem::perms::owner_exec);
    // Nothing is read-only for root but what the system keeps for itself.
    const std::string place = ::geteuid() == 0 ? "/proc/" : folder / "";
    for (const Names& outputs :
         {Names{"-o", place + "o.city.jsonl"}, Names{"--features", place + "f.csv"},
          Names{"-o", "-", "--status", place + "s"},
          Names{"-o", place + "o.city.jsonl", "--status", place + "s", "--resume"}}) {
      Names arguments{"label", input};
      arguments.insert(arguments.end(), outputs.begin(), outputs.end());
      const Outcome outcome = run(arguments);
      CHECK(outcome.exit == 6);
      CHECK(outcome.says("E601"));
    }
    std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_all);
    CHECK(folder.names() == Names{"in.city.jsonl"});
  }

  TEST_CASE("a full device as stdout is an output that failed") {
    const Folder folder;
    for (const Names& arguments :
         {Names{"label", sample("hip"), "-o", "-"}, Names{"label", sample("hip")},
          Names{"segment", sample("hip"), "--json"},
          Names{"generalise", sample("hip"), "--scale", "1:5000", "-o", "-"},
          Names{"rules", "check", "residential"}, Names{"--help"}}) {
      CAPTURE(arguments[0]);
      check_unwritable(folder, run(arguments, {.stdout_file = "/dev/full"}),
                       "stdout: E601 cannot be written: No space left on device");
    }
  }

  TEST_CASE("a signal leaves no temporary file and the old file as it was") {
    const Folder in, out;
    std::vector<std::string> ids;
    for (int i = 0; i < 20000; ++i) ids.push_back(fmt::format("b{}", i));
    const std::string input = in.write("many.city.jsonl", cube_lines(ids));  // for seconds
    for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
      const std::string old = out.write("out.city.jsonl", "old");
      const Outcome outcome =
          run({"label", input, "-o", old}, {.signal = signal, .watched = out.path()});
      CHECK(outcome.exit == 128 + signal);
      CHECK(bytes_of(old) == "old");
      CHECK(out.names() == Names{"out.city.jsonl"});
    }
  }

  TEST_CASE("what a killed run leaves goes with the next run of the same command") {
    const Folder in, out;
    std::vector<std::string> ids;
    for (int i = 0; i < 20000; ++i) ids.push_back(fmt::format("b{}", i));
    const std::string input = in.write("many.city.jsonl", cube_lines(ids));  // for seconds
    const std::string output = out / "out.city.jsonl";
    for (int i = 0; i < 2; ++i)
      CHECK(run({"label", input, "-o", output}, {.signal = SIGKILL, .watched = out.path()}).exit ==
            128 + SIGKILL);
    REQUIRE(!out.names().empty());
    const std::string few = in.write("few.city.jsonl", cube_lines({"a"}));
    CHECK(run({"label", few, "-o", output}).exit == 0);
    CHECK(out.names() == Names{"out.city.jsonl"});
  }

  TEST_CASE("a broken pipe ends the command quietly and leaves no file") {
    const Folder folder;
    const Outcome outcome =
        run({"label", sample("house"), "-o", "-", "--features", folder / "parts.csv"},
            {.has_broken_pipe = true});
    CHECK(outcome.exit == 128 + SIGPIPE);
    CHECK(outcome.err.empty());
    CHECK(folder.names().empty());
  }

  TEST_CASE("a file that grows too large is an output that failed") {
    const Folder folder;
    const std::string old = folder.write("out.city.json", "old");
    check_unwritable(folder, run({"label", sample("row"), "-o", old}, {.file_limit = 4096}),
                     "out.city.json: E601 cannot be written: File too large");
    CHECK(bytes_of(old) == "old");
    CHECK(folder.names() == Names{"out.city.json"});
  }

  TEST_CASE("several inputs go into a folder that is made") {
    const Folder folder;
    const Outcome outcome =
        run({"label", sample("hip"), sample("block"), "-o", folder / "new/folder/"});
    CHECK(outcome.exit == 0);
    Names names;
    for (const auto& entry : std::filesystem::directory_iterator(folder / "new/folder"))
      names.push_back(entry.path().filename());
    std::ranges::sort(names);
    CHECK(names == Names{"block.stripped.city.json", "hip.stripped.city.json"});
  }

  TEST_CASE("the output may be another format than the input") {
    const Folder folder;
    const auto written = [&](const Names& more) {
      Names arguments{"label", sample("hip")};
      arguments.insert(arguments.end(), more.begin(), more.end());
      const Outcome outcome = run(arguments);
      CHECK(outcome.exit == 0);
      return outcome.out;
    };
    CHECK(written({"--to", "obj", "-o", "-"}).find("\ng window_") != std::string::npos);
    CHECK(written({"--to", "off", "-o", "-"}).starts_with("OFF\n"));
    CHECK(written({"--to", "ply", "-o", "-"}).starts_with("ply\nformat ascii 1.0\n"));
    CHECK(written({"--to", "stl", "-o", "-"}).find("solid window\n") != std::string::npos);
    written({"-o", folder / "a.obj"});
    CHECK(bytes_of(folder / "a.obj") == written({"--to", "obj", "-o", "-"}));
    written({"--to", "stl", "-o", folder / "folder/"});
    CHECK(std::filesystem::exists(folder / "folder/hip.stripped.stl"));
  }

  TEST_CASE("OBJ and OFF and PLY and STL come out as CityJSON with labels") {
    const Folder folder;
    for (const std::string format : {"obj", "off", "ply", "stl"}) {
      const std::string mesh = folder / ("house." + format);
      REQUIRE(run({"label", sample("house"), "-o", mesh}).exit == 0);
      const Outcome outcome = run({"label", mesh, "-o", folder / "back.city.json"});
      CAPTURE(outcome.err);
      CHECK(outcome.exit == 0);
      const auto city = nlohmann::json::parse(bytes_of(folder / "back.city.json"));
      CHECK(city["type"] == "CityJSON");
      CHECK(outcome.says("16 window"));
    }
  }

  TEST_CASE("a tree is told as cut and balanced with the proof that it is one body") {
    const Outcome text = run({"segment", sample("house"), "--tree"});
    CHECK(text.exit == 0);
    CHECK(text.out.starts_with("house:\n  as cut "));
    CHECK(text.out.find("the same body: 787.5349") != std::string::npos);
    CHECK(text.out.find("DIFFERS") == std::string::npos);
    const auto json =
        nlohmann::json::parse(run({"segment", sample("house"), "--tree", "--json"}).out);
    CHECK(json["balanced"]["proof"]["holds"] == true);
    CHECK(json["merged"]["proof"]["holds"] == true);
    CHECK(json["balanced"]["leaves"] == json["cut"]["leaves"]);
    CHECK(json["balanced"]["depth"] < json["cut"]["depth"]);
    CHECK(json["balanced"]["weighted_path"] < json["cut"]["weighted_path"]);
    CHECK(json["nodes"][json["root"].get<std::size_t>()]["kind"] == "difference");
  }
}
