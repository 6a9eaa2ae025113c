#include "tests/cli/pages/page.h"

#include "tests/cli/command.h"

#include <algorithm>
#include <utility>

namespace oriel::test {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kFence = "```";
constexpr std::string_view kFirst = "<!-- first:";
constexpr std::string_view kNotRun = "<!-- not run:";

std::string stripped(std::string text) {
  const auto is_space = [](char c) { return c == ' ' || c == '\n'; };
  text.erase(text.begin(), std::ranges::find_if_not(text, is_space));
  while (!text.empty() && is_space(text.back())) text.pop_back();
  return text;
}

/// What stands between the colon and `-->`; moves `at` to the line with the latter.
std::string comment_at(const std::vector<std::string>& lines, std::size_t& at) {
  std::string text = lines[at].substr(lines[at].find(':') + 1);
  while (text.find("-->") == std::string::npos && at + 1 < lines.size()) text += "\n" + lines[++at];
  return stripped(text.substr(0, text.find("-->")));
}

}  // namespace

std::string PageBlock::text() const {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

Page parse_page(const fs::path& path, const std::string& text) {
  Page page{path, lines_of(text), {}};
  std::string why_not_run;
  for (std::size_t i = 0; i < page.lines.size(); ++i) {
    const std::string& line = page.lines[i];
    if (line.starts_with(kNotRun)) {
      why_not_run = comment_at(page.lines, i);
    } else if (line.starts_with(kFirst)) {
      page.blocks.push_back({"first", "", lines_of(comment_at(page.lines, i)), i + 1});
    } else if (line.starts_with(kFence)) {
      PageBlock block{line.substr(kFence.size()), std::exchange(why_not_run, ""), {}, i + 1};
      while (++i < page.lines.size() && page.lines[i] != kFence)
        block.lines.push_back(page.lines[i]);
      page.blocks.push_back(std::move(block));
    } else if (!line.empty()) {
      why_not_run.clear();
    }
  }
  return page;
}

std::vector<Page> read_pages() {
  const fs::path root = ORIEL_SOURCE_DIR;
  std::vector<fs::path> paths{"CONTRIBUTING.md", "README.md", "SECURITY.md"};
  for (const auto& entry : fs::directory_iterator(root / "docs"))
    if (entry.path().extension() == ".md") paths.push_back(fs::relative(entry.path(), root));
  for (const auto& entry : fs::recursive_directory_iterator(root / "examples"))
    if (entry.path().filename() == "README.md") paths.push_back(fs::relative(entry.path(), root));
  std::ranges::sort(paths);
  std::vector<Page> pages;
  for (const fs::path& path : paths) pages.push_back(parse_page(path, bytes_of(root / path)));
  return pages;
}

std::vector<ShownCommand> commands_of(const PageBlock& console) {
  std::vector<ShownCommand> commands;
  bool goes_on = false;
  for (const std::string& line : console.lines) {
    if (goes_on) {
      commands.back().text += "\n" + line;
    } else if (line.starts_with("$ ")) {
      commands.push_back({line.substr(2), {}});
    } else if (commands.empty()) {
      return {};
    } else {
      commands.back().printed.push_back(line);
      continue;
    }
    goes_on = line.ends_with("\\");
  }
  return commands;
}

std::vector<std::string> lines_of_commands(const std::vector<ShownCommand>& commands) {
  std::vector<std::string> lines;
  for (const ShownCommand& command : commands) {
    const std::vector<std::string> text = lines_of("$ " + command.text);
    lines.insert(lines.end(), text.begin(), text.end());
    lines.insert(lines.end(), command.printed.begin(), command.printed.end());
  }
  return lines;
}

std::string with_blocks(const Page& page, const std::vector<std::vector<std::string>>& changed) {
  std::string text;
  std::size_t at = 0;
  const auto add = [&](const std::string& line) { text += line + "\n"; };
  for (std::size_t i = 0; i < page.blocks.size(); ++i) {
    const PageBlock& block = page.blocks[i];
    if (block.language == "first") continue;
    for (; at < block.begin; ++at) add(page.lines[at]);
    for (const std::string& line : changed[i]) add(line);
    at = block.begin + block.lines.size();
  }
  for (; at < page.lines.size(); ++at) add(page.lines[at]);
  return text;
}

}  // namespace oriel::test
