#include "cli/completion/scripts.h"

#include <fmt/ranges.h>

namespace oriel::cli {
namespace {

constexpr const char* kBashHead = R"(# bash completion for oriel, made by `oriel completion bash`

_oriel() {
  local word command= previous= current=${COMP_WORDS[COMP_CWORD]} commands= options= i
  COMPREPLY=()
  for ((i = 1; i < COMP_CWORD; ++i)); do
    word=${COMP_WORDS[i]}
    case "$command:$word" in
      @STEPS@) command="${command:+$command }$word" ;;
    esac
  done
  # What a value is of: --from X, --from=X, in which bash makes = a word.
  previous=${COMP_WORDS[COMP_CWORD - 1]}
  if [ "$current" = "=" ]; then
    current=
  elif [ "$previous" = "=" ] && ((COMP_CWORD > 1)); then
    previous=${COMP_WORDS[COMP_CWORD - 2]}
  fi
  case "$command:$previous" in
)";

constexpr const char* kBashTail = R"(  esac
  if [[ $current == -* ]]; then
    COMPREPLY=($(compgen -W "$options" -- "$current"))
  elif [ -n "$commands" ]; then
    COMPREPLY=($(compgen -W "$commands" -- "$current"))
  fi
}

complete -o default -F _oriel oriel
)";

/// "label:--from" for each name of an option.
std::string named_values(const CompletedCommand& command, const CompletedOption& option) {
  std::string patterns;
  for (const std::string& name : option.names)
    patterns += (patterns.empty() ? "\"" : " | \"") + command.words + ":" + name + "\"";
  return patterns;
}

/// A case for each option with a value: its choices, or else names of files.
std::string value_cases(const CompletedCommand& command) {
  std::string cases;
  for (const CompletedOption& option : command.options) {
    if (!option.takes_value) continue;
    cases += "    " + named_values(command, option) + ")\n";
    if (!option.choices.empty())
      cases += fmt::format("      COMPREPLY=($(compgen -W \"{}\" -- \"$current\"))\n",
                           fmt::join(option.choices, " "));
    cases += "      return ;;\n";
  }
  return cases;
}

std::string words_case(const CompletedCommand& command) {
  std::vector<std::string> names, options;
  for (const CompletedCommand& below : command.commands) names.push_back(below.name);
  for (const CompletedOption& option : command.options)
    options.insert(options.end(), option.names.begin(), option.names.end());
  return fmt::format("    \"{}\")\n      commands=\"{}\"\n      options=\"{}\" ;;\n", command.words,
                     fmt::join(names, " "), fmt::join(options, " "));
}

}  // namespace

std::string bash_script(const CompletedCommand& tree) {
  std::string steps, values, words;
  for (const CompletedCommand* command : all_commands(tree)) {
    for (const CompletedCommand& below : command->commands)
      steps += (steps.empty() ? "\"" : " | \"") + command->words + ":" + below.name + "\"";
    values += value_cases(*command);
    words += words_case(*command);
  }
  std::string head = kBashHead;
  const std::string place = "@STEPS@";
  head.replace(head.find(place), place.size(), steps);
  return head + values + "  esac\n  case \"$command\" in\n" + words + kBashTail;
}

}  // namespace oriel::cli
