#include "cli/completion/scripts.h"

#include <fmt/ranges.h>

namespace oriel::cli {
namespace {

constexpr const char* kFishHead = R"(# fish completion for oriel, made by `oriel completion fish`

# True if the commands that stand on the line so far are these.
function __oriel_command
    set -l command
    for word in (commandline -opc)[2..]
        switch "$command:$word"
            case @STEPS@
                set command (string trim "$command $word")
        end
    end
    test "$command" = "$argv"
end

)";

/// Between single quotes, in which \ and ' are escaped.
std::string fish_text(const std::string& text) {
  std::string out = "'";
  for (const char c : text) {
    if (c == '\'' || c == '\\') out += '\\';
    out += c;
  }
  return out + "'";
}

std::string fish_line(const CompletedCommand& command) {
  return "complete -c oriel -n " + fish_text("__oriel_command " + command.words);
}

std::string fish_option(const CompletedOption& option) {
  std::string out;
  for (const std::string& name : option.names)
    out += name.starts_with("--") ? " -l " + name.substr(2) : " -s " + name.substr(1);
  if (!option.choices.empty())
    out += fmt::format(" -x -a '{}'", fmt::join(option.choices, " "));
  else if (option.takes_value)
    out += option.is_number ? " -x" : " -r -F";
  return out + " -d " + fish_text(option.sentence);
}

}  // namespace

std::string fish_script(const CompletedCommand& tree) {
  std::string steps, lines;
  for (const CompletedCommand* command : all_commands(tree)) {
    for (const CompletedCommand& below : command->commands) {
      steps += (steps.empty() ? "'" : " '") + command->words + ":" + below.name + "'";
      lines +=
          fish_line(*command) + " -f -a " + below.name + " -d " + fish_text(below.sentence) + "\n";
    }
    for (const CompletedOption& option : command->options)
      lines += fish_line(*command) + fish_option(option) + "\n";
  }
  std::string head = kFishHead;
  const std::string place = "@STEPS@";
  head.replace(head.find(place), place.size(), steps);
  return head + lines;
}

}  // namespace oriel::cli
