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
        codes.insert(to_string(issue.code));
      }
      auto expected = entry.path();
      CHECK(printed == text_of(expected.replace_extension(".txt")));
    }
    CHECK(packs >= 50);
    CHECK(codes.size() >= 30);
  }
}
