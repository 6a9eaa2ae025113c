#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

struct Mixed {
  std::vector<std::string> lines;   ///< the header first
  std::vector<std::size_t> failed;  ///< lines, counted from 0
};

/// Twenty cubes: one line is cut off, one has a byte that is no UTF-8, one cube lacks a face.
Mixed stream_with_faults() {
  std::vector<std::string> ids;
  for (int i = 0; i < 20; ++i) ids.push_back(fmt::format("cube-{}", i));
  Mixed mixed;
  std::istringstream text(cube_lines(ids));
  for (std::string line; std::getline(text, line);) mixed.lines.push_back(line);
  mixed.lines[4].resize(50);
  mixed.lines[9][20] = '\xff';
  mixed.lines[13] = replaced(mixed.lines[13], "[4000,4000,4000]", "[9000000,0,0]");
  mixed.failed = {4, 9, 13};
  return mixed;
}

std::string text_of(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::vector<json> records_of(const std::string& file) {
  std::vector<json> records;
  std::istringstream lines(bytes_of(file));
  for (std::string line; std::getline(lines, line);) records.push_back(json::parse(line));
  return records;
}

std::string bytes_of_hex(const std::string& digits) {
  std::string bytes;
  for (std::size_t i = 0; i + 1 < digits.size(); i += 2)
    bytes += static_cast<char>(std::stoi(digits.substr(i, 2), nullptr, 16));
  return bytes;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("every record that failed is in quarantine with its line and its code") {
    const Folder folder;
    const Mixed mixed = stream_with_faults();
    const std::string input = folder.write("in.city.jsonl", text_of(mixed.lines));
    const Outcome outcome =
        run({"label", input, "-o", folder / "out.city.jsonl", "--status", folder / "out", "-j2"});
    CHECK(outcome.exit == 3);
    CHECK(outcome.says("17 of 20 buildings labelled"));
    const auto records = records_of(folder / "out.quarantine.jsonl");
    REQUIRE(records.size() == mixed.failed.size());
    for (std::size_t i = 0; i < records.size(); ++i) {
      CAPTURE(i);
      CHECK(records[i]["input"] == input);
      CHECK(records[i]["line"] == mixed.failed[i] + 1);
      CHECK(outcome.says(records[i]["code"].get<std::string>()));
      const std::string raw = records[i].contains("record_hex")
                                  ? bytes_of_hex(records[i]["record_hex"])
                                  : records[i]["record"].get<std::string>();
      CHECK(raw == mixed.lines[mixed.failed[i]]);
    }
    CHECK(records[1].contains("record_hex"));
    CHECK(records[2]["id"] == "cube-12");
    CHECK(records[2]["code"] == "E501");
  }

  TEST_CASE("the counts of a status file add up") {
    const Folder folder;
    const std::string input = folder.write("in.city.jsonl", text_of(stream_with_faults().lines));
    run({"label", input, "-o", folder / "out.city.jsonl", "--status", folder / "out"});
    const json status = json::parse(bytes_of(folder / "out.status.json"));
    CHECK(status["buildings"] == 20);
    CHECK(status["done"] == 17);
    CHECK(status["set_aside"] == 3);
    CHECK(status["quarantined_records"] == 3);
    int by_code = 0;
    for (const auto& [code, count] : status["quarantined_by_code"].items())
      by_code += count.get<int>();
    CHECK(by_code == 3);
    CHECK(status["exit_code"] == 3);
    CHECK(status["rules_sha256"].get<std::string>().size() == 64);
    CHECK(status["peak_memory_bytes"] > 0);
    // Every cube that could be read is in the output, also the one that was set aside.
    std::istringstream lines(bytes_of(folder / "out.city.jsonl"));
    int written = -1;  // the header
    for (std::string line; std::getline(lines, line);) ++written;
    CHECK(written == 18);
  }

  TEST_CASE("nothing fails and the quarantine is empty") {
    const Folder folder;
    const std::string input = folder.write("in.city.jsonl", cube_lines({"a", "b"}));
    CHECK(run({"segment", input, "--json", "--status", folder / "s"}).exit == 0);
    CHECK(bytes_of(folder / "s.quarantine.jsonl").empty());
    CHECK(json::parse(bytes_of(folder / "s.status.json"))["set_aside"] == 0);
  }

  TEST_CASE("a file that cannot be opened stands in quarantine") {
    const Folder folder;
    CHECK(run({"segment", folder / "missing.city.json", "--status", folder / "s"}).exit == 5);
    const auto records = records_of(folder / "s.quarantine.jsonl");
    REQUIRE(records.size() == 1);
    CHECK(records[0]["code"] == "E101");
    CHECK(records[0]["record"].is_null());
  }

  TEST_CASE("as many failures as are allowed leave the exit code at 0") {
    const std::string text = text_of(stream_with_faults().lines);
    const auto exit_with = [&](const std::string& allowed) {
      return run({"label", "-", "--from", "cityjsonseq", "-o", "-", "--allow-bad", allowed},
                 {.in = text})
          .exit;
    };
    CHECK(exit_with("2") == 3);
    CHECK(exit_with("3") == 0);
    CHECK(exit_with("14.9%") == 3);
    CHECK(exit_with("15%") == 0);
    for (const std::string wrong : {"-1", "1.5", "%", "x", "1%%", ""}) {
      CAPTURE(wrong);
      CHECK(exit_with(wrong) == 2);
    }
  }
}
