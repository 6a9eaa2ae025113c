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

  TEST_CASE("what others write into the file of corrections stays") {
    const StudioFolder folder("others");
    studio::SessionOptions options = sample_options();
    options.corrections = folder.file("corrections.jsonl");
    const std::string seen =
        "{\"building\": \"elsewhere\", \"feature\": \"f\",  \"class\": \"door\", \"seen_on\": "
        "[1]}\n";
    folder.write("corrections.jsonl", seen);
    StudioBench one(options), two(options);
    const auto correct = [](StudioBench& bench, int feature, const json& name) {
      return bench.reply("correct",
                         json{{"building", 0}, {"feature", feature}, {"class", name}}.dump());
    };
    CHECK(correct(one, 0, "door").status == 200);
    CHECK(correct(two, 1, "window").status == 200);
    const std::string others = "{\"building\": \"x\", \"feature\": \"y\", \"class\": \"vent\"}";
    folder.write("corrections.jsonl", folder.read("corrections.jsonl") + others);
    CHECK(json::parse(correct(one, 2, "door").json)["count"] == 5);
    CHECK(one.ask("corrections", json::object())["list"].size() == 5);
    const std::string text = folder.read("corrections.jsonl");
    CHECK(text.starts_with(seen));
    CHECK(text.find(others + "\n") != std::string::npos);

    // Both say what one part is: the later one is asked, and then may say it again.
    const studio::Reply refused = correct(two, 2, "vent");
    REQUIRE(refused.status == 409);
    const json told = json::parse(refused.json);
    CHECK(told["disk_text"].get<std::string>().find("\"class\":\"door\"") != std::string::npos);
    CHECK(told["own_text"].get<std::string>().find("\"class\":\"vent\"") != std::string::npos);
    CHECK(folder.read("corrections.jsonl") == text);
    CHECK(json::parse(correct(two, 2, "vent").json)["count"] == 5);
    CHECK(json::parse(correct(two, 2, nullptr).json)["count"] == 4);
    CHECK(folder.read("corrections.jsonl").starts_with(seen));
  }

  TEST_CASE("corrections of several studios at once are all kept") {
    const StudioFolder folder("many");
    studio::SessionOptions options = sample_options();
    options.corrections = folder.file("corrections.jsonl");
    StudioBench one(options), two(options);
    const auto correct_all = [](StudioBench& bench, int from) {
      for (int feature = from; feature < 16; feature += 2)
        bench.ask("correct", {{"building", 0}, {"feature", feature}, {"class", "door"}});
    };
    std::thread other([&] { correct_all(two, 1); });
    correct_all(one, 0);
    other.join();
    StudioBench again(options);
    CHECK(again.ask("corrections", json::object())["list"].size() == 16);
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
