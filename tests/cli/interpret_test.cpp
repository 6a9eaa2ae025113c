#include "tests/cli/command.h"

#include <chrono>
#include <csignal>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;

namespace {

/// A pack upon the default one with another upper size of windows.
std::string pack_with(const std::string& widest_window) {
  return "schema: oriel/1\npack: {name: mine, version: 1.0.0}\nextends: residential\n"
         "params: {widest_window: {value: " +
         widest_window + ", range: 0.1 m .. 6 m}}\n";
}

/// Features of two samples, made without rules.
std::string stored(const Folder& folder, const std::string& name = "parts.csv") {
  REQUIRE(
      run({"segment", sample("house"), sample("house-flush"), "--features", folder / name}).exit ==
      0);
  return folder / name;
}

/// JSON has no -0: it is read as 0.
std::string without_signs(std::string text) {
  for (std::size_t at = 0; (at = text.find(":-0,", at)) != std::string::npos;)
    text.erase(at + 1, 1);
  return text;
}

/// Waits until a file says something, no longer than some seconds.
bool comes_to_say(const std::string& path, const std::string& text) {
  for (int i = 0; i < 900; ++i) {
    if (bytes_of(path).find(text) != std::string::npos) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("stored features get the labels of their building byte for byte") {
    const Folder folder;
    for (const std::string extension : {".csv", ".jsonl", ".json"}) {
      CAPTURE(extension);
      const std::string labelled = folder / ("labelled" + extension);
      const std::string again = folder / ("again" + extension);
      REQUIRE(run({"label", sample("house"), sample("house-flush"), "--features", labelled}).exit ==
              0);
      const std::string bare = stored(folder, "bare" + extension);
      CHECK(bytes_of(bare) != bytes_of(labelled));
      const Outcome outcome = run({"interpret", bare, "-o", again});
      CHECK(outcome.exit == 0);
      CHECK(outcome.out.empty());
      CHECK(outcome.err.empty());
      CHECK((without_signs(bytes_of(again)) == without_signs(bytes_of(labelled))));
    }
  }

  TEST_CASE("jobs change nothing and one format may become another") {
    const Folder folder;
    const std::string bare = stored(folder);
    CHECK(run({"interpret", bare, "-o", folder / "one.jsonl"}).exit == 0);
    // More jobs than there are cores, too, are no word of warning.
    const Outcome many = run({"interpret", bare, "-j", "300", "-o", folder / "three.jsonl"});
    CHECK(many.exit == 0);
    CHECK(many.err.empty());
    CHECK(bytes_of(folder / "one.jsonl").find("\"label\":\"window\"") != std::string::npos);
    CHECK(bytes_of(folder / "one.jsonl") == bytes_of(folder / "three.jsonl"));
  }

  TEST_CASE("without output the labels are counted by rule") {
    const Folder folder;
    const Outcome outcome = run({"interpret", stored(folder)});
    CHECK(outcome.exit == 0);
    CHECK(outcome.out.starts_with("label "));
    CHECK(outcome.out.find("window.in_wall") != std::string::npos);
    CHECK(outcome.out.find("unknown") != std::string::npos);
  }

  TEST_CASE("interpret says in its exit code what went wrong") {
    const Folder folder;
    const std::string bare = stored(folder);
    CHECK(run({"interpret", folder / "none.csv"}).exit == 5);
    CHECK(run({"interpret", bare, "--rules", folder / "none.yaml"}).exit == 4);
    CHECK(run({"interpret", bare, "-o", "out.txt"}).exit == 2);
    CHECK(run({"interpret", bare, "--watch", "-o", folder / "x.csv"}).exit == 2);
    CHECK(run({"interpret", bare, "-o", folder / "no/such/folder.csv"}).exit == 6);
    const std::string bad = folder.write("bad.csv", "building,id,a_m\nh,f,1\nh,g,wide\n");
    const Outcome partly = run({"interpret", bad, "-o", folder / "partly.csv"});
    CHECK(partly.exit == 3);
    CHECK(partly.says("E111"));
    CHECK(bytes_of(folder / "partly.csv").find("\nh,f,") != std::string::npos);
    CHECK(run({"interpret", folder.write("no.csv", "x\n"), "-o", folder / "no-out.csv"}).exit == 5);
    CHECK(bytes_of(folder / "no-out.csv").empty());
  }

  TEST_CASE("diff says what a change of rules did and fails over a number") {
    const Folder folder;
    const std::string bare = stored(folder);
    const std::string rules = folder.write("mine.yaml", pack_with("0.31 m"));
    REQUIRE(run({"interpret", bare, "-o", folder / "a.csv"}).exit == 0);
    REQUIRE(run({"interpret", bare, "--rules", rules, "-o", folder / "b.jsonl"}).exit == 0);
    const Outcome text = run({"diff", folder / "a.csv", folder / "b.jsonl", "--examples", "1"});
    CHECK(text.exit == 0);
    CHECK(text.out.find("window -> unknown") != std::string::npos);
    CHECK(text.out.find("window.in_wall -> -") != std::string::npos);
    const Outcome outcome = run({"diff", folder / "a.csv", folder / "b.jsonl", "--json"});
    const auto diff = nlohmann::json::parse(outcome.out);
    const int changed = diff["changed"];
    CHECK(changed > 20);
    CHECK(diff["classes"]["window"]["after"] == 0);
    const auto exit_over = [&](int most) {
      return run({"diff", folder / "a.csv", folder / "b.jsonl", "--fail-over",
                  std::to_string(most)})
          .exit;
    };
    CHECK(exit_over(changed) == 0);
    CHECK(exit_over(changed - 1) == 3);
    CHECK(run({"diff", folder / "a.csv", folder / "a.csv", "--fail-over", "0"}).exit == 0);
    CHECK(run({"diff", folder / "a.csv", folder / "none.csv"}).exit == 5);
    CHECK(run({"diff", folder / "a.csv", folder.write("no.csv", "x\n")}).exit == 5);
  }

  TEST_CASE("watch interprets again when the pack is saved and says what changed") {
    const Folder folder;
    const std::string bare = stored(folder);
    const std::string base = folder.write("base.yaml", pack_with("5 m"));
    const std::string rules = folder.write(
        "mine.yaml", "schema: oriel/1\npack: {name: upper, version: 1.0.0}\nextends: base.yaml\n");
    const std::string out = folder.write("out.txt", "");
    std::vector<bool> seen;
    std::thread editor([&] {
      seen.push_back(comes_to_say(out, "window.in_wall"));
      folder.write("base.yaml", pack_with("0.31 m"));
      seen.push_back(comes_to_say(out, "window -> unknown"));
      folder.write("base.yaml", pack_with("wide"));
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      folder.write("base.yaml", pack_with("5.0 m"));
      seen.push_back(comes_to_say(out, "unknown -> window"));
      folder.write("stop.tmp-", "");
    });
    const Outcome outcome = run({"interpret", bare, "--rules", rules, "--watch"},
                                {.stdout_file = out, .signal = SIGINT, .watched = folder.path()});
    editor.join();
    CHECK(seen == std::vector{true, true, true});
    CHECK(outcome.exit == 128 + SIGINT);
    CHECK(outcome.says("base.yaml:4:"));
    CHECK(outcome.says("2 buildings in "));
  }
}
