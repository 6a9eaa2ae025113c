#include "tests/cli/command.h"

#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel::test;

namespace {

/// The header of a table, whose other lines have as many cells.
std::string header_of(const std::string& path) { return lines_of(bytes_of(path)).at(0); }

/// Both samples are labelled into a table with these columns.
Outcome labelled_with(const std::string& table, const std::string& columns) {
  return run(
      {"label", sample("house"), sample("house-flush"), "--features", table, "--columns", columns});
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("tables have the columns and groups that are asked for") {
    const Folder folder;
    const std::string table = folder / "t.csv";
    CHECK(labelled_with(table, "height_m,label").says("E151"));
    CHECK(header_of(table) == "building,id,label,height_m");
    CHECK(labelled_with(table, "ids,labels").exit == 0);
    CHECK(header_of(table) ==
          "building,id,name,label,score,margin,rule,runner_up,groups,part_of,corrected_by,"
          "corrected_why");
    const Outcome all = labelled_with(table, "all");
    CHECK_FALSE(all.says("E151"));
    const std::string everything = bytes_of(table);
    REQUIRE(run({"label", sample("house"), sample("house-flush"), "--features", table}).exit == 0);
    CHECK((bytes_of(table) == everything));
    CHECK(everything.find("#1/") != std::string::npos);
    const Outcome wrong = labelled_with(table, "lables");
    CHECK(wrong.exit == 2);
    CHECK(wrong.says("did you mean 'labels'?"));
    CHECK(run({"label", sample("house"), "--columns", "ids"}).exit == 2);
    CHECK(run({"segment", sample("house"), "--columns", "ids"}).exit == 2);
  }

  TEST_CASE("what a pack reads is enough for the labels of the buildings") {
    const Folder folder;
    const std::string whole = folder / "whole.csv";
    REQUIRE(labelled_with(whole, "label,score,margin,rule,runner_up,part_of,groups").exit == 0);
    for (const std::string name : {"rules.csv", "rules.jsonl", "rules.json"}) {
      CAPTURE(name);
      const std::string rules = folder / name;
      const Outcome outcome = run({"segment", sample("house"), sample("house-flush"), "--features",
                                   rules, "--columns", "rules"});
      CHECK_FALSE(outcome.says("E151"));
      const std::string again = folder / "again.csv";
      const Outcome labels = run({"interpret", rules, "-o", again, "--columns",
                                  "label,score,margin,rule,runner_up,part_of,groups"});
      CHECK(labels.exit == 0);
      CHECK(labels.err.empty());
      CHECK((bytes_of(again) == bytes_of(whole)));
    }
    CHECK(bytes_of(folder / "rules.csv").size() < bytes_of(whole).size() * 20);
  }

  TEST_CASE("interpret names the columns that the pack reads and the table lacks") {
    const Folder folder;
    const std::string labels = folder / "labels.csv";
    CHECK(labelled_with(labels, "ids,labels,height_m").says(labels + ": E151 lacks"));
    const Outcome outcome = run({"interpret", labels, "-o", folder / "again.csv"});
    CHECK(outcome.exit == 3);
    CHECK(outcome.says(labels + ": E151 lacks"));
    CHECK(outcome.says("that the pack 'residential' reads: host, "));
    // What the table lacks is not written as if it were missing in every feature.
    CHECK(header_of(folder / "again.csv").find("volume_m3") == std::string::npos);
    CHECK(header_of(folder / "again.csv").find(",height_m") != std::string::npos);
    CHECK(header_of(folder / "again.csv").find(",name") == std::string::npos);
    CHECK(run({"interpret", labels, "-o", folder / "x.csv", "--columns", "volume_m3"}).exit == 2);
    CHECK(run({"interpret", labels, "--columns", "ids"}).exit == 2);
  }
}
