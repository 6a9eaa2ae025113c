#include "tests/cli/command.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <regex>
#include <set>

#include <doctest/doctest.h>

using namespace oriel::test;

namespace {

/// A command as `--help` shows it.
struct ShownCommand {
  std::vector<std::string> words;
  std::set<std::string> commands, options;

  [[nodiscard]] std::string line() const {
    std::string text;
    for (const std::string& word : words) text += (text.empty() ? "" : " ") + word;
    return text;
  }
};

ShownCommand shown(const std::vector<std::string>& words) {
  std::vector<std::string> arguments = words;
  arguments.emplace_back("--help");
  ShownCommand command{words, {}, {}};
  bool is_below_commands = false;
  const std::regex option(
      "^ {2,4}(-[a-zA-Z]),?(--[a-z0-9-]+)?( .*)?$|^ {2,4}(--[a-z0-9-]+)( .*)?$");
  const std::regex name("^  ([a-z]+) .*");
  std::smatch match;
  for (const std::string& line : lines_of(run(arguments).out)) {
    if (!line.starts_with(" ")) is_below_commands = line == "Subcommands:";
    if (std::regex_match(line, match, option))
      for (const int part : {1, 2, 4})
        if (match[static_cast<std::size_t>(part)].matched)
          command.options.insert(match[static_cast<std::size_t>(part)]);
    if (is_below_commands && std::regex_match(line, match, name)) command.commands.insert(match[1]);
  }
  return command;
}

void add_with_those_below(const std::vector<std::string>& words, std::vector<ShownCommand>& all) {
  all.push_back(shown(words));
  for (const std::string& name : std::set<std::string>(all.back().commands)) {
    std::vector<std::string> below = words;
    below.push_back(name);
    add_with_those_below(below, all);
  }
}

const std::vector<ShownCommand>& all_shown() {
  static const std::vector<ShownCommand> all = [] {
    std::vector<ShownCommand> found;
    add_with_those_below({}, found);
    return found;
  }();
  return all;
}

std::string output_of(const std::string& shell_line) {
  std::string out;
  std::array<char, 4096> part{};
  FILE* pipe = ::popen(shell_line.c_str(), "r");
  REQUIRE(pipe != nullptr);
  while (const std::size_t size = std::fread(part.data(), 1, part.size(), pipe))
    out.append(part.data(), size);
  CHECK(::pclose(pipe) == 0);
  return out;
}

bool is_installed(const std::string& program) {
  return std::system(("command -v " + program + " >/dev/null").c_str()) == 0;
}

std::string script_of(const std::string& shell) {
  const Outcome outcome = run({"completion", shell});
  CHECK(outcome.exit == 0);
  CHECK(outcome.err.empty());
  return outcome.out;
}

std::set<std::string> words_in(const std::string& text) {
  std::set<std::string> words;
  const std::regex word("[^ \n\t]+");
  for (std::sregex_iterator one(text.begin(), text.end(), word), end; one != end; ++one)
    words.insert(one->str());
  return words;
}

std::string lines_with(const std::string& text, const std::string& beginning) {
  std::string found;
  for (const std::string& line : lines_of(text))
    if (line.starts_with(beginning)) found += line + "\n";
  return found;
}

/// What bash has for each line, in its order, the last word being the one that is completed.
std::vector<std::set<std::string>> completed_by_bash(const std::vector<std::string>& lines) {
  const Folder folder;
  std::string program = "source " + folder.write("oriel.bash", script_of("bash")) + "\n";
  for (const std::string& line : lines)
    program += "COMP_WORDS=(" + line +
               ") COMP_CWORD=$((${#COMP_WORDS[@]} - 1)); _oriel; echo \"${COMPREPLY[*]}\"\n";
  const std::string file = folder.write("program.bash", program);
  std::vector<std::set<std::string>> completed;
  for (const std::string& line : lines_of(output_of("bash " + file)))
    completed.push_back(words_in(line));
  REQUIRE(completed.size() == lines.size());
  return completed;
}

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("bash completes every command and option that help shows and no other") {
    std::vector<std::string> lines;
    for (const ShownCommand& command : all_shown()) {
      lines.push_back("oriel " + command.line() + " ''");
      lines.push_back("oriel " + command.line() + " -");
    }
    const std::vector<std::set<std::string>> completed = completed_by_bash(lines);
    CHECK(all_shown().size() > 20);
    for (std::size_t i = 0; i < all_shown().size(); ++i) {
      CAPTURE(all_shown()[i].line());
      CHECK(completed[2 * i] == all_shown()[i].commands);
      CHECK(completed[2 * i + 1] == all_shown()[i].options);
    }
  }

  TEST_CASE("bash completes the values of an option") {
    const std::set<std::string> orders{"natural", "paper"};
    const std::vector<std::set<std::string>> completed =
        completed_by_bash({"oriel label --order ''", "oriel label --order = p",
                           "oriel segment --order =", "oriel label --order natural --cl",
                           "oriel label --output ''", "oriel rules che", "oriel label rules ''"});
    CHECK(completed[0] == orders);
    CHECK(completed[1] == std::set<std::string>{"paper"});
    CHECK(completed[2] == orders);
    CHECK(completed[3] ==
          std::set<std::string>{"--close", "--close-area", "--closed-installations"});
    CHECK(completed[4].empty());  // files, which bash knows
    CHECK(completed[5] == std::set<std::string>{"check"});
    CHECK(completed[6].empty());
  }

  TEST_CASE("the scripts for zsh and fish have every command and option") {
    const std::string zsh = script_of("zsh"), fish = script_of("fish");
    for (const ShownCommand& command : all_shown()) {
      CAPTURE(command.line());
      std::string name = "\n_oriel" + (command.words.empty() ? "" : "_" + command.line());
      std::ranges::replace(name, ' ', '_');
      const std::size_t begin = zsh.find(name + "() {\n");
      REQUIRE(begin != std::string::npos);
      const std::string body = zsh.substr(begin, zsh.find("\n}\n", begin) - begin);
      const std::string line = "complete -c oriel -n '__oriel_command " + command.line() + "'";
      const std::string options = lines_with(fish, line);
      for (const std::string& option : command.options) {
        CAPTURE(option);
        CHECK(std::regex_search(body, std::regex("[ {,']" + option + "['},]")));
        const std::string as_fish =
            option.starts_with("--") ? "-l " + option.substr(2) : "-s " + option.substr(1);
        CHECK(options.find(" " + as_fish + " ") != std::string::npos);
      }
      for (const std::string& below : command.commands) {
        CAPTURE(below);
        CHECK(body.find("\n        '" + below + ":") != std::string::npos);
        CHECK(fish.find(line + " -f -a " + below + " -d ") != std::string::npos);
      }
    }
  }

  TEST_CASE("the shells read their scripts") {
    const Folder folder;
    for (const std::string shell : {"bash", "zsh", "fish"}) {
      const std::string file = folder.write(shell, script_of(shell));
      if (is_installed(shell))
        CHECK(output_of(shell + " -n " + file + " 2>&1") == "");
      else
        MESSAGE("skipped: no " << shell);
    }
  }

  TEST_CASE("a shell without a script is named") {
    const Outcome outcome = run({"completion", "tcsh"});
    CHECK(outcome.exit == 2);
    CHECK(outcome.says("tcsh"));
  }
}
