#include "tests/cli/command.h"
#include "tests/support/shared.h"

#include <array>
#include <filesystem>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

using Words = std::vector<std::string>;
namespace fs = std::filesystem;

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(NDEBUG)
constexpr unsigned kMostSeconds = 0;  // what checks itself is slower, and larger
constexpr std::size_t kMostBytes = 0;
#else
constexpr unsigned kMostSeconds = 5;
constexpr std::size_t kMostBytes = std::size_t{3} << 29;
#endif

constexpr std::size_t kCommands = 9;

/// Not run here: it takes longer than a test may.
constexpr int kSlow = -1;

/// What is done to each file; OUT is an output of the same format.
const std::array<Words, kCommands>& commands() {
  static const std::array<Words, kCommands> all{
      Words{"label", "-o", "OUT"},
      {"segment", "--json", "--faces"},
      {"generalise", "--scale", "1:2500", "-o", "OUT"},
      {"generalise", "--to-lod", "2.0,1.2,1.0", "-o", "OUT"},
      {"view", "-o", "page.html"},
      {"tiles", "-o", "tiles"},
      {"repair", "-o", "OUT"},
      {"explain", "--surface", "0"},
      {"validate", "--json"}};
  return all;
}

struct Case {
  std::string file;                  ///< in cases/ of the shared data
  std::array<int, kCommands> exits;  ///< of each command
  std::string said;                  ///< the code that each command but validate says
  std::string found;                 ///< the code that validate finds
};

const std::vector<Case>& cases() {
  static const std::vector<Case> all{
      {"crash/empty-outer-ring.city.jsonl", {0, 0, 3, 3, 0, 3, 3, 0, 3}, "E201", "E311"},
      {"crash/empty-outer-ring-unassigned.city.jsonl", {0, 0, 3, 3, 0, 3, 3, 0, 3}, "E201", "E311"},
      {"crash/empty-outer-ring-in-stream.city.jsonl", {0, 0, 3, 3, 0, 3, 3, 0, 3}, "E201", "E311"},
      {"bounds/overlapping-boxes.city.jsonl", {0, 0, 3, 3, 0, 3, 3, 0, 0}, "E305", ""},
      {"bounds/mesh-5k.city.json", {0, 0, 0, kSlow, kSlow, kSlow, 0, 0, 0}, "", ""},
      {"geometry/installation-folded.city.json", {0, 0, 3, 3, 0, 0, 3, 0, 3}, "", "E345"},
      {"geometry/vertices-one-unit-apart.city.jsonl", {0, 0, 0, 0, 0, 0, 0, 0, 3}, "E309", "E312"},
      {"families/second-geometry-invalid.city.json", {0, 0, 3, 0, 0, 0, 3, 0, 3}, "E215", "E344"},
      {"families/solid-and-multisurface-of-one-lod.city.json",
       {0, 0, 0, 0, 0, 0, 0, 0, 0},
       "E215",
       ""}};
  return all;
}

/// What was written, and nothing else, and all of it is what it should be.
void check_written(const Folder& folder, const std::string& out) {
  for (const auto& entry : fs::recursive_directory_iterator(folder.path()))
    CHECK(entry.path().string().find(".tmp") == std::string::npos);
  for (const char* name : {"o.city.json", "tiles/tileset.json"})
    if (const std::string text = bytes_of(folder / name); !text.empty()) CHECK(json::accept(text));
  for (const std::string& line : lines_of(bytes_of(folder / "o.city.jsonl")))
    CHECK(json::accept(line));
  for (const std::string& line : lines_of(out))
    if (line.starts_with('{') || line.starts_with('[')) CHECK(json::accept(line));
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("each command says of each case what is right in 5 s and 1.5 GB") {
    ORIEL_NEEDS_SHARED(shared);
    for (const Case& one : cases())
      for (std::size_t i = 0; i < kCommands; ++i) {
        if (one.exits[i] == kSlow) continue;
        const Folder folder;
        Words words = commands()[i];
        const std::string end = one.file.substr(one.file.find(".city"));
        for (std::string& word : words) word = word == "OUT" ? "o" + end : word;
        words.push_back(shared / "data" / "cases" / one.file);
        Surroundings around;
        around.folder = folder.path();
        around.cpu_limit_s = kMostSeconds;
        around.memory_limit = kMostBytes;
        const Outcome outcome = run(words, around);
        CAPTURE(words);
        CAPTURE(outcome.err);
        CHECK(outcome.exit == one.exits[i]);
        const std::string code = words[0] == "validate" ? one.found : one.said;
        CHECK((outcome.out + outcome.err).find(code) != std::string::npos);
        CHECK_FALSE(outcome.says("E901"));
        check_written(folder, outcome.out);
      }
  }
}
