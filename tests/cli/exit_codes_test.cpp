#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel::test;

namespace {

using Words = std::vector<std::string>;

/// A command as it is run for a row of the table: IN and OUT stand for its input and output.
struct TableRow {
  std::string name;
  std::string extension;  ///< of its input
  Words words;
  std::string out{};  ///< empty: it prints
  Words second{};     ///< options that make it write OUT once more; empty: there are none
  /// Input and output of a run that would write over its input; else OUT is the input.
  std::array<std::string, 2> over{};
};

/// Every command of oriel.
std::vector<TableRow> table_rows() {
  const std::string city = "city.json", lines = "city.jsonl";
  const Words timings{"--timings", "OUT"};
  return {
      {"segment", city, {"segment", "IN", "-o", "OUT", "--json"}, "o.json", {"--features", "OUT"}},
      {"label", city, {"label", "IN", "-o", "OUT"}, "o.city.json", timings},
      {"generalise",
       city,
       {"generalise", "IN", "--scale", "1:1000", "-o", "OUT"},
       "o.city.json",
       {"--metrics", "OUT"}},
      {"generalise --series",
       city,
       {"generalise", "IN", "--series", "1:500,1:1000", "-o", "OUT"},
       "s",
       {"--timings", "OUT.1-500.city.json"},
       {"s.1-500.city.json", "s"}},
      {"repair", city, {"repair", "IN", "-o", "OUT"}, "o.city.json", {"--report", "OUT"}},
      {"explain", city, {"explain", "IN", "--surface", "0"}},
      {"view", city, {"view", "IN", "-o", "OUT"}, "o.html", timings},
      {"validate", city, {"validate", "IN", "-o", "OUT"}, "o.txt"},
      {"cat", city, {"cat", "IN", "-o", "OUT"}, "o.city.jsonl", timings},
      {"collect", lines, {"collect", "IN", "-o", "OUT"}, "o.city.json", timings},
      {"split",
       lines,
       {"split", "IN", "--count", "1", "-o", "OUT"},
       "d",
       {"--timings", "OUT/split.json"},
       {"shards/000000.city.jsonl", "shards"}},
      {"merge",
       lines,
       {"merge", "IN", "--split", "shards/split.json", "-o", "OUT"},
       "o.city.jsonl"},
      {"interpret", "csv", {"interpret", "IN", "-o", "OUT"}, "o.csv"},
      {"diff", "csv", {"diff", "IN", "IN"}},
      {"score",
       "csv",
       {"score", "IN", "--truth", "good.truth.json", "--curve", "OUT"},
       "o.csv",
       {"--per-building", "OUT"}},
      {"score --surfaces", city, {"score", "--surfaces", "IN"}},
      {"learn",
       "csv",
       {"learn", "IN", "second.csv", "--truth", "good.truth.json", "second.truth.json",
        "--leave-one-out", "--restarts", "0", "-o", "OUT"},
       "o.yaml"},
      {"experiment run",
       "experiment.yaml",
       {"experiment", "run", "IN", "-o", "OUT"},
       "results",
       {},
       {"results/report.md", "results"}},
      {"experiment check", "experiment.yaml", {"experiment", "check", "IN"}},
      {"rules check", "yaml", {"rules", "check", "IN"}},
      {"rules fmt", "yaml", {"rules", "fmt", "IN"}},
      {"rules show", "yaml", {"rules", "show", "IN"}},
      {"rules doc", "yaml", {"rules", "doc", "IN"}},
      {"rules test", "yaml", {"rules", "test", "IN", "--junit", "OUT"}, "o.xml"}};
}

/// An experiment on the model of that name.
std::string experiment_on(const Folder& folder, const std::string& name) {
  return "schema: oriel-experiment/1\nname: t\nbootstrap: 1\nsets: {s: {models: " +
         (folder / (name + ".city.json")) + ", truth: " + (folder / "good.truth.json") +
         "}}\nrules: residential\ncompare: {n: {params: {widest_window: 2.5 m}}}\n";
}

/// The files that the rows read, by what is wrong with them, in the folder.
void write_inputs(const Folder& folder) {
  auto rejected = cubes({"a"});
  rejected["vertices"][0][0] = 9'000'000'000'000'000;  // beyond what is read
  std::string rejected_line = cube_lines({"a"});
  rejected_line.replace(rejected_line.rfind("[0,0,0]"), 7, "[9000000000000000,0,0]");
  const std::string file = cubes({"a"}).dump(), stream = cube_lines({"a"});
  const std::map<std::string, Words> texts{
      {"empty", {"", "", "", ""}},
      {"none", {cubes({}).dump(), cube_lines({}), "building,id\n", "\n"}},
      {"rejected",
       {rejected.dump(), rejected_line, "building,id\nx\n",
        "schema: oriel/1\npack: {name: t, version: 1.0.0}\nclasses: {window: {}}\n"
        "rules: [{id: w, label: window, require: heigth > 1 m}]\n"}},
      {"broken",
       {file.substr(0, file.size() - 20), stream.substr(0, stream.size() - 20), "building,\"id\n",
        "schema: {oriel/1\n"}}};
  const Words extensions{".city.json", ".city.jsonl", ".csv", ".yaml"};
  for (const auto& [name, of_extension] : texts)
    for (std::size_t i = 0; i < extensions.size(); ++i)
      folder.write(name + extensions[i], of_extension[i]);
  // A house, so that there are features.
  const std::string house = sample("house");
  folder.write("good.city.json", bytes_of(house));
  REQUIRE(run({"cat", house, "-o", folder / "good.city.jsonl"}).exit == 0);
  REQUIRE(run({"label", house, "--features", folder / "good.csv"}).exit == 0);
  folder.write("good.truth.json", bytes_of(replaced(house, ".stripped.city", ".truth")));
  folder.write("good.yaml",
               "schema: oriel/1\npack: {name: t, version: 1.0.0}\nclasses: {window: {}}\n"
               "rules: [{id: w, label: window, require: natural}]\n");
  for (const std::string name : {"good", "empty", "none", "rejected", "broken"}) {
    folder.write(name + ".test.yaml", "tests_for: " + name + ".yaml\ntests: []\n");
    folder.write(name + ".experiment.yaml", experiment_on(folder, name));
  }
  std::filesystem::create_directory(folder / "results");
  folder.write("results/report.md", experiment_on(folder, "good"));
  const std::string hip = sample("hip");
  REQUIRE(run({"label", hip, "--features", folder / "second.csv"}).exit == 0);
  folder.write("second.truth.json", bytes_of(replaced(hip, ".stripped.city", ".truth")));
  folder.write("s.1-500.city.json", bytes_of(house));
  REQUIRE(
      run({"split", folder / "good.city.jsonl", "--count", "1", "-o", folder / "shards"}).exit ==
      0);
}

const Words kSituations{"an empty file", "no building",   "all rejected",   "a broken file",
                        "no such file",  "`--id`",        "output = input", "output twice",
                        "a full disk",   "no such option"};

/// How the command ends in a situation; nothing is run where the row does not know it: "–".
std::string exit_of(const TableRow& row, const std::string& situation, const Folder& folder) {
  const std::map<std::string, std::string> stems{{"an empty file", "empty"},
                                                 {"no building", "none"},
                                                 {"all rejected", "rejected"},
                                                 {"a broken file", "broken"},
                                                 {"no such file", "nosuch"}};
  const auto stem = stems.find(situation);
  std::string in = folder / ((stem == stems.end() ? "good" : stem->second) + "." + row.extension);
  if (row.name == "merge" && stem == stems.end()) in = folder / "shards/000000.city.jsonl";
  std::string out = folder / row.out;
  Surroundings around;
  Words words = row.words;
  const auto add = [&](const Words& more) { words.insert(words.end(), more.begin(), more.end()); };
  if (situation == "`--id`") add({"--id", "nosuch"});
  if (situation == "no such option") add({"--nosuch"});
  if (situation == "output = input") {
    if (row.out.empty()) return "–";
    out = row.over[1].empty() ? in : folder / row.over[1];
    if (!row.over[0].empty()) in = folder / row.over[0];
  }
  if (situation == "output twice") {
    if (row.second.empty()) return "–";
    add(row.second);
  }
  if (situation == "a full disk" && row.out.empty()) around.stdout_file = "/dev/full";
  if (situation == "a full disk" && !row.out.empty()) around.file_limit = 1;
  for (std::string& word : words) {
    if (word == "IN") word = in;
    if (word.starts_with("OUT")) word = out + word.substr(3);
    if (word == "shards/split.json" || word.starts_with("good.") || word.starts_with("second."))
      word = folder / word;
  }
  const Outcome outcome = run(words, around);
  CAPTURE(words);
  CAPTURE(outcome.err);
  // What did not go well is said.
  CHECK((outcome.exit == 0 || around.file_limit > 0 || !outcome.err.empty()));
  if (situation.starts_with("output ")) CHECK(outcome.says("E602"));
  return std::to_string(outcome.exit);
}

/// The cells of the table under "### By command" of docs/command.md, by the first cell of their
/// row.
std::map<std::string, Words> table_of_page() {
  std::map<std::string, Words> rows;
  bool is_there = false;
  for (const std::string& line :
       lines_of(bytes_of(std::string(ORIEL_SOURCE_DIR) + "/docs/command.md"))) {
    if (line.starts_with("#")) is_there = line == "### By command";
    if (!is_there || !line.starts_with("| ")) continue;
    Words cells;
    for (std::size_t from = 2, to = 0; (to = line.find(" |", from)) != std::string::npos;
         from = to + 3)
      cells.push_back(line.substr(from, to - from));
    rows[cells[0]] = {cells.begin() + 1, cells.end()};
  }
  return rows;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("each command ends in each situation with the exit code of its page") {
    const auto page = table_of_page();
    REQUIRE(page.contains("command"));
    CHECK(page.at("command") == kSituations);
    CHECK(page.size() == table_rows().size() + 1);
    for (const TableRow& row : table_rows()) {
      CAPTURE(row.name);
      const Folder folder;
      write_inputs(folder);
      REQUIRE(page.contains("`" + row.name + "`"));
      const Words& cells = page.at("`" + row.name + "`");
      REQUIRE(cells.size() == kSituations.size());
      for (std::size_t i = 0; i < cells.size(); ++i) {
        CAPTURE(kSituations[i]);
        CHECK(cells[i] == exit_of(row, kSituations[i], folder));
      }
    }
  }
}
