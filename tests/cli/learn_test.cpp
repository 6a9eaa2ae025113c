#include "tests/cli/command.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;

namespace {

/// Records of all samples that are houses of their own.
std::string samples_labelled(const Folder& folder) {
  const std::string records = folder / "parts.jsonl";
  REQUIRE(run({"label", sample("house"), sample("hip"), sample("l-house"), "--features", records})
              .exit == 0);
  return records;
}

std::string truth_file(const std::string& name) {
  return std::string(ORIEL_SOURCE_DIR) + "/examples/samples/" + name + ".truth.json";
}

/// The id of the first feature of a building with that label.
std::string first_id_of(const std::string& records, const std::string& building,
                        const std::string& label) {
  std::ifstream file(records);
  for (std::string line; std::getline(file, line);) {
    const auto record = nlohmann::json::parse(line);
    if (record["building"] == building && record["label"] == label) return record["id"];
  }
  FAIL("no such feature");
  return {};
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("learn writes a pack that loads and says the same with any number of threads") {
    const Folder folder;
    const std::string records = samples_labelled(folder);
    Words words{"learn",
                records,
                "--truth",
                truth_file("house"),
                truth_file("hip"),
                truth_file("l-house"),
                "--leave-one-out",
                "--restarts",
                "0",
                "-o",
                folder / "one.yaml"};
    const Outcome one = run(words);
    CHECK(one.exit == 0);
    words.back() = folder / "two.yaml";
    words.insert(words.end(), {"-j", "2"});
    const Outcome two = run(words);
    CHECK(one.out == two.out);
    const std::string first = bytes_of(folder / "one.yaml");
    CHECK(first.find("extends: residential") != std::string::npos);
    CHECK(first.substr(first.find("extends")) ==
          bytes_of(folder / "two.yaml").substr(bytes_of(folder / "two.yaml").find("extends")));
    CHECK(run({"rules", "check", folder / "one.yaml"}).exit == 0);
    CHECK(one.out.find("held-out folds") != std::string::npos);
  }

  TEST_CASE("learn takes corrections for truth where there is no other") {
    const Folder folder;
    const std::string records = samples_labelled(folder);
    const auto learn_with = [&](Words more) {
      Words words{"learn", records, "--leave-one-out", "--restarts", "0"};
      words.insert(words.end(), more.begin(), more.end());
      return run(words);
    };
    CHECK(learn_with({}).exit == 2);
    CHECK(learn_with({"--truth", truth_file("house")}).says("R282"));
    const std::string corrections = folder.write(
        "c.jsonl", R"({"building": "hip", "feature": ")" + first_id_of(records, "hip", "window") +
                       R"(", "class": "window", "by": "ada", "why": "glass"})"
                       "\n"
                       R"({"building": "barn", "feature": "f1", "class": "window"})"
                       "\n");
    const Outcome both = learn_with({"--truth", truth_file("house"), "--corrections", corrections});
    CHECK(both.exit == 3);
    CHECK(both.says("E153"));
    CHECK(both.out.find("2 buildings") != std::string::npos);
  }

  TEST_CASE("learn says which columns its records lack") {
    const Folder folder;
    const std::string records = folder / "few.csv";
    REQUIRE(run({"segment", sample("house"), sample("hip"), "--features", records, "--columns",
                 "aabb_m,width_m,height_m"})
                .exit == 0);
    const Outcome outcome = run({"learn", records, "--truth", truth_file("house"),
                                 truth_file("hip"), "--leave-one-out", "--restarts", "0"});
    CHECK(outcome.exit == 3);
    CHECK_MESSAGE(outcome.says("E151"), outcome.err);
  }

  TEST_CASE("learn says that records are older than their models") {
    const Folder folder;
    const std::string records = samples_labelled(folder);
    const std::string model = folder.write("house.city.json", "{}");
    const auto learn_from_models = [&](std::chrono::hours later) {
      namespace fs = std::filesystem;
      fs::last_write_time(model, fs::last_write_time(records) + later);
      return run({"learn", records, "--truth", truth_file("house"), truth_file("hip"), "--models",
                  model, "--leave-one-out", "--restarts", "0", "--params", "parapet"});
    };
    const Outcome old = learn_from_models(std::chrono::hours(1));
    CHECK(old.exit == 0);
    CHECK_MESSAGE(old.says("R286"), old.err);
    CHECK_FALSE(learn_from_models(std::chrono::hours(-1)).says("R286"));
  }

  TEST_CASE("learn makes the F1 of a class or the cost of errors best") {
    const Folder folder;
    const std::string records = samples_labelled(folder);
    const auto learn_for = [&](Words more) {
      Words words{"learn",           records,           "--truth",    truth_file("house"),
                  truth_file("hip"), "--leave-one-out", "--restarts", "0"};
      words.insert(words.end(), more.begin(), more.end());
      return run(words);
    };
    CHECK(learn_for({"--objective", "door"}).out.find("F1 of door") != std::string::npos);
    const std::string costs = folder.write("costs.csv", "door,-,5\n-,door,1\n");
    const Outcome cheap = learn_for({"--objective", "cost", "--costs", costs});
    CHECK(cheap.exit == 0);
    CHECK(cheap.out.find("cost on 2 buildings") != std::string::npos);
    const Outcome wrong =
        learn_for({"--objective", "cost", "--costs", folder.write("wrong.csv", "door\n")});
    CHECK(wrong.exit == 4);
    CHECK(wrong.says("R211"));
  }

  TEST_CASE("learn writes nothing where it cannot learn") {
    const Folder folder;
    const std::string records = samples_labelled(folder);
    const std::string out = folder / "learnt.yaml";
    const auto refused = [&](Words words, const std::string& code) {
      words.insert(words.begin(), {"learn", records});
      words.insert(words.end(), {"-o", out});
      const Outcome outcome = run(words);
      CHECK(outcome.exit == 4);
      CHECK(outcome.err.find(code) != std::string::npos);
      CHECK_FALSE(std::filesystem::exists(out));
    };
    refused({"--truth", truth_file("row")}, "R284");
    refused({"--truth", truth_file("house")}, "R282");
    refused({"--truth", truth_file("house"), truth_file("hip"), "--objective", "vent"}, "R283");
    refused({"--truth", truth_file("house"), truth_file("hip"), "--params", "parpet"},
            "did you mean 'parapet'");
    CHECK(run({"learn", records, "--truth", truth_file("house"), "--objective", "best"}).exit == 2);
    CHECK_FALSE(std::filesystem::exists(out));
  }
}
