#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <cctype>

#include <doctest/doctest.h>

using namespace oriel::test;

namespace {

using Names = std::vector<std::string>;

/// A call that makes no sense: exit 2, a message on stderr, and nothing done.
void check_usage(const Names& arguments, const std::string& message) {
  const Outcome outcome = run(arguments);
  CAPTURE(outcome.err);
  CHECK(outcome.exit == 2);
  CHECK(outcome.says(message));
  CHECK(outcome.says("--help"));
  CHECK(outcome.out.empty());
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("without a command nothing is done") { check_usage({}, "A subcommand is required"); }

  TEST_CASE("an unknown command is named") { check_usage({"lable"}, "'lable' is not a command"); }

  TEST_CASE("an unknown option is named") {
    check_usage({"label", sample("hip"), "--bogus"}, "--bogus");
    check_usage({"label", sample("hip"), "--order", "random"}, "random");
    check_usage({"label", sample("hip"), "--to", "dwg", "-o", "-"}, "dwg");
    check_usage({"label", sample("hip"), "--codelist", "none"}, "the pack has codes for");
  }

  TEST_CASE("what was probably meant by an unknown command is said") {
    check_usage({"lable"}, "'lable' is not a command of oriel; did you mean 'label'?\n");
    check_usage({"classify", "x"}, "'classify' is not a command of oriel; did you mean 'label'?\n");
    check_usage({"lint"}, "'lint' is not a command of oriel; did you mean 'rules check'?\n");
    check_usage({"help"}, "'help' is not a command of oriel; did you mean '--help'?\n");
    check_usage({"rules", "chek", "p"},
                "'chek' is not a command of oriel rules; did you mean 'check'?\n");
    check_usage({"rules", "lint", "p"},
                "'lint' is not a command of oriel rules; did you mean 'check'?\n");
    check_usage({"frobnicate"}, "'frobnicate' is not a command of oriel\n");
  }

  TEST_CASE("what was probably meant by an unknown option is said") {
    check_usage({"label", sample("hip"), "--ruls", "x"},
                "'oriel label' has no option '--ruls'; did you mean '--rules'?\n");
    check_usage({"label", sample("hip"), "--threads=3"},
                "'oriel label' has no option '--threads'; did you mean '--jobs'?\n");
    check_usage({"generalise", sample("hip"), "--sclae", "1:2000"},
                "'oriel generalise' has no option '--sclae'; did you mean '--scale'?\n");
    check_usage({"rules", "check", "x", "--jsno"},
                "'oriel rules check' has no option '--jsno'; did you mean '--json'?\n");
    check_usage({"label", sample("hip"), "--frobnicate"},
                "'oriel label' has no option '--frobnicate'\n");
  }

  TEST_CASE("an unknown word of the arguments cannot command the terminal") {
    const Outcome outcome = run({"lab\x1b[2Jle"});
    CHECK(outcome.exit == 2);
    CHECK(outcome.err.find('\x1b') == std::string::npos);
  }

  TEST_CASE("missing arguments are named") {
    check_usage({"label"}, "input is required");
    check_usage({"generalise", sample("hip"), "-o", "-"},
                "one of --scale, --to-lod, --series, --at, --check is required");
    check_usage({"generalise", sample("hip"), "--scale", "1:100"}, "--output is required");
    check_usage({"score", "parts.csv"}, "--truth is required");
    check_usage({"rules"}, "A subcommand is required");
  }

  TEST_CASE("a scale is 1:N with N of at least 1") {
    const Folder folder;
    for (const std::string scale :
         {"1:0", "abc", "2:3", "11:5", "1:", "", "1:-5", "1:0.5", "1:inf", "1:nan", "1:2000x"})
      check_usage({"generalise", sample("hip"), "--scale", scale, "-o", folder / "out.city.json"},
                  "'" + scale + "' is not a scale");
    CHECK(folder.names().empty());
    for (const std::string scale : {"1:2000", "1 : 2000", "2000", "1:2e3"})
      CHECK(run({"generalise", sample("hip"), "--scale", scale, "-o", "-"}).exit == 0);
  }

  TEST_CASE("several inputs do not go into one file") {
    const Folder folder;
    check_usage({"label", sample("hip"), sample("block"), "-o", folder / "out.city.json"},
                "several inputs need a folder");
    check_usage({"label", sample("hip"), sample("block"), "-o", "-"},
                "several inputs need a folder");
    CHECK(folder.names().empty());
  }

  TEST_CASE("two inputs of one name do not go into one folder") {
    const Folder folder;
    const std::string twin = folder.write("hip.stripped.city.json", cubes({"a"}).dump());
    check_usage({"label", sample("hip"), twin, "-o", folder / "out/"},
                "two inputs would both be written to '" + folder / "out/hip.stripped.city.json'");
    CHECK(folder.names() == Names{"hip.stripped.city.json"});
  }

  TEST_CASE("an output without a known extension needs a format") {
    const Folder folder;
    check_usage({"label", sample("hip"), "-o", folder / "out.xyz"}, "has no known extension");
    CHECK(run({"label", sample("hip"), "-o", folder / "out.xyz", "--to", "obj"}).exit == 0);
    CHECK(folder.names() == Names{"out.xyz"});
  }

  TEST_CASE("feature records without a known extension are named") {
    for (const std::string command : {"label", "segment"})
      for (const std::string name : {"-", "parts", "parts.txt"})
        check_usage({command, sample("hip"), "--features", name},
                    "'" + name + "' does not end in .csv, .json or .jsonl");
  }

  TEST_CASE("a stream is not written as one file") {
    const Folder folder;
    const std::string lines = folder.write("in.city.jsonl", cube_lines({"a"}));
    check_usage({"label", lines, "-o", folder / "out.city.json"},
                "cityjsonseq cannot be written as");
    check_usage({"label", sample("hip"), "-o", folder / "out.city.jsonl"}, "cannot be written as");
  }

  TEST_CASE("stdin is read only once") {
    check_usage({"label", "-", "--from", "cityjson", "--repeat", "2"}, "stdin can be read only");
    check_usage({"label", "-", "-", "--from", "cityjson"}, "stdin can be read only once");
  }

  TEST_CASE("the help of every command has an example") {
    const Outcome all = run({"--help"});
    CHECK(all.exit == 0);
    for (const Names& command : {Names{"segment"}, Names{"label"}, Names{"generalise"},
                                 Names{"explain"}, Names{"score"}, Names{"rules", "check"}}) {
      CAPTURE(command[0]);
      CHECK(all.out.find("\n  " + command[0] + " ") != std::string::npos);
      Names arguments = command;
      arguments.emplace_back("--help");
      const Outcome outcome = run(arguments);
      CHECK(outcome.exit == 0);
      CHECK(outcome.out.find("Example:\n  oriel ") != std::string::npos);
      CHECK(outcome.err.empty());
    }
  }

  TEST_CASE("the version names the commit and the compiler and the libraries") {
    const Outcome outcome = run({"--version"});
    CHECK(outcome.exit == 0);
    CHECK(outcome.err.empty());
    const std::vector<std::string> lines = lines_of(outcome.out);
    REQUIRE(lines.size() == 4);
    CHECK(lines[0].starts_with("oriel "));
    CHECK(lines[0].find_first_not_of("0123456789.", 6) == std::string::npos);
    REQUIRE(lines[1].starts_with("commit: "));
    const std::string commit = lines[1].substr(8);
    CHECK((commit == "unknown" ||
           (commit.size() >= 12 &&
            commit.find_first_not_of("0123456789abcdef") == std::string::npos)));
    CHECK(lines[2].starts_with("compiler: "));
    CHECK(lines[3].starts_with("libraries: "));
    for (const char* library : {"OpenMesh", "CGAL", "Boost", "simdjson", "nlohmann-json",
                                "yaml-cpp", "fmt", "spdlog", "CLI11", "Expat", "oneTBB"}) {
      CAPTURE(library);
      const std::size_t name = lines[3].find(std::string(" ") + library + " ");
      REQUIRE(name != std::string::npos);
      CHECK(std::isdigit(
                static_cast<unsigned char>(lines[3][name + std::string(library).size() + 2])) != 0);
    }
  }
}
