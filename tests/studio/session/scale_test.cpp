#include "tests/studio/session/studio_bench.h"

#include <atomic>
#include <set>

#include <doctest/doctest.h>

namespace oriel::test {

namespace {

void check_drawing(const json& drawing) {
  const std::size_t vertices = drawing["vertices_mm"].size() / 3;
  CHECK(vertices > 0);
  CHECK_FALSE(drawing["polygons"].empty());
  for (const json& polygon : drawing["polygons"])
    for (const json& ring : polygon["rings"])
      for (const json& v : ring) CHECK(v.get<std::size_t>() < vertices);
}

}  // namespace

TEST_SUITE("studio/session") {
  TEST_CASE("a building is drawn for a scale with what was done to its parts") {
    StudioBench bench;
    const std::size_t features = bench.pack(bench.pack_text())["labels"]["0"].size();
    const json fine = bench.ask("scale", {{"building", 0}, {"scale", 1}});
    const json coarse = bench.ask("scale", {{"building", 0}, {"scale", 10000}});
    check_drawing(fine);
    check_drawing(coarse);
    CHECK(fine["is_valid"] == true);
    CHECK(coarse["polygons"].size() < fine["polygons"].size());
    CHECK(coarse["outcomes"].size() > fine["outcomes"].size());
    for (const json& outcome : coarse["outcomes"]) {
      CHECK(outcome["feature"].get<int>() < static_cast<int>(features));
      CHECK_FALSE(outcome["sentence"].get<std::string>().empty());
    }
    std::set<int> shown;
    for (const json& polygon : fine["polygons"]) shown.insert(polygon["feature"].get<int>());
    CHECK(shown.size() > 5);
    CHECK(bench.ask("scale", {{"building", 0}, {"scale", 10000}}) == coarse);
  }

  TEST_CASE("a level of detail is a block of few faces") {
    StudioBench bench;
    const json block = bench.ask("scale", {{"building", 0}, {"lod", "1.2"}});
    check_drawing(block);
    CHECK(block["polygons"].size() < 12);
  }

  TEST_CASE("another entry for a scale draws it anew") {
    StudioBench bench;
    const std::string text = bench.pack_text();
    bench.pack(text);
    const json before = bench.ask("scale", {{"building", 0}, {"scale", 1000}});
    const std::string all_go = "  - {id: all.omit, scale: \"1:1 ..\", for: window, do: omit}\n";
    const std::string first = "  - {id: vents.omit,";
    const json pack = bench.pack(replaced(text, first, all_go + first));
    REQUIRE(pack["is_good"] == true);
    CHECK(pack["labels"].empty());
    const json after = bench.ask("scale", {{"building", 0}, {"scale", 1000}});
    CHECK(after["polygons"].size() < before["polygons"].size());
  }

  TEST_CASE("a drawing that something newer overtakes or that is stopped ends") {
    StudioBench bench;
    bench.pack(bench.pack_text());
    std::atomic<bool> is_over = false;
    std::atomic<int> overtaken = 0, drawn = 0;
    // Each drawing is a new one: none is kept of those that were given up.
    const auto ask = [&](int building) {
      for (int scale = 2000; !is_over; ++scale) {
        const auto reply =
            bench.reply("scale", json{{"building", building}, {"scale", scale}}.dump());
        CHECK((reply.status == 200 || reply.status == 409));
        if (reply.status == 409) CHECK(json::parse(reply.json)["superseded"] == true);
        ++(reply.status == 409 ? overtaken : drawn);
      }
    };
    std::thread one(ask, 0), other(ask, 1);
    std::set<std::string> stages;
    while (overtaken < 3 || stages.empty()) {
      const json progress = bench.ask("scale", {{"progress", true}});
      if (progress["state"] != "running") continue;
      CHECK(progress["building"].get<int>() < 2);
      CHECK(progress["target"].get<std::string>().starts_with("1:2"));
      stages.insert(progress["stage"].get<std::string>());
    }
    for (const int before = overtaken; overtaken == before;) bench.ask("scale", {{"stop", true}});
    is_over = true;
    one.join();
    other.join();
    CHECK(bench.ask("scale", {{"progress", true}})["state"] == "idle");
    const json last = bench.ask("scale", {{"building", 0}, {"scale", 2000}});
    check_drawing(last);
    CHECK(last["note"].get<std::string>().starts_with("this building is drawn alone"));
  }

  TEST_CASE("what is no scale is refused") {
    StudioBench bench;
    for (const char* body :
         {R"({"building": 0})", R"({"building": 0, "scale": 0})",
          R"({"building": 0, "scale": "1"})", R"({"building": 0, "scale": -5})",
          R"({"building": 0, "lod": "9.9"})", R"({"building": 0, "lod": "../x"})",
          R"({"building": 7, "scale": 1})"}) {
      CAPTURE(body);
      CHECK(bench.refusal("scale", body).first == 400);
    }
  }
}

}  // namespace oriel::test
