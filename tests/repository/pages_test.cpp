#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace {

namespace fs = std::filesystem;

const fs::path kRoot = ORIEL_SOURCE_DIR;

std::string page_text(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// README.md, CONTRIBUTING.md, CHANGELOG.md, SECURITY.md, docs/*.md and the README.md of every room
/// and example.
std::vector<fs::path> pages() {
  std::vector<fs::path> found;
  for (const char* name : {"README.md", "CONTRIBUTING.md", "CHANGELOG.md", "SECURITY.md"})
    if (fs::exists(kRoot / name)) found.push_back(kRoot / name);
  for (const char* folder : {"docs", "model", "kernel", "io", "interpret", "generalise", "oriel",
                             "experiments", "studio", "cli", "python", "examples", "bench"})
    if (fs::exists(kRoot / folder))
      for (const auto& entry : fs::recursive_directory_iterator(kRoot / folder))
        if (entry.path().extension() == ".md") found.push_back(entry.path());
  std::ranges::sort(found);
  return found;
}

/// The page without fenced blocks: they show what the program prints.
std::string without_blocks(const std::string& text) {
  std::string out;
  bool is_in_block = false;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    const std::string line = text.substr(begin, end - begin);
    if (line.starts_with("```"))
      is_in_block = !is_in_block;
    else if (!is_in_block)
      out += line + "\n";
    begin = end + 1;
  }
  return out;
}

/// What the Markdown renderers make of a heading.
std::string anchor_of(const std::string& heading) {
  std::string out;
  for (const char c : heading) {
    const auto byte = static_cast<unsigned char>(c);
    if (std::isalnum(byte) != 0 || c == '-' || c == '_' || byte >= 128)
      out += static_cast<char>(std::tolower(byte));
    else if (c == ' ')
      out += '-';
  }
  return out;
}

const std::set<std::string>& anchors_of(const fs::path& page) {
  static std::map<std::string, std::set<std::string>> of_pages;
  const auto [known, is_new] = of_pages.try_emplace(fs::canonical(page).string());
  std::set<std::string>& anchors = known->second;
  if (!is_new) return anchors;
  const std::string text = without_blocks(page_text(page));
  const std::regex heading("(^|\n)#+ ([^\n]*)");
  for (std::sregex_iterator match(text.begin(), text.end(), heading), end; match != end; ++match)
    anchors.insert(anchor_of((*match)[2]));
  return anchors;
}

std::vector<std::string> all_matches(const std::string& text, const std::string& pattern) {
  std::vector<std::string> found;
  const std::regex regex(pattern);
  for (std::sregex_iterator match(text.begin(), text.end(), regex), end; match != end; ++match)
    found.push_back((*match)[1]);
  return found;
}

}  // namespace

TEST_SUITE("repository") {
  TEST_CASE("every link of every page leads to a file and a heading that are there") {
    std::size_t links = 0;
    for (const fs::path& page : pages())
      for (const std::string& link :
           all_matches(without_blocks(page_text(page)), R"(\]\(([^)\s]+)\))")) {
        if (link.starts_with("http")) continue;
        ++links;
        const std::size_t hash = link.find('#');
        const std::string file = link.substr(0, hash);
        const fs::path target = file.empty() ? page : page.parent_path() / file;
        CHECK_MESSAGE(fs::exists(target), page.string(), ": ", link);
        if (hash == std::string::npos || target.extension() != ".md" || !fs::exists(target))
          continue;
        CHECK_MESSAGE(anchors_of(target).contains(link.substr(hash + 1)), page.string(), ": ",
                      link);
      }
    CHECK(links > 100);
  }

  TEST_CASE("every path of the repository that a page names is there") {
    const std::string pattern =
        R"(`((?:docs|model|kernel|io|interpret|generalise|oriel|experiments|studio|cli|python|rules|tests|bench|examples)/[A-Za-z0-9_./-]+)`)";
    std::size_t paths = 0;
    for (const fs::path& page : pages()) {
      if (page.filename() == "CHANGELOG.md") continue;  // what was
      for (const std::string& path : all_matches(without_blocks(page_text(page)), pattern)) {
        if (path.starts_with("oriel/1") || path.starts_with("oriel-")) continue;  // a schema
        ++paths;
        const fs::path whole = kRoot / path;
        const bool is_there = fs::exists(whole) || fs::exists(whole.string() + ".h") ||
                              fs::exists(whole.string() + ".cpp");
        CHECK_MESSAGE(is_there, page.string(), ": ", path);
      }
      // Folders that the table of a room lists, of itself or of its sources.
      if (page.filename() == "README.md")
        for (const std::string& folder : all_matches(page_text(page), R"(\n\| `([a-z_]+/)` \|)"))
          CHECK_MESSAGE((fs::exists(page.parent_path() / folder) ||
                         fs::exists(page.parent_path() / "src" / folder)),
                        page.string(), ": ", folder);
    }
    CHECK(paths > 50);
  }

  TEST_CASE("every test that the page of promises names is there") {
    std::string tests;
    for (const auto& entry : fs::recursive_directory_iterator(kRoot / "tests"))
      if (entry.path().extension() == ".cpp" || entry.path().extension() == ".cmake" ||
          entry.path().filename() == "CMakeLists.txt")
        tests += page_text(entry.path());
    // Names that go over several lines of source.
    tests = std::regex_replace(tests, std::regex("\"\\s*\\n\\s*\""), "");
    const std::string page = page_text(kRoot / "docs" / "trust.md");
    static const std::regex row("\\n\\|[^\\n]*"), quoted("\"([^\"]+)\"");
    int names = 0;
    for (std::sregex_iterator line(page.begin(), page.end(), row), end; line != end; ++line) {
      const std::string cells = line->str();
      for (std::sregex_iterator name(cells.begin(), cells.end(), quoted); name != end; ++name) {
        CAPTURE((*name)[1].str());
        CHECK(tests.find((*name)[1].str()) != std::string::npos);
        ++names;
      }
    }
    CHECK(names > 0);
  }

  TEST_CASE("every room has a page that says what happens in it") {
    std::vector<fs::path> rooms;
    for (const char* room : {"model", "kernel", "io", "interpret", "generalise", "oriel",
                             "experiments", "studio", "cli", "python"})
      if (fs::exists(kRoot / room)) rooms.push_back(kRoot / room);
    for (const auto& entry : fs::directory_iterator(kRoot / "kernel"))
      if (entry.is_directory()) rooms.push_back(entry.path());
    for (const fs::path& room : rooms) CHECK_MESSAGE(fs::exists(room / "README.md"), room.string());
  }
}
