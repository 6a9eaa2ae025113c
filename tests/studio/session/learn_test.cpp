#include "tests/studio/session/studio_bench.h"

#include <algorithm>

#include <doctest/doctest.h>

namespace oriel::test {

namespace {

json wait_for_learning(StudioBench& bench) {
  while (true) {
    json answer = bench.ask("learn", json::object());
    if (answer["state"] != "running") return answer;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
}

const char* const kSmallPack = R"(schema: oriel/1
pack: {name: small, version: 1.0.0}
params:
  lowest: {value: 3 m, range: 0.1 m .. 4 m, why: begins too high}
classes: {window: {}}
rules:
  - {id: window.any, label: window, require: [sense = hole, base_height >= $lowest, recess >= 0 m]}
)";

}  // namespace

TEST_SUITE("studio/session") {
  TEST_CASE("a curve has the F1 at every value of a param") {
    StudioBench bench;
    const double now = bench.pack(kSmallPack)["score"]["macro_f1"];
    const json curve = bench.ask("curve", {{"param", "lowest"}});
    const json& values = curve["values"];
    REQUIRE(values.size() == curve["f1"].size());
    CHECK(values.front() == 0.1);
    CHECK(values.back() == 4);
    CHECK(std::is_sorted(values.begin(), values.end()));
    const auto at = std::find(values.begin(), values.end(), curve["at"]) - values.begin();
    CHECK(curve["f1"][static_cast<std::size_t>(at)].get<double>() == doctest::Approx(now));
    const json best = *std::max_element(curve["f1"].begin(), curve["f1"].end());
    const auto place =
        std::find(curve["f1"].begin(), curve["f1"].end(), best) - curve["f1"].begin();
    const std::string value = values[static_cast<std::size_t>(place)].dump() + " m";
    const json set = bench.pack(kSmallPack, {{"params", {{"lowest", value}}}});
    CHECK(set["score"]["macro_f1"].get<double>() == doctest::Approx(best.get<double>()));
    const json of_class = bench.ask("curve", {{"param", "lowest"}, {"class", "window"}});
    CHECK(of_class["f1"].size() == of_class["values"].size());
    CHECK(bench.refusal("curve", R"({"param": "__proto__"})").first == 400);
  }

  TEST_CASE("what was learnt is the text with other values") {
    StudioBench bench;
    const double before = bench.pack(kSmallPack)["score"]["macro_f1"];
    CHECK(bench.ask("learn", json::object())["state"] == "idle");
    CHECK(bench.ask("learn", {{"objective", "macro_f1"}})["state"] == "running");
    const json learnt = wait_for_learning(bench);
    CHECK(learnt["state"] == "done");
    CHECK_FALSE(learnt["summary"].get<std::string>().empty());
    const json after = bench.pack(learnt["text"]);
    CHECK(after["is_good"] == true);
    CHECK(after["score"]["macro_f1"].get<double>() >= before);
    CHECK(bench.refusal("learn", R"({"objective": "<img>"})").first == 400);
  }

  TEST_CASE("a proposal of another rule is a text to accept with the labels promised") {
    StudioBench bench;
    const double before = bench.pack(kSmallPack)["score"]["macro_f1"];
    CHECK(bench.refusal("learn", R"({"accept": 0, "text": ""})").first == 409);
    bench.ask("learn", {{"objective", "macro_f1"}, {"propose", true}});
    const json learnt = wait_for_learning(bench);
    REQUIRE(learnt["state"] == "done");
    for (const json& proposal : learnt["proposals"]) {
      CAPTURE(proposal.dump());
      REQUIRE(proposal["why_not"] == "");
      const json after = bench.pack(proposal["text"]);
      CHECK(after["is_good"] == true);
      CHECK(after["score"]["macro_f1"].get<double>() - before ==
            doctest::Approx(proposal["gain"].get<double>()).epsilon(0.01));
    }
    if (learnt["proposals"].empty()) return;
    const json later =
        bench.ask("learn", {{"accept", 0}, {"text", std::string(kSmallPack) + "# mine\n"}});
    CHECK(later["text"] == learnt["proposals"][0]["text"].get<std::string>() + "# mine\n");
    CHECK(bench.ask("learn", {{"accept", 0}, {"text", later["text"]}})["text"] == "");
  }

  TEST_CASE("learning ends when it is told to and without truth it does not begin") {
    StudioBench bench;
    bench.ask("learn", {{"objective", "macro_f1"}});
    bench.ask("learn", {{"stop", true}});
    CHECK(wait_for_learning(bench)["state"] != "running");
    studio::SessionOptions options = sample_options();
    options.truth.clear();
    StudioBench without(options);
    CHECK(without.refusal("learn", R"({"objective": "macro_f1"})").first == 409);
    CHECK(without.refusal("curve", R"({"param": "parapet"})").first == 409);
  }

  TEST_CASE("the features that are asked for are in doubt the most") {
    const StudioFolder folder("ask");
    studio::SessionOptions options = sample_options();
    options.corrections = folder.file("corrections.jsonl");
    StudioBench bench(options);
    const json parts = bench.ask("ask", {{"count", 3}})["parts"];
    REQUIRE(parts.size() == 3);
    for (const json& part : parts) CHECK_FALSE(part["sentence"].get<std::string>().empty());
    bench.ask("correct", {{"building", parts[0]["building"]},
                          {"feature", parts[0]["feature"]},
                          {"class", "unknown"}});
    const json next = bench.ask("ask", {{"count", 2}})["parts"];
    CHECK(next[0] == parts[1]);
    CHECK(next[1] == parts[2]);
    CHECK(bench.ask("ask", {{"count", 0}})["parts"].empty());
  }
}

}  // namespace oriel::test
