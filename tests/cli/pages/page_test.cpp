#include "tests/cli/pages/page.h"

#include "tests/cli/pages/shell.h"

#include <doctest/doctest.h>

using namespace oriel::test;

using Lines = std::vector<std::string>;

TEST_SUITE("cli") {
  TEST_CASE("blocks of a page are read with their comments and written back") {
    const std::string text =
        "# T\n<!-- first: cd a\ncd b -->\n\n```console\n$ x \\\n  y\nout\n$ z\n```\n\n"
        "<!-- not run: too long -->\n\n```sh\nlong\n```\nand `a`\n";
    const Page page = parse_page("t.md", text);
    REQUIRE(page.blocks.size() == 3);
    CHECK(page.blocks[0].lines == Lines{"cd a", "cd b"});
    CHECK(page.blocks[2].why_not_run == "too long");
    const std::vector<ShownCommand> commands = commands_of(page.blocks[1]);
    REQUIRE(commands.size() == 2);
    CHECK(commands[0].text == "x \\\n  y");
    CHECK(commands[0].printed == Lines{"out"});
    CHECK(commands[1].printed.empty());
    CHECK(lines_of_commands(commands) == page.blocks[1].lines);
    CHECK(with_blocks(page, {{}, page.blocks[1].lines, page.blocks[2].lines}) == text);
    CHECK(with_blocks(page, {{}, {"$ x"}, {"short"}}).find("```console\n$ x\n```") !=
          std::string::npos);
  }

  TEST_CASE("commands of a page share a shell and show stdout and stderr in their order") {
    const std::vector<Shown> shown =
        Checkout().run({"cd examples; x='a b'", "printf '%s\\n' \"$x\"; echo c >&2; (exit 3)",
                        "echo $?; ls first_pack.yaml", "printf no-end", "exit 5", "echo never"});
    CHECK(shown[1].lines == Lines{"a b", "c"});
    CHECK(shown[1].exit == 3);
    CHECK(shown[2].lines == Lines{"3", "first_pack.yaml"});
    CHECK(shown[3].lines == Lines{"no-end"});
    CHECK(shown[4].exit == -1);
    CHECK(shown[5].exit == -1);
  }

  TEST_CASE("what oriel says stands on a page as on a terminal") {
    const std::vector<Shown> shown =
        Checkout().run({"oriel validate tests/data/errors/E344_203.city.json",
                        "oriel-generate --help >/dev/null"});
    REQUIRE(shown[0].lines.size() == 3);
    CHECK(shown[0].lines.front() == "cube: 1 finding");
    CHECK(shown[0].lines.back().starts_with("0 of 1 building is valid"));
    CHECK(shown[1].exit == 0);
  }
}
