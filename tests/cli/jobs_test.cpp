#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <csignal>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;

namespace {

/// A stream with many good records, some that are broken, and some that are no solid.
std::string mixed_stream() {
  std::vector<std::string> ids;
  for (int i = 0; i < 40; ++i) ids.push_back("cube-" + std::to_string(i));
  const std::string good = cube_lines(ids);
  std::string text;
  int line = 0;
  for (std::size_t begin = 0; begin < good.size(); ++line) {
    const std::size_t end = good.find('\n', begin) + 1;
    std::string record = good.substr(begin, end - begin);
    begin = end;
    if (line % 7 == 3) record = record.substr(0, record.size() / 2) + "\n";
    if (line % 11 == 5) record = replaced(record, "[[4,5,7,6]],", "");
    text += record;
  }
  return text;
}

/// The sample house so many times, as a stream: each takes some milliseconds.
std::string houses(int count) {
  const auto lines = lines_of(run({"cat", sample("house")}).out);
  REQUIRE(lines.size() == 2);
  std::string text = lines[0] + "\n";
  for (int i = 0; i < count; ++i) {
    std::string line = lines[1];
    const std::string id = "\"house-" + std::to_string(i) + "\"";
    for (std::size_t at = 0; (at = line.find("\"house\"", at)) != std::string::npos;)
      line.replace(at, 7, id);
    text += line + "\n";
  }
  return text;
}

struct Written {
  int exit;
  std::string bytes, features, messages;
  bool operator==(const Written&) const = default;
};

Written label(const std::string& command, const std::string& jobs, const std::string& text,
              const std::vector<std::string>& more = {}) {
  const Folder folder;
  const std::string input = folder.write("in.city.jsonl", text), out = folder / "out.city.jsonl",
                    features = folder / "features.csv";
  std::vector<std::string> arguments{command,  input, "-o", out, "--features",
                                     features, "-j",  jobs, "-v"};
  arguments.insert(arguments.end(), more.begin(), more.end());
  if (command == "generalise") arguments.insert(arguments.end(), {"--scale", "1:2000"});
  const Outcome outcome = run(arguments);
  std::string messages = outcome.err;
  for (std::size_t at = messages.find(folder.path().string()); at != std::string::npos;
       at = messages.find(folder.path().string()))
    messages.replace(at, folder.path().string().size(), "FOLDER");
  return {outcome.exit, bytes_of(out), bytes_of(features), messages};
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("the same bytes and messages come of any number of jobs") {
    const std::string text = mixed_stream();
    for (const std::string command : {"label", "generalise"}) {
      CAPTURE(command);
      const Written one = label(command, "1", text);
      CHECK(one.exit == 3);
      CHECK(one.bytes.find("cube-39") != std::string::npos);
      CHECK(one.messages.find("E302") != std::string::npos);
      for (const std::string jobs : {"2", "3", "8", "0"}) {
        CAPTURE(jobs);
        CHECK(label(command, jobs, text) == one);
      }
      for (const std::string jobs : {"1", "3"})
        CHECK(label(command, jobs, text, {"--isolate"}) == one);
    }
  }

  TEST_CASE("a worker that a signal ends costs the building it was at and nothing else") {
    const Folder folder;
    const std::string input = folder.write("in.city.jsonl", houses(24)),
                      whole = folder / "whole.city.jsonl", out = folder / "out.city.jsonl";
    REQUIRE(run({"label", input, "-o", whole}).exit == 0);
    Outcome outcome;
    // A signal may hit a worker that has just done its last record: that costs nothing. It is one
    // that sanitizers leave alone: they turn SIGSEGV into an exit code.
    for (int i = 0; i < 20 && outcome.exit != 3; ++i)
      outcome = run({"label", input, "-o", out, "--status", folder / "s", "--isolate"},
                    {.worker_signal = SIGABRT});
    CHECK(outcome.exit == 3);
    CHECK(outcome.says("23 of 24 buildings labelled"));
    CHECK(outcome.says("1 rejected (E123 1)"));
    CHECK(outcome.says("signal 6 (SIGABRT)"));
    const auto bad = lines_of(bytes_of(folder / "s.quarantine.jsonl"));
    REQUIRE(bad.size() == 1);
    const nlohmann::json entry = nlohmann::json::parse(bad[0]);
    const std::size_t line = entry["line"].get<std::size_t>() - 1;
    auto expected = lines_of(bytes_of(whole));
    CHECK(lines_of(bytes_of(input)).at(line) == entry["record"].get<std::string>());
    expected.at(line) = entry["record"];
    CHECK(lines_of(bytes_of(out)) == expected);
    CHECK(nlohmann::json::parse(bytes_of(folder / "s.status.json"))["set_aside"] == 1);
  }

  TEST_CASE("what takes longer than it may costs that building and says that it was the clock") {
    const Folder folder;
    const std::string input = folder.write("in.city.jsonl", houses(6)),
                      whole = folder / "whole.city.jsonl", out = folder / "out.city.jsonl";
    const auto label = [&](const std::string& seconds) {
      return run({"label", input, "-o", out, "--status", folder / "s", "--isolate",
                  "--most-seconds", seconds});
    };
    REQUIRE(run({"label", input, "-o", whole}).exit == 0);
    CHECK(label("1000").exit == 0);
    CHECK(bytes_of(out) == bytes_of(whole));
    // No house is done in a millisecond.
    const Outcome outcome = label("0.001");
    CHECK(outcome.exit == 3);
    CHECK(outcome.says("0 of 6 buildings labelled"));
    CHECK(outcome.says("6 rejected (E123 6)"));
    CHECK(outcome.says("the clock: it took more than 0.001 s (--most-seconds)"));
    CHECK(lines_of(bytes_of(folder / "s.quarantine.jsonl")).size() == 6);
    CHECK(run({"label", input, "-o", out, "--most-seconds", "10"}).exit == 2);
  }

  TEST_CASE("a signal ends a command with its workers and leaves no file") {
    const Folder folder;
    const std::string input = folder.write("in.city.jsonl", houses(24));
    const Outcome outcome = run({"label", input, "-o", folder / "out.city.jsonl", "--isolate"},
                                {.signal = SIGTERM, .watched = folder.path()});
    CHECK(outcome.exit == 128 + SIGTERM);
    CHECK(folder.names() == std::vector<std::string>{"in.city.jsonl"});
  }

  TEST_CASE("workers need an output that is written record by record") {
    const Folder folder;
    CHECK(run({"label", sample("hip"), "-o", folder / "a.obj", "--isolate"}).exit == 2);
    CHECK(run({"label", sample("hip"), "--existing", "audit", "--isolate"}).exit == 2);
    CHECK(run({"label", sample("hip"), "-o", folder / "a.city.json", "--isolate"}).exit == 0);
  }

  TEST_CASE("with several jobs files keep their order and a missing one costs itself only") {
    const Folder folder;
    std::vector<std::string> inputs;
    for (const std::string id : {"a", "b", "c"})
      inputs.push_back(folder.write(id + ".city.json", cubes({id}).dump()));
    inputs.insert(inputs.begin() + 1, folder / "missing.city.json");
    for (const std::string jobs : {"1", "4"}) {
      std::vector<std::string> arguments{"segment", "--json", "-j", jobs};
      arguments.insert(arguments.end(), inputs.begin(), inputs.end());
      const Outcome outcome = run(arguments);
      CHECK(outcome.exit == 5);
      CHECK(outcome.says("E101"));
      const auto a = outcome.out.find("\"id\":\"a\""), b = outcome.out.find("\"id\":\"b\""),
                 c = outcome.out.find("\"id\":\"c\"");
      CHECK(a < b);
      CHECK(b < c);
      CHECK(c != std::string::npos);
    }
  }

  TEST_CASE("a number of jobs below 0 or above 1024 is wrong usage") {
    for (const std::string jobs : {"-1", "1025", "many"})
      CHECK(run({"label", sample("hip"), "-j", jobs}).exit == 2);
  }
}
