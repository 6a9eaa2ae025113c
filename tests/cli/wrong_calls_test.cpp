#include "tests/cli/command.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

using namespace oriel::test;

namespace {

namespace fs = std::filesystem;

const std::string kTable = std::string(ORIEL_SOURCE_DIR) + "/tests/data/calls/wrong_calls.txt";

/// A call as a beginner types it, and how it ends.
struct WrongCall {
  std::string line;  ///< "$ oriel lable house.city.json"
  int exit = -1;
  std::string says;
};

/// The blocks of the table: a line "$ oriel …", "exit N", then all that stderr has, up to an empty
/// line. Lines that begin with # say what follows.
std::vector<WrongCall> calls_of_table() {
  std::vector<WrongCall> calls;
  for (const std::string& line : lines_of(bytes_of(kTable))) {
    if (line.starts_with("$ "))
      calls.push_back({line, -1, ""});
    else if (line.empty() || line.starts_with("# "))
      continue;
    else if (line.starts_with("exit ") && calls.back().exit < 0)
      calls.back().exit = std::stoi(line.substr(5));
    else
      calls.back().says += line + "\n";
  }
  return calls;
}

/// The words after "$ oriel", as a shell parts them; only ' quotes.
std::vector<std::string> words_of(const std::string& line) {
  std::vector<std::string> words{""};
  bool is_quoted = false;
  for (const char c : line.substr(std::string("$ oriel").size())) {
    if (c == '\'')
      is_quoted = !is_quoted;
    else if (c == ' ' && !is_quoted)
      words.emplace_back();
    else
      words.back() += c;
  }
  words.erase(words.begin());
  return words;
}

/// What a beginner has at hand: cities, a truth, records, a pack, and files that are none of them.
void write_what_is_at_hand(const Folder& folder) {
  const auto of_samples = [&](const std::string& name) {
    return bytes_of(std::string(ORIEL_SOURCE_DIR) + "/examples/samples/" + name);
  };
  folder.write("house.city.json", bytes_of(sample("house")));
  folder.write("block.city.json", bytes_of(sample("block")));
  folder.write("block.truth.json", of_samples("block.truth.json"));
  folder.write("house.truth.json", R"({"building": "house", "shell": {}, "objects": []})"
                                   "\n");
  folder.write("outline.city.json",
               R"({"type": "CityJSON", "version": "2.0",)"
               R"( "transform": {"scale": [0.001, 0.001, 0.001], "translate": [0, 0, 0]},)"
               R"( "CityObjects": {"plot": {"type": "Building", "geometry": [{"type":)"
               R"( "MultiSurface", "lod": "0", "boundaries": [[[0, 1, 2, 3]]]}]}},)"
               R"( "vertices": [[0, 0, 0], [4000, 0, 0], [4000, 3000, 0], [0, 3000, 0]]})");
  folder.write("pack.yaml", bytes_of(std::string(ORIEL_SOURCE_DIR) + "/examples/first_pack.yaml"));
  folder.write("experiment.yaml",
               "schema: oriel-experiment/1\nname: narrow\nsets: {houses: {models: house.city.json, "
               "truth: house.truth.json}}\nrules: residential\n"
               "compare: {narrow: {params: {widest_window: 2.5 m}}}\n");
  folder.write("empty.city.json", "");
  folder.write("notes.txt", "buy bricks\n");
  folder.write("plan.pdf", "%PDF-1.4\n");
  folder.write("scan.city.json", "%PDF-1.4\n");
  folder.write("house.city.json.gz", "\x1f\x8b\x08");
  fs::create_directory(folder / "empty");
  fs::create_directory(folder / "records.csv");
  REQUIRE(run({"label", "house.city.json", "--features", "parts.csv"}, {.folder = folder.path()})
              .exit == 0);
}

void write_table(const std::vector<WrongCall>& calls) {
  std::string text;
  auto next = calls.begin();
  // What stands between the blocks stays.
  for (const std::string& line : lines_of(bytes_of(kTable))) {
    if (line.starts_with("# ")) text += line + "\n\n";
    if (!line.starts_with("$ ")) continue;
    text += fmt::format("{}\nexit {}\n{}\n", next->line, next->exit, next->says);
    ++next;
  }
  std::ofstream(kTable) << text;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("every wrong call of the table names the place and the cause and the remedy") {
    const Folder folder;
    write_what_is_at_hand(folder);
    const auto before = folder.names();
    std::vector<WrongCall> calls = calls_of_table();
    CHECK(calls.size() >= 30);
    const bool is_rewriting = std::getenv("ORIEL_REWRITE_CALLS") != nullptr;
    for (WrongCall& call : calls) {
      const Outcome outcome = run(words_of(call.line), {.folder = folder.path()});
      CAPTURE(call.line);
      if (is_rewriting) {
        call.exit = outcome.exit;
        call.says = outcome.err;
        continue;
      }
      CHECK(outcome.exit == call.exit);
      CHECK(outcome.err == call.says);
      // Nothing was done, and nothing lies about.
      CHECK(folder.names() == before);
      if (outcome.exit == 2 || outcome.exit == 4) CHECK(outcome.out.empty());
    }
    if (is_rewriting) write_table(calls);
  }
}
