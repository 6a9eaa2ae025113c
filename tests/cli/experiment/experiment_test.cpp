#include "tests/cli/command.h"
#include "tests/cli/street.h"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;

namespace {

namespace fs = std::filesystem;

const fs::path kSamples = fs::path(ORIEL_SOURCE_DIR) / "examples/samples";

/// An experiment on two samples, with these sections besides.
std::string experiment_on_samples(const std::string& sections) {
  const std::string folder = kSamples.string();
  return "schema: oriel-experiment/1\nname: small\nbootstrap: 50\nsets:\n  samples:\n    models: "
         "[" +
         folder + "/house.stripped.city.json, " + folder + "/house-flush.stripped.city.json]\n" +
         "    truth: [" + folder + "/house.truth.json, " + folder +
         "/house-flush.truth.json]\nrules: residential\n" + sections;
}

constexpr const char* kSections =
    "sweep: {params: [widest_window, narrowest], values: 2}\n"
    "compare: {narrow: {params: {widest_window: 2.5 m}}}\n";

/// The results of an experiment, file by file; not what is kept besides.
std::vector<std::pair<std::string, std::string>> results_in(const fs::path& folder) {
  std::vector<std::pair<std::string, std::string>> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    const std::string name = fs::relative(entry.path(), folder).string();
    if (entry.is_regular_file() && !name.starts_with("cache"))
      files.emplace_back(name, bytes_of(entry.path()));
  }
  std::ranges::sort(files);
  return files;
}

Outcome run_experiment_in(const Folder& folder, const std::string& out,
                          std::vector<std::string> more = {}) {
  std::vector<std::string> words{"experiment", "run", folder / "e.yaml", "-o", folder / out};
  words.insert(words.end(), more.begin(), more.end());
  return run(words);
}

std::size_t count_lines_with(const std::string& text, const std::string& part) {
  return static_cast<std::size_t>(std::ranges::count_if(
      lines_of(text),
      [&](const std::string& line) { return line.find(part) != std::string::npos; }));
}

/// A truth of one window.
std::string truth_of(const std::string& building) {
  return R"({"building": ")" + building +
         R"(", "objects": [{"id": "w", "class": "window", "aabb": [0,0,0,1,1,1], "faces": [0]}]})";
}

/// The code of the one thing that is wrong with an experiment in a folder of its own.
struct WrongData {
  const char* code;
  std::string experiment;
};

}  // namespace

