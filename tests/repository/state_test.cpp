#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>

#include <doctest/doctest.h>

namespace {

namespace fs = std::filesystem;

/// What is kept between two calls, and why threads may use it all the same.
const std::map<std::string, std::string> kKeepers{
    {"kernel/base/name.cpp", "texts of names, behind a lock"},
    {"kernel/base/log.cpp", "loggers, behind a lock"},
    {"kernel/io/gltf/meshopt.cpp", "versions of the library, chosen once, behind a lock"},
    {"kernel/io/files/leftovers.cpp", "files of killed runs, behind a lock"},
    {"kernel/io/files/partial_files.cpp", "open outputs, of the one thread that writes"},
    {"studio/server/shared_work.cpp",
     "what a thread is at, of this thread; where a handler writes"},
};

/// A variable at namespace scope or of a function, that is not constant and outlives a call. Lines
/// are those of clang-format.
bool declares_state(const std::string& line) {
  static const std::regex of_function(R"(^\s+(static|thread_local) (?!const\b|constexpr\b)[^(]*$)");
  static const std::regex of_namespace(
      R"(^(static |inline |thread_local )?[A-Za-z_][\w:<>,*& ]* \w+(\[.*\])?( =.*|\{.*|;)$)");
  static const std::regex no_variable(
      R"(^(__extension__|using|namespace|struct|class|enum|constexpr|const|inline constexpr|inline const|static constexpr|static const|template|extern|return|friend|union|typedef|case)\b.*)");
  if (std::regex_match(line, of_function)) return true;
  return std::regex_match(line, of_namespace) && !std::regex_match(line, no_variable);
}

bool keeps_state(const fs::path& path) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (declares_state(line)) return true;
  return false;
}

}  // namespace

TEST_SUITE("repository") {
  // Why -j is one hash, and why the thread sanitizer looks at some rooms only
  // (tests/sanitized_rooms.cmake).
  TEST_CASE("rooms keep nothing between two calls but what is behind a lock") {
    CHECK(declares_state("  static std::map<int, int> seen;"));
    CHECK(declares_state("int calls = 0;"));
    CHECK(!declares_state("  static const std::regex pattern(\"a\");"));
    CHECK(!declares_state("  static int twice(int n) { return 2 * n; }"));
    std::map<std::string, std::string> found;
    for (const char* room : {"kernel", "interpret", "generalise", "oriel", "studio", "python"})
      for (const auto& entry :
           fs::recursive_directory_iterator(fs::path(ORIEL_SOURCE_DIR) / room)) {
        const bool is_code = entry.path().extension() == ".cpp" || entry.path().extension() == ".h";
        if (!is_code || !keeps_state(entry.path())) continue;
        const std::string file = fs::relative(entry.path(), ORIEL_SOURCE_DIR).string();
        found[file] = kKeepers.contains(file) ? kKeepers.at(file) : "not known";
      }
    CHECK((found == kKeepers));
  }
}
