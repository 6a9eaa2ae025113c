#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <sstream>
#include <string>

#include <doctest/doctest.h>

namespace {

namespace fs = std::filesystem;

const fs::path kSources = ORIEL_SOURCE_DIR;

std::string text_of_file(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What the Dockerfile takes from the sources: not what one stage takes from another.
std::set<std::string> copied_paths() {
  std::set<std::string> paths;
  std::istringstream lines(text_of_file(kSources / "examples/packages/Dockerfile"));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word, path;
    words >> word;
    if (word != "COPY" || line.find("--from=") != std::string::npos) continue;
    // The last word is where it goes.
    words >> path;
    while (words >> word) {
      paths.insert(path);
      path = word;
    }
  }
  return paths;
}

/// True if the path is the folder or lies in it.
bool is_under(const std::string& path, const std::string& folder) {
  return (path + "/").starts_with(folder + "/");
}

}  // namespace

TEST_SUITE("repository") {
  TEST_CASE("the Dockerfile copies what is there and all that the build reads") {
    const std::set<std::string> copied = copied_paths();
    CHECK(copied.size() > 10);
    for (const std::string& path : copied) {
      CAPTURE(path);
      CHECK(fs::exists(kSources / path));
    }
    // The folders that CMake enters, but for those of tests and benchmarks, which no package has.
    const std::string build = text_of_file(kSources / "CMakeLists.txt");
    const std::regex folder("(?:add_subdirectory\\(|foreach\\(room )([a-z_/ ]+)\\)");
    int folders = 0;
    for (std::sregex_iterator match(build.begin(), build.end(), folder), end; match != end;
         ++match) {
      std::istringstream names((*match)[1]);
      for (std::string name; names >> name;) {
        if (is_under(name, "tests") || is_under(name, "bench")) continue;
        ++folders;
        CAPTURE(name);
        CHECK(std::any_of(copied.begin(), copied.end(),
                          [&](const std::string& path) { return is_under(name, path); }));
      }
    }
    CHECK(folders >= 7);
    CHECK(copied.contains("rules"));
  }
}
