#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>

#include <doctest/doctest.h>

namespace {

namespace fs = std::filesystem;

std::string text_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// All first groups of matches of `pattern` in `text`.
void collect(const std::string& text, const std::string& pattern, std::set<std::string>& found) {
  const std::regex regex(pattern);
  for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match)
    found.insert((*match)[1]);
}

TEST_SUITE("kernel/model") {
  TEST_CASE("every code that the sources give has a section in the page of codes") {
    const fs::path root = ORIEL_SOURCE_DIR;
    std::set<std::string> given;
    for (const char* room : {"kernel", "interpret", "generalise", "cli"})
      for (const auto& entry : fs::recursive_directory_iterator(root / room))
        if (entry.path().extension() == ".cpp" || entry.path().extension() == ".h")
          collect(text_of(entry.path()), "\"([EG][0-9]{3})\"", given);
    CHECK(given.size() > 40);
    std::set<std::string> described;
    collect(text_of(root / "docs" / "errors.md"), "### ([EG][0-9]{3}) ", described);
    for (const std::string& code : given) CHECK_MESSAGE(described.contains(code), code);
  }
}

}  // namespace
