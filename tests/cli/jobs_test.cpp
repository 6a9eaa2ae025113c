#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <string>
#include <vector>

#include <doctest/doctest.h>

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
    if (line % 11 == 5) record = replaced(record, "[[0,2,3,1]],", "");
    text += record;
  }
  return text;
}

struct Written {
  int exit;
  std::string bytes, features, messages;
  bool operator==(const Written&) const = default;
};

Written label(const std::string& command, const std::string& jobs, const std::string& text) {
  const Folder folder;
  const std::string input = folder.write("in.city.jsonl", text), out = folder / "out.city.jsonl",
                    features = folder / "features.csv";
  std::vector<std::string> arguments{command,  input, "-o", out, "--features",
                                     features, "-j",  jobs, "-v"};
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
    }
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
