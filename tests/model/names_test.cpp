#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <string>

#include <doctest/doctest.h>

namespace oriel {
namespace {

namespace fs = std::filesystem;

bool is_source(const fs::path& path) {
  return path.extension() == ".h" || path.extension() == ".cpp";
}

/// By qualified name of every type at namespace scope the file that defines it. Namespaces and
/// types begin in the first column here (clang-format), types without a name for the linker in
/// `namespace {`.
void collect(const fs::path& file, std::map<std::string, std::string>& file_of) {
  static const std::regex kNamespace(R"(^namespace ([\w:]*) ?\{.*)");
  static const std::regex kType(R"(^(class|struct|union) (\w+)( final)?( : .*)?( ?\{.*))");
  std::ifstream in(file);
  std::string scope;
  bool is_local = false;
  for (std::string line; std::getline(in, line);) {
    std::smatch match;
    if (std::regex_match(line, match, kNamespace)) {
      is_local = match[1].length() == 0;
      if (!is_local) scope = match[1];
    } else if (line.starts_with("}  // namespace") && is_local) {
      is_local = false;
    } else if (!is_local && std::regex_match(line, match, kType)) {
      const std::string name = scope + "::" + match[2].str();
      const auto [found, is_new] = file_of.try_emplace(name, file.string());
      CHECK_MESSAGE(is_new, name, " is defined in ", found->second, " and in ", file.string());
    }
  }
}

TEST_SUITE("model") {
  // Two types of one name in one program are undefined behaviour that no compiler tells of.
  TEST_CASE("no two types of the program have one name") {
    std::map<std::string, std::string> file_of;
    for (const char* room : {"model", "kernel", "io", "interpret", "generalise", "studio", "cli",
                             "examples/generator"})
      for (const auto& entry : fs::recursive_directory_iterator(fs::path(ORIEL_SOURCE_DIR) / room))
        if (is_source(entry.path())) collect(entry.path(), file_of);
    CHECK(file_of.size() > 200);
  }
}

}  // namespace
}  // namespace oriel
