#include "kernel/base/code.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = ORIEL_SOURCE_DIR;

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  REQUIRE(file);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Adds the first group of each match of `pattern` in `text`, with its second group if it has one.
void collect(const std::string& text, const std::regex& pattern,
             std::map<std::string, std::string>& found) {
  for (std::sregex_iterator match(text.begin(), text.end(), pattern), end; match != end; ++match)
    found.emplace((*match)[1], match->size() > 2 ? (*match)[2].str() : "");
}

/// The titles of all sections about a code, without the severity in brackets.
std::map<std::string, std::string> titles_in_pages() {
  std::map<std::string, std::string> titles;
  const std::regex section("\n### ([EGR][0-9]{3}) ([^\n]+?)(?: \\((?:warning|note)\\))?\n");
  for (const char* page : {"errors.md", "rules.md", "experiments.md"})
    collect(text_of(kRoot / "docs" / page), section, titles);
  return titles;
}

/// The codes that the table about profiles has.
std::map<std::string, std::string> codes_of_profiles() {
  std::map<std::string, std::string> codes;
  collect(text_of(kRoot / "docs" / "generalisation.md"), std::regex("\n\\| ([EGR][0-9]{3})[ ,]"),
          codes);
  return codes;
}

/// What `pattern` finds in the sources of the product, except in the table of codes.
std::map<std::string, std::string> found_in_sources(const std::regex& pattern,
                                                    const std::vector<const char*>& rooms = {
                                                        "model", "kernel", "io", "interpret",
                                                        "generalise", "cli", "oriel", "experiments",
                                                        "studio"}) {
  std::map<std::string, std::string> found;
  for (const char* room : rooms) {
    if (!fs::exists(kRoot / room)) continue;
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / room)) {
      const fs::path& path = entry.path();
      if (path.stem() == "code" && path.parent_path().filename() == "base") continue;
      if (path.extension() == ".cpp" || path.extension() == ".h")
        collect(text_of(path), pattern, found);
    }
  }
  return found;
}

TEST_SUITE("kernel/base") {
  TEST_CASE("every code of the table has a section with its meaning") {
    const auto titles = titles_in_pages();
    const auto profiles = codes_of_profiles();
    for (const Code code : all_codes()) {
      const std::string text = to_string(code);
      CAPTURE(text);
      if (const auto found = titles.find(text); found != titles.end())
        CHECK(found->second == meaning_of(code));
      else
        CHECK(profiles.contains(text));
    }
  }

  TEST_CASE("every code with a section is in the table") {
    const auto titles = titles_in_pages();
    CHECK(titles.size() > 100);
    for (const auto& [text, title] : titles) CHECK_MESSAGE(code_of(text), text);
    for (const auto& [text, title] : codes_of_profiles()) CHECK_MESSAGE(code_of(text), text);
  }

  TEST_CASE("a section names the number of val3dity that the table has") {
    std::map<std::string, std::string> numbers;
    const std::regex section("\n### (E[0-9]{3}) [^\n]+\nval3dity ([0-9]{3})[ ,]");
    collect(text_of(kRoot / "docs" / "errors.md"), section, numbers);
    for (const Code code : all_codes()) {
      const auto found = numbers.find(to_string(code));
      CAPTURE(to_string(code));
      CHECK(val3dity_number(code) == (found == numbers.end() ? 0 : std::stoi(found->second)));
    }
  }

  TEST_CASE("no code stands as a text in the sources") {
    for (const auto& [text, rest] : found_in_sources(std::regex("\"([EGR][0-9]{3})[ \"]")))
      FAIL_CHECK(text);
  }

  TEST_CASE("every code of the table is given somewhere in the sources") {
    auto given = found_in_sources(std::regex("Code::([EGR][0-9]{3})"));
    // The generator shares no code with the rest, and so writes its codes as texts.
    given.merge(found_in_sources(std::regex("\\b([EGR][0-9]{3}) ['{]"), {"examples/generator"}));
    for (const Code code : all_codes())
      CHECK_MESSAGE(given.contains(to_string(code)), to_string(code));
  }

  TEST_CASE("a code and its text lead to each other") {
    CHECK(to_string(Code::E901) == "E901");
    for (const Code code : all_codes()) CHECK(code_of(to_string(code)) == code);
    for (const char* text : {"", "E", "E999", "e101", "E1011"}) CHECK_FALSE(code_of(text));
    CHECK(to_string(Code::none).empty());
  }

  TEST_CASE("codes of geometry are those of E3xx") {
    CHECK(is_about_geometry(Code::E301));
    CHECK(is_about_geometry(Code::E358));
    CHECK_FALSE(is_about_geometry(Code::E213));
    CHECK_FALSE(is_about_geometry(Code::E501));
    CHECK_FALSE(is_about_geometry(Code::none));
  }
}

}  // namespace
