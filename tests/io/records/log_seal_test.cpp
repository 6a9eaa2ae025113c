#include "io/records/log_seal.h"

#include "kernel/base/issue.h"
#include "tests/io/files.h"

#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace oriel {
namespace {

/// A log of three lines and its end.
std::string sealed_log() {
  LogSealer sealer;
  std::string log = sealer.sealed("{\"building\":\"a\",\"scale\":500}\n");
  log += sealer.sealed("{\"building\":\"a\",\"scale\":700}\n{\"building\":\"b\",\"scale\":500}\n");
  return log + sealer.end({{"500", "0a"}, {"2000", "0b"}});
}

/// What is said of a log; without a code: nothing is wrong.
Issue fault_of(const std::string& log) {
  const test::TemporaryFolder folder;
  try {
    check_log(folder.write("s.oplog.jsonl", log));
  } catch (const InputError& error) {
    return error.issue();
  }
  return {};
}

std::vector<std::string> lines_with_ends(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at) + 1;
    lines.push_back(text.substr(at, end - at));
    at = end;
  }
  return lines;
}

TEST_SUITE("io") {
  TEST_CASE("a log that is as it was written has its levels") {
    const test::TemporaryFolder folder;
    const LogSeal seal = check_log(folder.write("s.oplog.jsonl", sealed_log()));
    CHECK(seal.is_sealed);
    CHECK(seal.levels.at("500") == "0a");
    CHECK(seal.levels.at("2000") == "0b");
  }

  TEST_CASE("every byte of a log that is another is found at its line") {
    const std::string log = sealed_log();
    int line = 1;
    for (std::size_t i = 0; i + 1 < log.size(); ++i) {
      std::string damaged = log;
      damaged[i] = log[i] == 'x' ? 'y' : 'x';
      const Issue fault = fault_of(damaged);
      CAPTURE(damaged);
      CHECK(fault.code == Code::E132);
      // Without the check of the first line the second is the first with one.
      CHECK(fault.place.line >= line);
      CHECK(fault.place.line <= line + 1);
      if (log[i] == '\n') ++line;
    }
  }

  TEST_CASE("a log that was cut lost a line or has them in another order is refused") {
    const std::vector<std::string> lines = lines_with_ends(sealed_log());
    REQUIRE(lines.size() == 4);
    CHECK(fault_of("").code == Code::E132);
    CHECK(fault_of(lines[0]).code == Code::E132);
    CHECK(fault_of(lines[0] + lines[1] + lines[2]).code == Code::E132);
    CHECK(fault_of(lines[0] + lines[2] + lines[3]).place.line == 2);
    CHECK(fault_of(lines[1] + lines[2] + lines[3]).place.line == 1);
    CHECK(fault_of(lines[0] + lines[2] + lines[1] + lines[3]).place.line == 2);
    CHECK(fault_of(lines[0] + lines[1] + lines[1] + lines[2] + lines[3]).place.line == 3);
    CHECK(fault_of(sealed_log() + lines[0]).place.line == 5);
    CHECK(fault_of(lines[3]).place.line == 1);
  }

  TEST_CASE("a log of a version without checks has none") {
    const test::TemporaryFolder folder;
    const std::string log = "{\"building\":\"a\",\"scale\":500}\n{\"building\":\"b\"}\n";
    CHECK_FALSE(check_log(folder.write("s.oplog.jsonl", log)).is_sealed);
  }

  TEST_CASE("a log without operations says so") {
    const test::TemporaryFolder folder;
    LogSealer sealer;
    CHECK(check_log(folder.write("s.oplog.jsonl", sealer.end({{"500", "0a"}}))).is_sealed);
  }
}

}  // namespace
}  // namespace oriel
