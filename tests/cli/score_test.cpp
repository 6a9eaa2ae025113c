#include "tests/cli/command.h"

#include <algorithm>
#include <random>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

std::string truth_of(const std::string& name) {
  return std::string(ORIEL_SOURCE_DIR) + "/examples/samples/" + name + ".truth.json";
}

/// The records of the labelled sample, in a folder.
std::string records_of(const std::string& name, const Folder& folder) {
  const std::string path = folder / (name + ".jsonl");
  REQUIRE(run({"label", sample(name), "--features", path}).exit == 0);
  return path;
}

/// Three samples as a stream, in an order that goes with `seed`, and so the polygons of each shell;
/// 0: as they are.
std::string shuffled_stream(unsigned seed) {
  std::string header;
  std::vector<std::string> lines;
  std::mt19937 random(seed);
  for (const std::string name : {"house", "l-house", "row"}) {
    const std::string text = run({"cat", sample(name)}).out;
    const std::size_t end = text.find('\n') + 1;
    header = text.substr(0, end);
    json building = json::parse(text.substr(end));
    for (json& object : building["CityObjects"])
      for (json& geometry : object["geometry"])
        for (json& shell : geometry["boundaries"])
          if (seed != 0) std::shuffle(shell.begin(), shell.end(), random);
    lines.push_back(building.dump() + "\n");
  }
  if (seed != 0) std::shuffle(lines.begin(), lines.end(), random);
  return header + lines[0] + lines[1] + lines[2];
}

/// What the rules say of each feature, sorted, and all that score writes.
struct Scored {
  std::vector<std::string> labels;
  std::string score, rows, curve;
  bool operator==(const Scored&) const = default;
};

