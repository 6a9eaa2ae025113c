#include "tests/cli/command.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

std::vector<json> labelled_records(const Folder& folder, const std::vector<std::string>& more,
                                   int exit = 0) {
  std::vector<std::string> call = {"label", sample("house"), "--features", folder / "parts.jsonl"};
  call.insert(call.end(), more.begin(), more.end());
  CHECK(run(call).exit == exit);
  std::vector<json> records;
  for (const std::string& line : lines_of(bytes_of(folder / "parts.jsonl")))
    records.push_back(json::parse(line));
  return records;
}

const json& record_with(const std::vector<json>& records, const std::string& id) {
  return *std::ranges::find_if(records, [&](const json& record) { return record["id"] == id; });
}

std::string first_window(const std::vector<json>& records) {
  return std::ranges::find_if(records,
                              [](const json& record) { return record["label"] == "window"; })
      ->at("id");
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a corrected feature has the right class and says who corrected it and why") {
    const Folder folder;
    const auto before = labelled_records(folder, {});
    const std::string window = first_window(before);
    const std::string file = folder.write("corrections.jsonl", json{{"building", "house"},
                                                                    {"feature", window},
                                                                    {"class", "door"},
                                                                    {"by", "ada"},
                                                                    {"why", "it has a handle"}}
                                                                       .dump() +
                                                                   "\n");
    const auto after = labelled_records(folder, {"--corrections", file});
    const json& record = record_with(after, window);
    CHECK(record["label"] == "door");
    CHECK(record["rule"] == "corrected");
    CHECK(record["runner_up"] == "window");
    CHECK(record["corrected_by"] == "ada");
    CHECK(record["corrected_why"] == "it has a handle");
    for (std::size_t i = 0; i < before.size(); ++i)
      if (before[i]["id"] != window) CHECK(after[i]["label"] == before[i]["label"]);
    const Outcome text = run({"explain", sample("house"), window, "--corrections", file});
    CHECK(text.out.starts_with("corrected to door by ada (" + file +
                               ":1): it has a handle; the rules say:\n"));
    CHECK(text.out.find("is labelled window by") != std::string::npos);
    const json explained =
        json::parse(run({"explain", sample("house"), window, "--corrections", file, "--json"}).out);
    CHECK(explained["corrected"]["by"] == "ada");
    CHECK(explained["label"] == "window");
    const json all =
        json::parse(run({"explain", sample("house"), "--corrections", file, "--json"}).out);
    std::size_t corrected = 0;
    for (const json& feature : all["features"]) {
      corrected += feature.contains("corrected") ? 1 : 0;
      if (feature["feature"] == window) CHECK(feature["corrected"]["label"] == "door");
    }
    CHECK(corrected == 1);
    // Outputs know it.
    const auto hash = [&](const std::vector<std::string>& more) {
      std::vector<std::string> call = {"label",    sample("house"), "-o", folder / "o.city.json",
                                       "--status", folder / "s"};
      call.insert(call.end(), more.begin(), more.end());
      CHECK(run(call).exit == 0);
      const std::string sha = json::parse(bytes_of(folder / "s.status.json"))["config_sha256"];
      CHECK(bytes_of(folder / "o.city.json").find(sha) != std::string::npos);
      return sha;
    };
    CHECK(hash({}) != hash({"--corrections", file}));
  }

  TEST_CASE("the reason in the output says who corrected a feature and what the rules say") {
    const Folder folder;
    const std::string window = first_window(labelled_records(folder, {}));
    const std::string file = folder.write("c.jsonl", R"({"building":"house","feature":")" + window +
                                                         R"(","class":"door","by":"ada","why":"it )"
                                                         R"(has a handle"})"
                                                         "\n");
    const auto reasons = [&](const std::vector<std::string>& more) {
      std::vector<std::string> call = {"label", sample("house"), "--explain", "-o",
                                       folder / "out.city.json"};
      call.insert(call.end(), more.begin(), more.end());
      CHECK(run(call).exit == 0);
      std::map<std::string, std::string> by_feature;
      const json city = json::parse(bytes_of(folder / "out.city.json"));
      for (const json& object : city["CityObjects"])
        for (const json& geometry : object.value("geometry", json::array()))
          for (const json& surface : geometry["semantics"]["surfaces"])
            if (surface.contains("oriel_id"))
              by_feature[surface["oriel_id"]] = surface["oriel_why"];
      return by_feature;
    };
    auto before = reasons({});
    auto after = reasons({"--corrections", file});
    CHECK(after[window] ==
          "corrected to door by ada: it has a handle; the rules say: " + before[window]);
    // Others are explained by what the rules said of it.
    after[window] = before[window];
    CHECK(after == before);
  }

  TEST_CASE("corrections that cannot be followed are named with their lines") {
    const Folder folder;
    const std::string window = first_window(labelled_records(folder, {}));
    const std::string feature = R"("building":"house","feature":")" + window + R"(","class":)";
    const auto label_with = [&](const std::string& text) {
      return run({"label", sample("house"), "--features", folder / "p.csv", "--corrections",
                  folder.write("c.jsonl", text)});
    };
    const std::string place = folder / "c.jsonl:1: ";
    const auto says = [&](const std::string& text, const std::string& what, int exit) {
      CAPTURE(text);
      const Outcome outcome = label_with(text + "\n");
      CHECK(outcome.exit == exit);
      CHECK(outcome.says(what));
    };
    says("{" + feature + "\"doer\"}", place + "E153 the pack has no class 'doer'", 3);
    says("{" + feature + "7}", place + "E152", 3);
    says(R"({"building":"hous","feature":"f","class":"door"})",
         place + "E153 there is no building 'hous'; did you mean 'house'?", 3);
    says(R"({"building":"house","feature":"f","class":"door"})",
         "E153 the building 'house' has no feature 'f'", 0);
    says(R"({"building":"house","point":[900,0,0],"class":"door"})", "E153 no feature", 0);
    says("{" + feature + "\"door\"}\n{" + feature + "\"bay\"}", "E154 the feature '" + window, 0);
    CHECK(run({"label", sample("house"), "--corrections", folder / "none.jsonl"}).exit == 5);
  }

  TEST_CASE("score takes corrections for truth") {
    const Folder folder;
    const auto records = labelled_records(folder, {});
    const std::string window = first_window(records);
    const std::string file = folder.write("c.jsonl", R"({"building":"house","feature":")" + window +
                                                         R"(","class":"window"})"
                                                         "\n");
    const Outcome outcome = run({"score", folder / "parts.jsonl", "--corrections", file, "--json"});
    CHECK(outcome.exit == 0);
    const json score = json::parse(outcome.out);
    CHECK(score["classes"].size() == 1);
    CHECK(score["classes"]["window"]["tp"] == 1);
    CHECK(score["classes"]["window"]["fp"] == 0);
    const std::string truth = std::string(ORIEL_SOURCE_DIR) + "/examples/samples/house.truth.json";
    const std::vector<std::string> with_truth = {"score", folder / "parts.jsonl", "--truth", truth,
                                                 "--json"};
    auto with_both = with_truth;
    with_both.insert(with_both.end(), {"--corrections", file});
    CHECK(run(with_both).out == run(with_truth).out);
    const std::string other =
        folder.write("other.jsonl", R"({"building":"x","feature":"f","class":"door"})"
                                    "\n");
    CHECK(run({"score", folder / "parts.jsonl", "--corrections", other}).says("E153"));
  }
}