TEST_SUITE("cli/experiment") {
  TEST_CASE("an experiment gives the same bytes again and at any number of jobs") {
    const Folder folder;
    folder.write("e.yaml", experiment_on_samples(kSections));
    const Outcome first = run_experiment_in(folder, "first");
    CAPTURE(first.err);
    REQUIRE(first.exit == 0);
    REQUIRE(run_experiment_in(folder, "second", {"-j", "2"}).exit == 0);
    const auto results = results_in(folder / "first");
    CHECK(results.size() >= 5);
    CHECK(results == results_in(folder / "second"));
    const std::string csv = bytes_of(folder / "first/results.csv");
    CHECK(count_lines_with(csv, "widest_window = 6 m") > 1);
    CHECK(count_lines_with(csv, "compare,samples,residential,narrow") > 1);
    // Again into the same folder, with all that is kept there.
    REQUIRE(run_experiment_in(folder, "first", {"--resume"}).exit == 0);
    CHECK(results == results_in(folder / "first"));
  }

  TEST_CASE("an experiment counts the paper's tests without sets and rules") {
    const Folder folder;
    folder.write("e.yaml", "schema: oriel-experiment/1\nname: f\ncount_as_paper: " +
                               (kSamples / "figure5.city.json").string() + "\n");
    REQUIRE(run_experiment_in(folder, "out").exit == 0);
    const std::string page = bytes_of(folder / "out/report.md");
    CHECK(page.find("The body has 34 planes.") != std::string::npos);
    for (const char* combinations : {"34", "561", "5984", "46376"})
      CHECK(page.find(std::string("| ") + combinations + " |") != std::string::npos);
    CHECK(count_lines_with(bytes_of(folder / "out/results.csv"), "") == 1);
    CHECK(bytes_of(folder / "out/manifest.json").find("figure5.city.json") != std::string::npos);
    folder.write("cube.off", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    folder.write("e.yaml",
                 "schema: oriel-experiment/1\nname: open\ncount_as_paper: [cube.off, none.off]\n");
    const Outcome wrong = run_experiment_in(folder, "none");
    CHECK(wrong.exit == 4);
    CHECK(wrong.says("R280"));
    CHECK_FALSE(fs::exists(folder / "none/report.md"));
    folder.write("e.yaml", "schema: oriel-experiment/1\nname: open\ncount_as_paper: cube.off\n");
    const Outcome open = run_experiment_in(folder, "open");
    CHECK(open.exit == 3);
    CHECK(open.says("is no solid, so that nothing is counted"));
  }

  TEST_CASE("the committed report of the paper's table is what the program says") {
    const Folder folder;
    const fs::path project = ORIEL_SOURCE_DIR;
    std::string committed = bytes_of(project / "docs/experiments/figure5/report.md");
    REQUIRE_FALSE(committed.empty());
    for (const char* jobs : {"1", "2"}) {
      const Outcome outcome =
          run({"experiment", "run", (project / "examples/experiments/figure5.yaml").string(), "-o",
               folder / "out", "-j", jobs});
      CHECK(outcome.exit == 0);
      std::string report = bytes_of(folder / "out/report.md");
      if (const auto begin = report.find(" (commit "); begin != std::string::npos)
        report.erase(begin, report.find(')', begin) + 1 - begin);
      CHECK(report == committed);
    }
  }

  TEST_CASE("a run that was killed goes on where it was and gives the same bytes") {
    const Folder folder;
    folder.write("e.yaml", experiment_on_samples(kSections));
    REQUIRE(run_experiment_in(folder, "whole").exit == 0);
    Surroundings killing;
    killing.signal = SIGKILL;
    killing.watched = folder / "killed/cache/measured";
    killing.watched_name = ".json";
    fs::create_directories(killing.watched);
    run({"experiment", "run", folder / "e.yaml", "-o", folder / "killed"}, killing);
    CHECK_FALSE(fs::exists(folder / "killed/results.csv"));
    REQUIRE(run_experiment_in(folder, "killed", {"--resume"}).exit == 0);
    CHECK(results_in(folder / "killed") == results_in(folder / "whole"));
  }

  TEST_CASE("stored features give the rows that their models give") {
    const Folder folder;
    const std::string house = (kSamples / "house.stripped.city.json").string();
    REQUIRE(run({"segment", house, "--features", folder / "parts.csv"}).exit == 0);
    const auto with = [&](const std::string& what) {
      return "schema: oriel-experiment/1\nname: stored\nbootstrap: 20\nsets: {h: {" + what +
             ", truth: " + (kSamples / "house.truth.json").string() +
             "}}\nrules: residential\nsweep: {params: [narrowest], values: 2}\n";
    };
    folder.write("e.yaml", with("models: " + house));
    REQUIRE(run_experiment_in(folder, "models").exit == 0);
    folder.write("e.yaml", with("features: parts.csv"));
    REQUIRE(run_experiment_in(folder, "features").exit == 0);
    CHECK(bytes_of(folder / "models/results.csv") == bytes_of(folder / "features/results.csv"));
    folder.write("parts.csv", "building,id,aabb_m\nhouse,f1,0;0;0;1;1;1\n");
    const Outcome poor = run_experiment_in(folder, "poor");
    CHECK(poor.exit == 3);
    CHECK_MESSAGE(poor.says("E151"), poor.err);
  }

  TEST_CASE("the baseline of an experiment is what score says of the labels") {
    const Folder folder;
    folder.write("e.yaml", experiment_on_samples("ablate: rules\n"));
    REQUIRE(run_experiment_in(folder, "out").exit == 0);
    REQUIRE(run({"label", (kSamples / "house.stripped.city.json").string(),
                 (kSamples / "house-flush.stripped.city.json").string(), "--features",
                 folder / "parts.csv"})
                .exit == 0);
    const Outcome scored =
        run({"score", folder / "parts.csv", "--truth", (kSamples / "house.truth.json").string(),
             "--truth", (kSamples / "house-flush.truth.json").string(), "--json"});
    const auto json = nlohmann::json::parse(scored.out);
    std::size_t compared = 0;
    for (const auto& [label, counts] : json["classes"].items()) {
      const std::string row = "yes," + label + "," + counts["tp"].dump() + "," +
                              counts["fp"].dump() + "," + counts["fn"].dump();
      CAPTURE(row);
      CHECK(count_lines_with(bytes_of(folder / "out/results.csv"), row) == 1);
      ++compared;
    }
    CHECK(compared > 3);
  }

  TEST_CASE("what is wrong with the data of an experiment has a code and a place") {
    const Folder folder;
    folder.write("a.truth.json", truth_of("house"));
    folder.write("b.truth.json", truth_of("elsewhere"));
    folder.write("house.city.json", bytes_of(kSamples / "house.stripped.city.json"));
    folder.write("again.city.json", bytes_of(kSamples / "house.stripped.city.json"));
    REQUIRE(run({"segment", folder / "house.city.json", "--features", folder / "parts.csv"}).exit ==
            0);
    const auto with = [](const std::string& set, const std::string& part) {
      return "schema: oriel-experiment/1\nname: t\nsets: {s: {" + set + "}}\nrules: residential\n" +
             part + "\n";
    };
    const std::string house = "models: house.city.json, truth: a.truth.json";
    const std::vector<WrongData> all{
        {"R280", with("models: nothing/*.city.json, truth: a.truth.json", "ablate: rules")},
        {"R284", with("models: house.city.json, truth: b.truth.json", "ablate: rules")},
        {"R289", with("models: '*.city.json', truth: a.truth.json", "ablate: rules")},
        {"R288", with("features: parts.csv, truth: a.truth.json", "compare: {p: {order: paper}}")},
        {"R282", with(house, "learn: {}")},
        {"R282", with(house + ", split: {folds: 2}", "ablate: rules")},
        {"R282", with(house + ", split: {held_out: [huose]}", "ablate: rules")},
        {"R283", with(house + ", split: {held_out: [house]}", "learn: {objective: door}")},
    };
    for (const WrongData& wrong : all) {
      CAPTURE(wrong.experiment);
      folder.write("e.yaml", wrong.experiment);
      const Outcome checked = run({"experiment", "check", folder / "e.yaml"});
      CHECK(checked.exit == 4);
      CHECK_MESSAGE(checked.says(wrong.code), checked.err);
      CHECK(checked.says("e.yaml:"));
      CHECK(checked.out.empty());
      const Outcome run_anyway = run_experiment_in(folder, "out");
      CHECK(run_anyway.exit == 4);
      CHECK_FALSE(fs::exists(folder / "out/results.csv"));
    }
  }

  TEST_CASE("figures of an earlier run are gone unless somebody has changed them") {
    const Folder folder;
    const auto run_with_sets = [&](const std::vector<std::string>& sets) {
      std::string text =
          "schema: oriel-experiment/1\nname: t\nrules: residential\ncompare: {wide: "
          "{params: {widest_leaf: 1.3 m}}}\nsets:\n";
      for (const std::string& set : sets)
        text += "  " + set + ": {features: parts.csv, truth: a.truth.json}\n";
      folder.write("e.yaml", text);
      return run_experiment_in(folder, "out").exit;
    };
    folder.write("parts.csv", "building,id,aabb_m\nhouse,f1,0;0;0;1;1;1\n");
    folder.write("a.truth.json", truth_of("house"));
    const fs::path figures = fs::path(folder / "out") / "figures";
    REQUIRE(run_with_sets({"s", "t"}) == 3);
    REQUIRE(fs::exists(figures / "compare-s.svg"));
    REQUIRE(fs::exists(figures / "compare-t.svg"));
    std::ofstream(figures / "mine.svg") << "<svg/>";
    REQUIRE(run_with_sets({"s"}) == 3);
    CHECK(fs::exists(figures / "compare-s.svg"));
    CHECK_FALSE(fs::exists(figures / "compare-t.svg"));
    CHECK(fs::exists(figures / "mine.svg"));
    REQUIRE(run_with_sets({"s", "t"}) == 3);
    std::ofstream(figures / "compare-t.svg") << "<svg/>";
    REQUIRE(run_with_sets({"s"}) == 3);
    CHECK(fs::exists(figures / "compare-t.svg"));
  }

  TEST_CASE("folds without a class and old features are warnings") {
    const Folder folder;
    folder.write("parts.csv", "building,id\nhouse,f1\n");
    fs::last_write_time(folder / "parts.csv",
                        fs::file_time_type::clock::now() - std::chrono::hours(1));
    folder.write("house.city.json", bytes_of(kSamples / "house.stripped.city.json"));
    folder.write("a.truth.json", truth_of("house"));
    folder.write("b.truth.json", replaced(truth_of("other"), "window", "door"));
    folder.write("e.yaml",
                 "schema: oriel-experiment/1\nname: t\nsets: {s: {models: house.city.json, "
                 "features: parts.csv, truth: a.truth.json}}\nrules: residential\nablate: rules\n");
    const Outcome old = run({"experiment", "check", folder / "e.yaml"});
    CHECK(old.exit == 0);
    CHECK_MESSAGE(old.says("R286"), old.err);
    folder.write("e.yaml",
                 "schema: oriel-experiment/1\nname: t\nsets: {s: {features: parts.csv, truth: "
                 "['*.truth.json'], split: {folds: 2}}}\nrules: residential\nablate: rules\n");
    const Outcome folds = run({"experiment", "check", folder / "e.yaml"});
    CHECK_MESSAGE(folds.says("R285"), folds.err);
  }

  TEST_CASE("what is learnt is measured on buildings that it was not learnt from") {
    const Folder folder;
    const std::string samples = kSamples.string();
    folder.write(
        "e.yaml",
        "schema: oriel-experiment/1\nname: learning\nbootstrap: 20\nsets:\n  s:\n    models: [" +
            samples + "/house.stripped.city.json, " + samples +
            "/house-flush.stripped.city.json, " + samples +
            "/l-house.stripped.city.json]\n    truth: " + samples +
            "/*.truth.json\n    split: leave_one_out\nrules: {pack: residential, params: "
            "{door_height: 2 m}}\nlearn: {params: [door_height, step]}\n"
            "learning_curve: {params: [door_height], buildings: 2}\n");
    const Outcome first = run_experiment_in(folder, "first");
    CAPTURE(first.err);
    REQUIRE(first.exit == 0);
    const std::string csv = bytes_of(folder / "first/results.csv");
    CHECK(count_lines_with(csv, "learn,s,residential,learnt from the other buildings") > 3);
    CHECK(count_lines_with(csv, "learning_curve,s,residential,2 buildings,buildings,2") > 3);
    REQUIRE(run_experiment_in(folder, "second", {"-j", "2"}).exit == 0);
    CHECK(results_in(folder / "first") == results_in(folder / "second"));
  }

  TEST_CASE("results of another experiment are not replaced unasked") {
    const Folder folder;
    folder.write("e.yaml", experiment_on_samples("compare: {w: {params: {narrowest: 0.4 m}}}\n"));
    fs::create_directories(folder / "out");
    std::ofstream(folder / "out/manifest.json") << R"({"name": "other"})";
    const Outcome refused = run_experiment_in(folder, "out");
    CHECK(refused.exit == 2);
    CHECK(refused.says("E604"));
    CHECK(refused.says("'other'"));
    CHECK_FALSE(fs::exists(folder / "out/results.csv"));
    std::ofstream(folder / "out/manifest.json") << R"({"name": 3})";
    CHECK(run_experiment_in(folder, "out").exit == 2);
    CHECK(run_experiment_in(folder, "out", {"--force"}).exit == 0);
    CHECK(run_experiment_in(folder, "out").exit == 0);
  }

  TEST_CASE("the schema of experiments is JSON with a description of every key") {
    const auto schema = nlohmann::json::parse(run({"experiment", "schema"}).out);
    CHECK(schema["properties"].size() == 15);
    for (const auto& [key, property] : schema["properties"].items())
      CHECK_MESSAGE((property.contains("description") || property.contains("const")), key);
  }

  TEST_CASE("an experiment looks at neighbours if it is asked to") {
    const Folder folder;
    folder.write("e.yaml", experiment_on_samples("sweep: {params: [narrowest], values: 2}\n"));
    // Nobody looks out of walls at which another house stands.
    const std::string beside =
        folder.write("beside.city.json",
                     boxes({{"b", 0, 8.48, 10.66, 10, 12}, {"r", 10.66, 0, 9, 8.48, 12}}).dump());
    const auto results = [&](const std::string& out, const std::vector<std::string>& more) {
      const Outcome made = run_experiment_in(folder, out, more);
      CAPTURE(made.err);
      CHECK(made.exit <= 3);
      return results_in(folder / out);
    };
    const auto alone = results("alone", {});
    const auto seen = results("seen", {"--neighbours=" + beside, "-j", "2"});
    const auto again = results("seen", {"--neighbours=" + beside, "--resume"});
    CHECK(seen == again);
    const auto table = [](const auto& files) {
      return std::ranges::find(files, "results.csv", [](const auto& file) { return file.first; })
          ->second;
    };
    CHECK(table(seen) != table(alone));
    CHECK(table(results("among", {"--neighbours"})) == table(alone));
    const auto manifest = nlohmann::json::parse(bytes_of(folder / "seen/manifest.json"));
    CHECK(manifest["options"].contains("neighbours of samples"));
    CHECK(std::ranges::count(manifest["inputs"], "neighbours", [](const auto& input) {
            return input["kind"].template get<std::string>();
          }) == 1);
    CHECK(run_experiment_in(folder, "no", {"--neighbours=" + (folder / "no.city.json")})
              .says("E101"));
  }

  TEST_CASE("the report of a comparison shows the buildings that changed") {
    const Folder folder;
    folder.write("e.yaml",
                 experiment_on_samples("compare:\n  mine: {pack: " + std::string(ORIEL_SOURCE_DIR) +
                                       "/examples/first_pack.yaml}\n"
                                       "  same: {params: {widest_window: 2.5 m}}\n"));
    REQUIRE(run_experiment_in(folder, "out").exit == 0);
    const fs::path out = folder / "out";
    const std::string markdown = bytes_of(out / "report.md"), html = bytes_of(out / "report.html");
    CHECK(markdown.find("## Buildings that changed\n\n2 of 2 buildings of samples have labels") !=
          std::string::npos);
    for (const char* name : {"changed-samples-1.svg", "changed-samples-2.svg"}) {
      CAPTURE(name);
      const std::string svg = bytes_of(out / "figures" / name);
      CHECK(svg.find(">as it is<") != std::string::npos);
      CHECK(svg.find(">mine<") != std::string::npos);
      CHECK(svg.find("#d00050") != std::string::npos);  // what changed is marked
      CHECK(markdown.find(std::string("](figures/") + name) != std::string::npos);
      CHECK(html.find(svg.substr(svg.find("<svg"))) != std::string::npos);
    }
    REQUIRE(
        run_experiment_in(folder, "again", {"--cache", folder / "out/cache", "--resume"}).exit ==
        0);
    CHECK(results_in(folder / "again") == results_in(out));
  }

  TEST_CASE("a comparison that changes no label says so and draws nothing") {
    const Folder folder;
    folder.write("e.yaml",
                 experiment_on_samples("compare: {same: {params: {widest_window: 2.5 m}}}\n"));
    REQUIRE(run_experiment_in(folder, "out").exit == 0);
    CHECK(bytes_of(fs::path(folder / "out") / "report.md")
              .find("0 of 2 buildings of samples have labels that differ from the baseline") !=
          std::string::npos);
    CHECK_FALSE(fs::exists(fs::path(folder / "out") / "figures/changed-samples-1.svg"));
  }
}
