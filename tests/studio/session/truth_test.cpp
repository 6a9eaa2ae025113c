#include "tests/studio/session/studio_bench.h"

#include <doctest/doctest.h>

namespace oriel::test {

TEST_SUITE("studio/session") {
  TEST_CASE("true objects lie where features are") {
    StudioBench bench;
    const json truth = bench.ask("truth", {{"buildings", {0}}});
    std::size_t windows = 0;
    for (const json& object : truth["objects"]) {
      CHECK(object["building"] == 0);
      if (object["class"] == "window") ++windows;
    }
    CHECK(windows > 0);
  }

  TEST_CASE("a correction is written and counts as truth and can be withdrawn") {
    const StudioFolder folder("corrections");
    studio::SessionOptions options = sample_options();
    options.truth.clear();
    options.corrections = folder.file("corrections.jsonl");
    StudioBench bench(options);
    const std::string text = bench.pack_text();
    CHECK(bench.pack(text)["score"].is_null());
    const json window = bench.ask("search", {{"text", "window"}})["parts"][0];
    const json body{{"building", window[0]}, {"feature", window[1]}};
    json wrong = body;
    wrong.update(
        {{"class", "door"}, {"by", "ada <img onerror=x>"}, {"why", "it has a \"handle\""}});
    CHECK(bench.ask("correct", wrong)["count"] == 1);
    const json score = bench.pack(text)["score"];
    REQUIRE(score["confusion"].size() == 1);
    CHECK(score["confusion"][0]["truth"] == "door");
    CHECK(score["confusion"][0]["label"] == "window");
    CHECK(score["confusion"][0]["parts"][0] == window);
    CHECK(bench.ask("explain", body)["correction"]["why"] == "it has a \"handle\"");
    const json list = bench.ask("corrections", json::object())["list"];
    REQUIRE(list.size() == 1);
    CHECK(list[0]["feature"] == window[1]);
    CHECK(list[0]["class"] == "door");

    StudioBench again(options);
    CHECK(again.ask("corrections", json::object())["list"] == list);
    json right = body;
    right["class"] = "unknown";
    CHECK(again.ask("correct", right)["count"] == 1);
    CHECK(folder.read("corrections.jsonl").find("unknown") != std::string::npos);
    right["class"] = nullptr;
    CHECK(again.ask("correct", right)["count"] == 0);
    CHECK(folder.read("corrections.jsonl").empty());
    CHECK(again.pack(text)["score"].is_null());
  }

  TEST_CASE("a file of corrections with lines that cannot be read is not written over") {
    const StudioFolder folder("broken-corrections");
    folder.write("corrections.jsonl", "{\"building\": 3}\n");
    studio::SessionOptions options = sample_options();
    options.corrections = folder.file("corrections.jsonl");
    StudioBench bench(options);
    CHECK(bench.refusal("correct", R"({"building": 0, "feature": 0, "class": "door"})").first ==
          409);
    CHECK(folder.read("corrections.jsonl") == "{\"building\": 3}\n");
  }
}

}  // namespace oriel::test
