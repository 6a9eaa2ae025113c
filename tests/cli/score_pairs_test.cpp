#include "tests/cli/command.h"

#include <algorithm>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

std::string sample_truth(const std::string& name) {
  return std::string(ORIEL_SOURCE_DIR) + "/examples/samples/" + name + ".truth.json";
}

/// The records of two samples, as lines.
std::vector<std::string> sample_records(const Folder& folder) {
  const std::string path = folder / "all.jsonl";
  REQUIRE(run({"label", sample("house"), sample("row"), "--features", path}).exit == 0);
  return lines_of(bytes_of(path));
}

std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// The same without the labels of some windows of each building.
std::vector<std::string> with_fewer_windows(std::vector<std::string> lines) {
  std::map<std::string, int> seen;
  for (std::string& line : lines) {
    json record = json::parse(line);
    if (record["label"] != "window" || ++seen[record["building"]] > 5) continue;
    record["label"] = nullptr;
    line = record.dump();
  }
  return lines;
}

Outcome compared(const std::string& first, const std::string& second,
                 const std::vector<std::string>& more = {}) {
  std::vector<std::string> call = {
      "score", "--paired", first, second, "--truth", sample_truth("house"), sample_truth("row")};
  call.insert(call.end(), more.begin(), more.end());
  return run(call);
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("score --paired says how a second run differs from the first") {
    const Folder folder;
    const auto lines = sample_records(folder);
    const std::string first = folder / "all.jsonl";
    const std::string second = folder.write("fewer.jsonl", joined(with_fewer_windows(lines)));
    const Outcome outcome = compared(first, second, {"--json", "--bootstrap", "200"});
    CHECK(outcome.exit == 0);
    const json there = json::parse(outcome.out);
    CHECK(there["samples"] == 200);
    const json window = there["classes"]["window"];
    CHECK(window["only_first"] == 10);
    CHECK(window["only_second"] == 0);
    CHECK(window["p"] == 2.0 / 1024);
    CHECK(window["difference"] < 0);
    CHECK(window["interval"][1] < 0);
    CHECK(there["classes"]["balcony"]["p"] == 1);
    const json alone = json::parse(
        run({"score", second, "--truth", sample_truth("house"), sample_truth("row"), "--json"})
            .out);
    CHECK(there["macro_f1"]["second_f1"] == alone["macro_f1"]);
    CHECK(compared(first, second, {"--json", "--bootstrap", "200"}).out == outcome.out);
    const json back = json::parse(compared(second, first, {"--json"}).out)["classes"]["window"];
    CHECK(back["difference"].get<double>() == -window["difference"].get<double>());
    CHECK(compared(first, first).out.find("macro-F1       1.000   1.000     +0.000") !=
          std::string::npos);
  }

  TEST_CASE("score --paired leaves out buildings that only one run has") {
    const Folder folder;
    auto lines = sample_records(folder);
    std::erase_if(lines, [](const std::string& line) {
      return line.find(R"("building":"row")") != std::string::npos;
    });
    const std::string first = folder / "all.jsonl";
    const std::string second = folder.write("house.jsonl", joined(lines));
    const Outcome outcome = compared(first, second);
    CHECK(outcome.exit == 3);
    CHECK(outcome.says(second + ": E150 has no record of 1 building that " + first + " has"));
    CHECK(outcome.out.find("macro-F1       1.000   1.000     +0.000") != std::string::npos);
    CHECK(compared(second, first).says(second + ": E150"));
    const std::string other = folder / "other.jsonl";
    REQUIRE(run({"label", sample("l-house"), "--features", other}).exit == 0);
    const Outcome none = compared(second, other);
    CHECK(none.exit == 5);
    CHECK(none.out.empty());
    CHECK(none.says(other + ": E150 has no building of " + second));
  }

  TEST_CASE("score --join lists every labelled feature and every object with its match") {
    const Folder folder;
    const auto lines = with_fewer_windows(sample_records(folder));
    const std::string records = folder.write("fewer.jsonl", joined(lines));
    const std::string table = folder / "joined.csv";
    const Outcome outcome = run({"score", records, "--truth", sample_truth("house"),
                                 sample_truth("row"), "--join", table, "--json"});
    CHECK(outcome.exit == 0);
    const json score = json::parse(outcome.out);
    const auto rows = lines_of(bytes_of(table));
    REQUIRE(!rows.empty());
    CHECK(rows[0] == "building,feature,name,label,score,rule,truth,class,iou,outcome");
    const auto count = [&](const std::string& end) {
      return std::ranges::count_if(rows, [&](const auto& row) { return row.ends_with(end); });
    };
    std::size_t right = 0;
    for (const json& counts : score["classes"]) right += counts["tp"].get<std::size_t>();
    CHECK(count(",right") == static_cast<std::ptrdiff_t>(right));
    CHECK(count(",not found") + count(",wrong class") + count(",nothing there") ==
          static_cast<std::ptrdiff_t>(score["misses"].size()));
    CHECK(count(",not found") >= 10);
    // The features whose labels were dropped are named.
    CHECK(std::ranges::any_of(rows, [](const std::string& row) {
      return row.starts_with("house,f") && row.ends_with(",not found") &&
             row.find(",,not found") == std::string::npos;
    }));
    std::size_t labelled = 0;
    for (const std::string& line : lines) labelled += json::parse(line)["label"].is_null() ? 0 : 1;
    CHECK(static_cast<std::size_t>(count(",right") + count(",wrong class") +
                                   count(",nothing there")) <= labelled);
  }

  TEST_CASE("joined tables have safe cells where they are asked for") {
    const Folder folder;
    const std::string records =
        folder.write("evil.jsonl", R"({"building":"=1+1","id":"f","label":"window","score":1})"
                                   "\n");
    const std::string table = folder / "joined.csv";
    const auto write = [&](const std::vector<std::string>& more) {
      std::vector<std::string> call = {"score",  records, "--truth", sample_truth("house"),
                                       "--join", table};
      call.insert(call.end(), more.begin(), more.end());
      CHECK(run(call).exit == 3);
      return lines_of(bytes_of(table)).at(1);
    };
    CHECK(write({}).starts_with("=1+1,f,,window,1,"));
    CHECK(write({"--safe-cells"}).starts_with("\"'=1+1\",f,,window,1,"));
    CHECK(run({"score", records, "--truth", sample_truth("house"), "--join", records}).exit == 2);
  }
}
