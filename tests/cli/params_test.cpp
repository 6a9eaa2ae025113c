#include "tests/cli/command.h"

#include <chrono>
#include <csignal>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;

namespace {

/// A value that takes the labels of some windows of the samples.
constexpr const char* kNarrow = "widest_window=1.0 m";

/// A pack upon the default one, in which windows may be much narrower at most.
std::string wide_range(const std::string& widest_window) {
  return "schema: oriel/1\npack: {name: mine, version: 1.0.0}\nextends: residential\n"
         "params: {widest_window: {value: " +
         widest_window + ", range: 0.1 m .. 6 m}}\n";
}

/// Waits until a file says something, no longer than some seconds.
bool is_said(const std::string& path, const std::string& text) {
  for (int i = 0; i < 900; ++i) {
    if (bytes_of(path).find(text) != std::string::npos) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  return false;
}

/// Two packs of the same rules: one states the value, of the other it is set.
struct TwoPacks {
  Folder folder;
  std::string stated = folder.write("stated.yaml", wide_range("1.0 m"));
  std::string set = folder.write("set.yaml", wide_range("5 m"));

  /// The file `name` that the command writes by either pack.
  [[nodiscard]] bool are_same(const std::vector<std::string>& command, const std::string& option,
                              const std::string& name) const {
    const auto written = [&](const std::string& as, const std::vector<std::string>& rules) {
      std::vector<std::string> call = command;
      call.insert(call.end(), {option, folder / (as + name)});
      call.insert(call.end(), rules.begin(), rules.end());
      CHECK(run(call).exit == 0);
      return bytes_of(folder / (as + name));
    };
    const std::string without = written("without_", {"--rules", set});
    const std::string by_param = written("by_param_", {"--rules", set, "--param", kNarrow});
    CHECK(by_param != without);
    CHECK(!by_param.empty());
    return by_param == written("by_pack_", {"--rules", stated});
  }
};

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("a param that is set does what a pack that states it does") {
    const TwoPacks packs;
    const std::string house = sample("house");
    CHECK(packs.are_same({"label", house}, "--features", "label.csv"));
    CHECK(packs.are_same(
        {"generalise", house, "--scale", "500", "-o", "/dev/null", "--to", "cityjson"},
        "--features", "generalise.jsonl"));
    const std::string bare = packs.folder / "bare.csv";
    REQUIRE(run({"segment", house, "--features", bare}).exit == 0);
    CHECK(packs.are_same({"interpret", bare}, "-o", "interpret.csv"));
    const auto said = [&](std::vector<std::string> call, const std::vector<std::string>& rules) {
      call.insert(call.end(), rules.begin(), rules.end());
      return run(call).out;
    };
    for (const std::vector<std::string>& call :
         {std::vector<std::string>{"explain", house},
          {"score", "--surfaces",
           std::string(ORIEL_SOURCE_DIR) + "/examples/samples/house.labelled.city.json"}}) {
      CAPTURE(call.front());
      CHECK(said(call, {"--rules", packs.set, "--param", kNarrow}) ==
            said(call, {"--rules", packs.stated}));
    }
    CHECK(run({"view", house, "--param", "widest_window=2.5 m", "-o", packs.folder / "page.html"})
              .exit == 0);
  }

  TEST_CASE("outputs know the params that were set") {
    const Folder folder;
    const auto hash = [&](const std::vector<std::string>& more) {
      std::vector<std::string> call = {"label",    sample("house"), "-o", folder / "out.city.json",
                                       "--status", folder / "s"};
      call.insert(call.end(), more.begin(), more.end());
      CHECK(run(call).exit == 0);
      const std::string in_status =
          nlohmann::json::parse(bytes_of(folder / "s.status.json"))["rules_sha256"];
      CHECK(bytes_of(folder / "out.city.json").find(in_status) != std::string::npos);
      return in_status;
    };
    const std::string plain = hash({});
    CHECK(hash({"--param", "parapet=0.8 m"}) != plain);
    CHECK(hash({"--param", "parapet=80 cm"}) == hash({"--param=parapet=0.8 m"}));
    CHECK(hash({"--param", "parapet=0.9 m"}) == plain);
  }

  TEST_CASE("results of other params are not used again") {
    const Folder folder;
    const std::string stream = folder.write("in.city.jsonl", run({"cat", sample("house")}).out);
    const auto labelled = [&](const std::vector<std::string>& more) {
      std::vector<std::string> call = {"label",    stream,      "-o", folder / "out.city.jsonl",
                                       "--status", folder / "s"};
      call.insert(call.end(), more.begin(), more.end());
      return run(call);
    };
    const std::vector<std::string> reuse = {"--reuse", folder / "s.status.json"};
    // The first run has nothing to take from, and leaves what later ones need.
    CHECK(labelled({"--param", "widest_window=2.5 m", reuse[0], reuse[1]}).says("E124"));
    CHECK(!labelled({"--param", "widest_window=2.5 m", reuse[0], reuse[1]}).says("E124"));
    CHECK(labelled({"--param", "widest_window=2.6 m", reuse[0], reuse[1]}).says("E124"));
    CHECK(labelled({reuse[0], reuse[1]}).says("E124"));
  }

  TEST_CASE("a param that cannot be set is named and nothing is written") {
    const Folder folder;
    const std::string out = folder / "out.csv";
    const auto refused = [&](const std::string& param, const std::string& code) {
      CAPTURE(param);
      const Outcome outcome = run({"label", sample("house"), "--features", out, "--param", param});
      CHECK(outcome.exit == 4);
      CHECK(outcome.says("--param " + param + ": " + code));
      CHECK(folder.names().empty());
    };
    refused("widest_window", "R211");
    refused("widest_windw=3 m", "R206 unknown param 'widest_windw'; did you mean 'widest_window'?");
    refused("widest_window=3 deg", "R230");
    refused("widest_window=3", "R231");
    refused("widest_window=7 m", "R212 7 m is outside the range of 'widest_window', 2.5 m .. 6 m");
    const std::string rules = folder.write(
        "sizes.yaml",
        "schema: oriel/1\npack: {name: mine, version: 1.0.0}\nextends: residential\n"
        "params: {low: {value: 1 m, range: 0.5 m .. 3 m}, high: {value: 2 m, range: 0.5 m .. 3 "
        "m}}\n"
        "rules: [{id: vent.mine, label: vent, require: width in $low .. $high}]\n");
    const Outcome empty = run({"label", sample("house"), "--rules", rules, "--param", "low=2.5 m"});
    CHECK(empty.exit == 4);
    CHECK(empty.says("--param low=2.5 m: R212 with this value the pack would be refused"));
    CHECK(run({"label", sample("house"), "--rules", rules, "--param", "low=2.5 m", "--param",
               "high=2.6 m"})
              .exit == 0);
  }

  TEST_CASE("watch keeps the params that are set and waits out a pack without them") {
    const Folder folder;
    const std::string bare = folder / "bare.csv";
    REQUIRE(run({"segment", sample("house"), "--features", bare}).exit == 0);
    const std::string rules = folder.write("mine.yaml", wide_range("5 m"));
    const std::string out = folder.write("out.txt", "");
    std::vector<bool> seen;
    std::thread editor([&] {
      seen.push_back(is_said(out, "label "));
      const std::string without =
          "schema: oriel/1\npack: {name: mine, version: 1.0.0}\nextends: surfaces-only\n";
      folder.write("mine.yaml", without);
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      folder.write("mine.yaml", wide_range("4.9 m"));
      seen.push_back(is_said(out, "0 of "));
      folder.write("stop.tmp-", "");
    });
    const Outcome outcome =
        run({"interpret", bare, "--rules", rules, "--param", kNarrow, "--watch"},
            {.stdout_file = out, .signal = SIGINT, .watched = folder.path()});
    editor.join();
    CHECK(seen == std::vector{true, true});
    CHECK(outcome.exit == 128 + SIGINT);
    CHECK(outcome.says("--param widest_window=1.0 m: R206"));
  }
}