Scored scored_of(unsigned seed, const std::string& jobs) {
  const Folder folder;
  const std::string records = folder / "parts.jsonl",
                    stream = folder.write("in.city.jsonl", shuffled_stream(seed));
  REQUIRE(run({"label", stream, "--features", records, "-j", jobs}).exit == 0);
  Scored said;
  std::istringstream lines(bytes_of(records));
  for (std::string line; std::getline(lines, line);) {
    const json record = json::parse(line);
    std::string text;
    for (const char* member :
         {"building", "id", "name", "label", "score", "margin", "rule", "runner_up", "groups"})
      text += record.value(member, json()).dump() + " ";
    said.labels.push_back(text);
  }
  std::ranges::sort(said.labels);
  const Outcome outcome = run({"score", records, "--truth", truth_of("house"), truth_of("l-house"),
                               truth_of("row"), "--json", "--bootstrap", "50", "--per-building",
                               folder / "rows.csv", "--curve", folder / "curve.csv"});
  CHECK(outcome.exit == 0);
  said.score = outcome.out;
  said.rows = bytes_of(folder / "rows.csv");
  said.curve = bytes_of(folder / "curve.csv");
  return said;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("labels and scores are the same for shuffled input and any number of threads") {
    const Scored once = scored_of(0, "1");
    CHECK(once.labels.size() > 150);
    CHECK(json::parse(once.score)["classes"]["window"]["tp"].get<int>() > 50);
    for (const unsigned seed : {0U, 1U, 2U})
      for (const std::string jobs : {"1", "2", "8"}) {
        CAPTURE(seed);
        CAPTURE(jobs);
        const Scored said = scored_of(seed, jobs);
        CHECK(said.labels == once.labels);
        CHECK(said.score == once.score);
        CHECK(said.rows == once.rows);
        CHECK(said.curve == once.curve);
      }
  }

  TEST_CASE("score compares records with the truth") {
    const Folder folder;
    const std::string records = records_of("house", folder);
    const Outcome text = run({"score", records, "--truth", truth_of("house")});
    CHECK(text.exit == 0);
    CHECK(text.out.starts_with("class "));
    CHECK(text.out.find("\nwindow           16      0      0      1.000   1.000  1.000\n") !=
          std::string::npos);
    CHECK(text.err.empty());
    const Outcome outcome = run({"score", records, "--truth", truth_of("house"), "--json"});
    CHECK(outcome.exit == 0);
    CHECK(json::parse(outcome.out)["classes"]["window"]["tp"] == 16);
  }

  TEST_CASE("score tells how well each rule does") {
    const Folder folder;
    const std::string records = records_of("house", folder);
    const Outcome text = run({"score", records, "--truth", truth_of("house"), "--by-rule"});
    CHECK(text.exit == 0);
    CHECK(text.out.find("\nrule ") != std::string::npos);
    CHECK(text.out.find("\nwindow.in_wall ") != std::string::npos);
    const Outcome outcome =
        run({"score", records, "--truth", truth_of("house"), "--by-rule", "--json"});
    CHECK(outcome.exit == 0);
    const json scored = json::parse(outcome.out);
    std::size_t right = 0, hits = 0;
    for (const json& rule : scored["rules"]) right += rule["right"].get<std::size_t>();
    for (const json& counts : scored["classes"]) hits += counts["tp"].get<std::size_t>();
    CHECK(right == hits);
    CHECK(hits > 16);
    CHECK_FALSE(json::parse(run({"score", records, "--truth", truth_of("house"), "--json"}).out)
                    .contains("rules"));
  }

  TEST_CASE("score by rule names the rules that decided nothing and refuses a bad pack") {
    const Folder folder;
    const std::string records = records_of("house", folder);
    const auto scored = [&](const std::vector<std::string>& more) {
      std::vector<std::string> arguments{"score", records, "--truth", truth_of("house"),
                                         "--by-rule"};
      arguments.insert(arguments.end(), more.begin(), more.end());
      return run(arguments);
    };
    const Outcome text = scored({});
    CHECK(text.out.find("\ndecided nothing: ") != std::string::npos);
    CHECK(text.out.find("bay.by_shape") != std::string::npos);
    const json rules = json::parse(scored({"--json"}).out)["rules"];
    CHECK(rules["bay.by_shape"]["decided"] == 0);
    CHECK(rules["bay.by_shape"]["label"] == "bay");
    // Another pack than the one that labelled says nothing of what decided.
    const Outcome other =
        scored({"--rules", std::string(ORIEL_SOURCE_DIR) + "/examples/first_pack.yaml"});
    CHECK(other.exit == 0);
    CHECK(other.out.find("decided nothing") == std::string::npos);
    const Outcome bad = scored({"--rules", folder / "none.yaml"});
    CHECK(bad.exit == 4);
    CHECK(bad.out.empty());
    CHECK(bad.says("R200"));
  }

  TEST_CASE("flush openings are found as recessed ones are") {
    const Folder folder;
    for (const std::string name : {"house", "house-flush"}) {
      CAPTURE(name);
      const Outcome outcome =
          run({"score", records_of(name, folder), "--truth", truth_of(name), "--json"});
      CHECK(outcome.exit == 0);
      const json score = json::parse(outcome.out);
      CHECK(score["classes"]["window"]["tp"] == 16);
      CHECK(score["classes"]["door"]["tp"] == 2);
      CHECK(score["macro_f1"] == 1);
      CHECK(score["misses"].empty());
    }
  }

  TEST_CASE("records may be CSV or JSON or JSON lines") {
    const Folder folder;
    std::string text;
    for (const std::string extension : {".csv", ".json", ".jsonl"}) {
      const std::string records = folder / ("parts" + extension);
      REQUIRE(run({"label", sample("house"), "--features", records}).exit == 0);
      const Outcome outcome = run({"score", records, "--truth", truth_of("house")});
      CHECK(outcome.exit == 0);
      if (!text.empty()) CHECK(outcome.out == text);
      text = outcome.out;
    }
  }

  TEST_CASE("more than 20 misses are counted and listed with -v") {
    const Folder folder;
    const std::string records = records_of("house", folder);
    // Nothing of the row is found in records of the house.
    const Outcome few = run({"score", records, "--truth", truth_of("row")});
    const Outcome all = run({"score", records, "--truth", truth_of("row"), "-v"});
    const auto lines = [](const std::string& text) {
      return std::ranges::count(text.substr(text.find("misses: ")), '\n');
    };
    CHECK(few.exit == 3);
    CHECK(few.says("E131 no building of the truth has a record"));
    CHECK(lines(few.out) == 1 + 20 + 2);
    const json score =
        json::parse(run({"score", records, "--truth", truth_of("row"), "--json"}).out);
    const auto misses = score["misses"].size();
    CHECK(misses > 20);
    CHECK(few.out.find(fmt::format("... and {} more", misses - 20)) != std::string::npos);
    CHECK(few.out.find("-v") != std::string::npos);
    CHECK(lines(all.out) == static_cast<long>(1 + misses));
    CHECK(all.out.find(" more") == std::string::npos);
  }

  TEST_CASE("a missing truth is an unreadable input") {
    const Folder folder;
    const std::string records = records_of("house", folder);
    const Outcome missing = run({"score", records, "--truth", folder / "no.truth.json"});
    CHECK(missing.exit == 5);
    CHECK(missing.says("no.truth.json: E101"));
    CHECK(missing.out.empty());
    const Outcome empty = run({"score", records, "--truth", folder.path().string()});
    CHECK(empty.exit == 5);
    CHECK(empty.says("E101 the folder has no *.truth.json"));
  }

  TEST_CASE("missing records are an unreadable input") {
    const Outcome outcome = run({"score", "no.jsonl", "--truth", truth_of("house")});
    CHECK(outcome.exit == 5);
    CHECK(outcome.says("no.jsonl: E101"));
    CHECK(outcome.out.empty());
  }

  TEST_CASE("a record that cannot be read is left out") {
    const Folder folder;
    const std::string records = records_of("house", folder);
    folder.write("house.jsonl", bytes_of(records) + "{\"building\":1}\n");
    const Outcome outcome = run({"score", records, "--truth", truth_of("house")});
    CHECK(outcome.exit == 3);
    CHECK(outcome.says(records + ":54:"));
    CHECK(outcome.says("E111"));
    CHECK(outcome.out.find("\nwindow           16      0      0 ") != std::string::npos);
  }

  TEST_CASE("score writes its rows for each building and its curve") {
    const Folder folder;
    const std::string records = records_of("house", folder);
    const std::string rows = folder / "rows.csv", curve = folder / "curve.csv";
    REQUIRE(run({"score", records, "--truth", truth_of("house"), truth_of("row"), "--per-building",
                 rows, "--curve", curve})
                .exit == 3);
    CHECK(bytes_of(rows).starts_with(
        "building,class,tp,fp,fn,precision,recall,f1\nhouse,balcony,1,"));
    CHECK(bytes_of(rows).find("\nhouse,window,16,0,0,1,1,1\n") != std::string::npos);
    CHECK(bytes_of(rows).find("\nrow,window,0,0,") != std::string::npos);
    CHECK(
        bytes_of(curve).starts_with("class,threshold,tp,fp,fn,precision,recall,f1\nbalcony,1,1,"));
    CHECK(run({"score", records, "--truth", truth_of("house"), "--curve", folder / "no/c.csv"})
              .exit == 6);
  }

  TEST_CASE("score takes another overlap and gives intervals and areas") {
    const Folder folder;
    const std::string records = records_of("house", folder);
    const std::vector<std::string> call = {"score", records, "--truth", truth_of("house"),
                                           "--json"};
    const auto with = [&](std::vector<std::string> more) {
      std::vector<std::string> all = call;
      all.insert(all.end(), more.begin(), more.end());
      return run(all);
    };
    CHECK(json::parse(with({"--iou", "1"}).out)["classes"]["window"]["tp"] < 16);
    CHECK(with({"--iou", "0"}).exit == 2);
    CHECK(with({"--iou", "1.1"}).exit == 2);
    const json spread = json::parse(with({"--bootstrap", "50"}).out)["intervals"];
    CHECK(spread["samples"] == 50);
    CHECK(spread["f1"]["window"] == json::array({1, 1}));
    const json area = json::parse(with({"--models", sample("house")}).out)["area"];
    CHECK(area["macro_f1"] == 1);
    CHECK(area["classes"]["window"]["expected_m2"] > 10);
    const Outcome other = with({"--models", sample("row")});
    CHECK(other.says("house: E129 is in none of the models"));
    CHECK(json::parse(other.out)["area"]["compared_m2"] == 0);
    CHECK(with({"--models", "no.city.json"}).exit == 5);
  }
}
