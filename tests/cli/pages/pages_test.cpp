#include "tests/cli/pages/ellipsis.h"
#include "tests/cli/pages/page.h"
#include "tests/cli/pages/shell.h"

#include <cstdlib>
#include <fstream>
#include <optional>
#include <regex>
#include <set>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;

namespace fs = std::filesystem;

namespace {

/// Blocks of output, of what is run or loaded here, and of what is compared with sources.
const std::set<std::string> kLanguages{
    "",      "text",  "console", "sh",  "yaml",  "json", "sql", "cpp",
    "cmake", "first", "python",  "lua", "elisp", "pycon"};  // run by tests/python/pages_test.py

/// Programs that a page may use and a machine may not have.
const std::vector<std::string> kGuests{"cjio",    "docker",    "duckdb",  "jq",      "parallel",
                                       "python3", "snakemake", "sqlite3", "val3dity"};

/// Blocks that show output and are not run.
constexpr int kMostConsoleBlocksNotRun = 3;

bool rewrites_pages() { return std::getenv("ORIEL_REWRITE_PAGES") != nullptr; }

/// ORIEL_PAGES=WORD: only pages with the word in their path.
bool is_asked_for(const Page& page) {
  const char* word = std::getenv("ORIEL_PAGES");
  return word == nullptr || page.path.string().find(word) != std::string::npos;
}

/// What the block needs and the machine does not have.
std::optional<std::string> missing_for(const PageBlock& block) {
  std::string text;
  for (const ShownCommand& command : commands_of(block)) text += command.text + "\n";
  if (block.language != "console") text = block.text();
  if (text.find("../shared") != std::string::npos &&
      !fs::exists(fs::path(ORIEL_SOURCE_DIR) / "../shared/data"))
    return "../shared";
  for (const std::string& guest : kGuests) {
    const bool is_used =
        std::regex_search(text, std::regex("(^|[\\n|;(&]) *(\\$ )?" + guest + " "));
    if ((is_used || (block.language == "sql" && guest == "sqlite3")) && !has_program(guest))
      return guest;
  }
  return std::nullopt;
}

/// One command of the page's shell. `shown` says where in the block it stands.
struct PageStep {
  std::size_t block = 0;
  std::optional<std::size_t> shown{};
  std::string command{};
};

std::string script_of(const Page& page, const PageBlock& block) {
  const std::string text = quoted(block.text());
  if (block.language == "first") return block.text();
  if (block.language == "sh") return "bash -e -o pipefail -c " + text;
  if (block.language == "sql")
    return "printf %s " + text +
           " | sqlite3 -bail -cmd '.mode csv' -cmd '.import parts.csv parts' :memory:";
  // Of the reference, which shows faults, tests/interpret/docs_test.cpp loads every pack.
  if (block.language != "yaml" || page.path == "docs/rules.md") return "";
  // The page goes on with it.
  if (text.starts_with("'schema: oriel-experiment/1"))
    return "printf %s " + text + " >experiment.yaml && oriel experiment check experiment.yaml";
  const std::string written = "printf %s " + text + " >block.yaml && ";
  if (text.starts_with("'schema: oriel/1")) return written + "oriel rules check block.yaml";
  if (text.starts_with("'schema: oriel-profile/1"))
    return written +
           "oriel generalise examples/samples/house.stripped.city.json --profile block.yaml "
           "-o block.city.json";
  return "";
}

/// What is run of a page, in its order.
std::vector<PageStep> steps_of(const Page& page) {
  std::vector<PageStep> steps;
  for (std::size_t i = 0; i < page.blocks.size(); ++i) {
    const PageBlock& block = page.blocks[i];
    const std::string place = page.path.string() + ":" + std::to_string(block.begin);
    if (!block.why_not_run.empty()) continue;
    if (const auto missing = missing_for(block)) {
      MESSAGE("skipped: ", place, " needs ", *missing);
      continue;
    }
    if (block.language == "console") {
      const std::vector<ShownCommand> commands = commands_of(block);
      CHECK_MESSAGE(!commands.empty(), place, ": no line of the block begins with '$ '");
      for (std::size_t k = 0; k < commands.size(); ++k) steps.push_back({i, k, commands[k].text});
    } else if (const std::string script = script_of(page, block); !script.empty()) {
      steps.push_back({i, std::nullopt, script});
    }
  }
  return steps;
}

std::string indented(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += "  " + line + "\n";
  return text;
}

/// Compares what commands print with the page; with ORIEL_REWRITE_PAGES writes it into the page.
void check_page(const Page& page) {
  const std::vector<PageStep> steps = steps_of(page);
  std::vector<std::string> commands;
  for (const PageStep& step : steps) commands.push_back(step.command);
  if (commands.empty()) return;
  const std::vector<Shown> all = Checkout().run(commands);
  std::vector<std::vector<std::string>> blocks;
  std::vector<std::vector<ShownCommand>> consoles;
  for (const PageBlock& block : page.blocks) {
    blocks.push_back(block.lines);
    consoles.push_back(block.language == "console" ? commands_of(block)
                                                   : std::vector<ShownCommand>{});
  }
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const PageStep& step = steps[i];
    const std::string place = page.path.string() + ":" +
                              std::to_string(page.blocks[step.block].begin) + ": " + step.command;
    if (!step.shown) {
      CHECK_MESSAGE(all[i].exit == 0, place, " ended with ", all[i].exit, "\n",
                    indented(all[i].lines));
      continue;
    }
    CHECK_MESSAGE(all[i].exit >= 0, place, " was not run");
    std::vector<std::string>& printed = consoles[step.block][*step.shown].printed;
    const bool is_same = fits(printed, all[i].lines);
    if (!rewrites_pages())
      CHECK_MESSAGE(is_same, place, "\nthe page shows\n", indented(printed), "printed is\n",
                    indented(all[i].lines));
    else if (!is_same && all[i].exit >= 0)
      printed = shown_again(printed, all[i].lines);
    blocks[step.block] = lines_of_commands(consoles[step.block]);
  }
  const std::string text = with_blocks(page, blocks);
  const fs::path path = fs::path(ORIEL_SOURCE_DIR) / page.path;
  if (!rewrites_pages() || text == bytes_of(path)) return;
  std::ofstream(path, std::ios::binary) << text;
  MESSAGE("rewritten: ", page.path.string());
}

