#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace oriel::test {

/// A fenced block of a page, or what a comment has done before it.
struct PageBlock {
  /// "console", "sh", "yaml" …; "" of a bare fence; "first" of a comment `<!-- first: COMMANDS
  /// -->`, which makes what a reader has at hand and the page does not show.
  std::string language{};
  /// From a comment `<!-- not run: REASON -->` straight before the fence.
  std::string why_not_run{};
  /// Without the fences.
  std::vector<std::string> lines{};
  /// The index of the line of the page behind the fence.
  std::size_t begin = 0;

  [[nodiscard]] std::string text() const;
};

struct Page {
  /// Relative to the repository.
  std::filesystem::path path{};
  std::vector<std::string> lines{};
  /// In the order of the page.
  std::vector<PageBlock> blocks{};
};

/// A command of a console block, and what the page says that it prints.
struct ShownCommand {
  /// Without `$ `; several lines if all but the last end in a backslash.
  std::string text{};
  std::vector<std::string> printed{};
};

Page parse_page(const std::filesystem::path& path, const std::string& text);

/// README.md, SECURITY.md, CONTRIBUTING.md, docs/*.md and every README.md in examples.
std::vector<Page> read_pages();

/// Empty if the block does not begin with a command.
std::vector<ShownCommand> commands_of(const PageBlock& console);

/// The lines of the block, `$ ` before each command.
std::vector<std::string> lines_of_commands(const std::vector<ShownCommand>& commands);

/// The page with other lines in some of its blocks: `changed` has one entry for each block.
std::string with_blocks(const Page& page, const std::vector<std::vector<std::string>>& changed);

}  // namespace oriel::test
