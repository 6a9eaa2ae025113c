#include "oriel/label.h"
#include "oriel/rules.h"
#include "tests/studio/session/studio_bench.h"

#include <future>

#include <doctest/doctest.h>

namespace oriel::test {

namespace {

int class_number(const json& answer, const std::string& name) {
  for (std::size_t i = 0; i < answer["classes"].size(); ++i)
    if (answer["classes"][i]["name"] == name) return static_cast<int>(i);
  return -1;
}

std::size_t count_of(const json& answer, const std::string& name) {
  for (const json& row : answer["counts"])
    if (row["class"] == name) return row["count"];
  return 0;
}

}  // namespace

TEST_SUITE("studio/session") {
  TEST_CASE("a pack labels as label does") {
    StudioBench bench;
    const json answer = bench.pack(bench.pack_text(), {{"since", 0}});
    CHECK(answer["is_good"] == true);
    const auto rules = load_pack_file("residential");
    const json state = bench.ask("state", json::object());
    REQUIRE(state["buildings"].size() == 2);
    for (std::size_t b = 0; b < 2; ++b) {
      const auto documents = read(sample_options().files[b]);
      const PipelineResult result = label(documents.value->front().buildings.front(), *rules.value);
      const json& labels = answer["labels"][std::to_string(b)];
      REQUIRE(labels.size() == result.interpretation.verdicts.size());
      CHECK(state["buildings"][b]["features"] == labels.size());
      for (std::size_t f = 0; f < labels.size(); ++f) {
        const std::string expected = result.interpretation.verdicts[f].label.text();
        const int number = labels[f];
        CHECK((number < 0 ? "" : answer["classes"][static_cast<std::size_t>(number)]["name"]) ==
              expected);
      }
    }
  }

  TEST_CASE("only what changed is sent again") {
    StudioBench bench;
    const std::string text = bench.pack_text();
    const json first = bench.pack(text);
    CHECK(first["labels"].size() == 2);
    const json second = bench.pack(text + "\n# a remark\n");
    CHECK(second["labels"].empty());
    CHECK(second["changed_count"] == 0);
    CHECK(second["score"] == first["score"]);
    CHECK(bench.pack(text, {{"since", first["number"]}})["labels"].empty());
    CHECK(bench.pack(text, {{"since", 0}})["labels"].size() == 2);
    CHECK(bench.pack(text, {{"since", 0}})["labels"] == first["labels"]);
  }

  TEST_CASE("a page gets what changed since its own answer whatever other pages asked") {
    StudioBench bench;
    const std::string text = bench.pack_text();
    const json first = bench.pack(text);
    std::string other = text;
    const std::size_t at = other.find("widest_window:");
    const std::size_t value = other.find("5 m", at);
    REQUIRE(value != std::string::npos);
    other.replace(value, 3, "3 m");
    const json of_other_page = bench.pack(other);
    const json later = bench.pack(other + "\n", {{"since", first["number"]}});
    CHECK(later["labels"] == of_other_page["labels"]);
  }

  TEST_CASE("a page whose answer came from a worker before this one gets all labels") {
    StudioBench bench;
    const std::string text = bench.pack_text();
    bench.pack(text);
    CHECK(bench.pack(text, {{"since", 1000}})["labels"].size() == 2);
  }

  TEST_CASE("a changed rule lists the labels before and after") {
    StudioBench bench;
    const std::string text = bench.pack_text();
    const json before = bench.pack(text);
    const json after = bench.pack(
        replaced(text, "- id: window.in_wall", "- id: window.in_wall\n    unless: [width > 0 m]"));
    REQUIRE(after["is_good"] == true);
    CHECK(after["changed_count"].get<std::size_t>() == after["changed"].size());
    CHECK(after["changed"].size() == count_of(before, "window") - count_of(after, "window"));
    for (const json& change : after["changed"])
      CHECK(change["before"] == class_number(before, "window"));
    CHECK(after["score"]["macro_f1"].get<double>() < before["score"]["macro_f1"].get<double>());
  }

  TEST_CASE("a broken pack says what is wrong and keeps the labels") {
    StudioBench bench;
    const std::string text = bench.pack_text();
    const json good = bench.pack(text, {{"since", 0}});
    const json broken = bench.pack(replaced(text, "base_height", "base_hieght"));
    CHECK(broken["is_good"] == false);
    CHECK_FALSE(broken.contains("labels"));
    REQUIRE(broken["findings"].size() == 1);
    const json& finding = broken["findings"][0];
    CHECK(finding["code"] == "R204");
    CHECK(finding["end_column"].get<int>() - finding["column"].get<int>() == 11);
    CHECK_FALSE(finding["advice"].get<std::string>().empty());
    CHECK(bench.ask("explain", {{"building", 0}, {"feature", 0}})["label"] != "");
    CHECK(bench.pack(text)["labels"].empty());
    CHECK(bench.pack("")["is_good"] == false);
    CHECK(bench.refusal("pack", "{\"version\": 1, \"text\": \"\xFF\"}").first == 400);
  }

  TEST_CASE("params are set to other values and listed with their place") {
    StudioBench bench;
    const std::string text = bench.pack_text();
    const json plain = bench.pack(text);
    REQUIRE_FALSE(plain["params"].empty());
    const json& param = plain["params"][0];
    const std::string name = param["name"], value = param["text"];
    CHECK(param["line"].get<int>() > 0);
    const json same = bench.pack(text, {{"params", {{name, value}}}});
    CHECK(same["is_good"] == true);
    CHECK(same["labels"].empty());
    const json wrong = bench.pack(text, {{"params", {{"__proto__", "1 m"}}}});
    CHECK(wrong["is_good"] == false);
    CHECK(wrong["findings"][0]["code"] == "R206");
  }

  TEST_CASE("the score is that of the command and its parts are features") {
    StudioBench bench;
    const json answer = bench.pack(bench.pack_text());
    const json& score = answer["score"];
    std::size_t right = 0;
    for (const json& cell : score["confusion"]) {
      const bool is_missed = cell["label"] == "-";
      CHECK((is_missed ? cell["missed"].size() : cell["parts"].size()) == cell["count"]);
      if (cell["truth"] == cell["label"]) right += cell["count"].get<std::size_t>();
    }
    std::size_t found = 0;
    for (const json& c : score["classes"]) found += c["found"].get<std::size_t>();
    CHECK(found == right);
    std::size_t by_rule = 0;
    for (const json& rule : score["rules"]) {
      by_rule += rule["right"].get<std::size_t>();
      CHECK(rule["line"].get<int>() > 0);
    }
    CHECK(by_rule == right);
    CHECK(score["macro_f1"].get<double>() > 0.9);
  }

  TEST_CASE("of packs that wait the newest wins") {
    StudioBench bench;
    const std::string text = bench.pack_text();
    std::vector<std::future<int>> replies;
    for (int i = 0; i < 8; ++i)
      replies.push_back(std::async(std::launch::async, [&bench, &text, i] {
        const json body{{"text", text + "\n# " + std::to_string(i)}, {"version", i}};
        return bench.reply("pack", body.dump()).status;
      }));
    int good = 0;
    for (auto& reply : replies) {
      const int status = reply.get();
      CHECK((status == 200 || status == 409));
      if (status == 200) ++good;
    }
    CHECK(good >= 1);
  }
}

}  // namespace oriel::test
