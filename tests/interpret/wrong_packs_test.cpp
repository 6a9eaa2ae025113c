#include "tests/interpret/support.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <set>

using namespace oriel;
using namespace oriel::test;

namespace {

std::string text_of(const std::filesystem::path& path) {
  std::ifstream file(path);
  REQUIRE(file);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("every wrong pack is refused with the message that stands beside it") {
    const std::filesystem::path folder =
        std::filesystem::path(ORIEL_SOURCE_DIR) / "tests/data/rules";
    std::set<std::string> codes;
    std::size_t packs = 0;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
      if (entry.path().extension() != ".yaml") continue;
      ++packs;
      CAPTURE(entry.path());
      const auto checked = load_pack(text_of(entry.path()), entry.path().filename().string());
      CHECK_FALSE(checked.value);
      std::string printed;
      for (const Issue& issue : checked.issues) {
        printed += to_string(issue) + "\n";
        codes.insert(issue.code);
      }
      auto expected = entry.path();
      CHECK(printed == text_of(expected.replace_extension(".txt")));
    }
    CHECK(packs >= 50);
    CHECK(codes.size() >= 30);
  }

  TEST_CASE("every code that is given has a section in the reference") {
    const std::string docs = text_of(std::string(ORIEL_SOURCE_DIR) + "/docs/rules.md");
    // Profiles have a page of their own.
    const std::string profiles = text_of(std::string(ORIEL_SOURCE_DIR) + "/docs/generalisation.md");
    std::set<std::string> given;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(
             std::string(ORIEL_SOURCE_DIR) + "/interpret")) {
      if (entry.path().extension() != ".cpp") continue;
      const std::string source = text_of(entry.path());
      for (std::size_t at = source.find("\"R2"); at != std::string::npos;
           at = source.find("\"R2", at + 1))
        if (source.size() > at + 5 && source[at + 5] == '"') given.insert(source.substr(at + 1, 4));
    }
    CHECK(given.size() > 40);
    for (const std::string& code : given) {
      const bool is_described = docs.find("\n### " + code + " ") != std::string::npos ||
                                profiles.find("| " + code) != std::string::npos;
      CHECK_MESSAGE(is_described, code);
    }
  }
}