/// The programs and scripts of the repository that a block starts, as words of it.
std::vector<std::string> scripts_named_in(const std::string& text) {
  static const std::regex script(R"((^|\s)((?:bench|docs|examples|tests)/\S+\.(?:sh|py))\b)");
  std::vector<std::string> names;
  for (std::sregex_iterator match(text.begin(), text.end(), script), end; match != end; ++match)
    names.push_back((*match)[2]);
  return names;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("every command of every page prints what the page shows") {
    int consoles = 0;
    for (const Page& page : read_pages()) {
      for (const PageBlock& block : page.blocks) consoles += block.language == "console" ? 1 : 0;
      if (is_asked_for(page)) check_page(page);
    }
    CHECK(consoles > 10);
  }

  TEST_CASE("blocks of pages that are not run say why and can be read by a shell") {
    int not_run = 0;
    int not_run_consoles = 0;
    for (const Page& page : read_pages())
      for (const PageBlock& block : page.blocks) {
        const std::string place = page.path.string() + ":" + std::to_string(block.begin);
        for (const std::string& name : scripts_named_in(block.text()))
          CHECK_MESSAGE(fs::exists(fs::path(ORIEL_SOURCE_DIR) / name), place, " names ", name);
        if (block.why_not_run.empty()) continue;
        ++not_run;
        not_run_consoles += block.language == "console" ? 1 : 0;
        MESSAGE("not run: ", place, ": ", block.why_not_run);
        const std::string check = "bash -n -c " + quoted(block.text());
        if (block.language == "sh") CHECK_MESSAGE(std::system(check.c_str()) == 0, place);
      }
    MESSAGE("blocks that are not run: ", not_run, ", that show output: ", not_run_consoles);
    CHECK(not_run_consoles <= kMostConsoleBlocksNotRun);
  }

  TEST_CASE("a block of a page that has commands in it says so by its language") {
    const std::regex command(
        R"((^|\n)(\$ |oriel(-\w+)? |bash |cmake |ctest |snakemake |parallel ))");
    for (const Page& page : read_pages())
      for (const PageBlock& block : page.blocks) {
        const std::string place = page.path.string() + ":" + std::to_string(block.begin);
        CHECK_MESSAGE(kLanguages.contains(block.language), place, " ", block.language);
        if (block.language.empty() || block.language == "text")
          CHECK_MESSAGE(!std::regex_search(block.text(), command), place);
      }
  }

  TEST_CASE("blocks of JSON parse and those of C++ and CMake are those of the example") {
    const fs::path example = fs::path(ORIEL_SOURCE_DIR) / "examples/library";
    const std::string main = bytes_of(example / "main.cpp");
    const std::string lists = bytes_of(example / "CMakeLists.txt");
    for (const Page& page : read_pages())
      for (const PageBlock& block : page.blocks) {
        const std::string place = page.path.string() + ":" + std::to_string(block.begin);
        const std::string text = block.text();
        if (block.language == "json") CHECK_MESSAGE(nlohmann::json::accept(text), place);
        if (block.language == "cpp")
          CHECK_MESSAGE(main.find(text) != std::string::npos, place, " is not in main.cpp");
        if (block.language == "cmake")
          CHECK_MESSAGE(lists.find(text) != std::string::npos, place, " is not in CMakeLists.txt");
      }
  }
}
