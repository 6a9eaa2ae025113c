#include "cli/completion/scripts.h"

#include <algorithm>

#include <fmt/ranges.h>

namespace oriel::cli {
namespace {

/// Between single quotes, in which '\'' is a quote; what `special` has is escaped for _arguments.
std::string zsh_text(const std::string& text, const std::string& special) {
  std::string out;
  for (const char c : text) {
    if (c == '\'')
      out += "'\\''";
    else if (special.find(c) != std::string::npos)
      out += std::string("\\") + c;
    else
      out += c;
  }
  return out;
}

std::string function_name(const CompletedCommand& command) {
  std::string name = command.words.empty() ? "_oriel" : "_oriel_" + command.words;
  std::ranges::replace(name, ' ', '_');
  return name;
}

std::string value_of(const CompletedOption& option) {
  if (!option.takes_value) return "";
  if (!option.choices.empty()) return fmt::format(":value:({})", fmt::join(option.choices, " "));
  return option.is_number ? ":number: " : ":value:_files";
}

/// An option for _arguments: '(-o --output)'{-o,--output}'[sentence]:value:_files'. Only what may
/// be repeated is offered again once it is there.
std::string specification(const CompletedOption& option) {
  const std::string tail = "'[" + zsh_text(option.sentence, "[]:\\") + "]" + value_of(option) + "'";
  const std::string before = option.is_repeated ? "'*'"
                             : option.names.size() > 1
                                 ? fmt::format("'({})'", fmt::join(option.names, " "))
                                 : "";
  if (option.names.size() == 1) return before + option.names[0] + tail;
  return fmt::format("{}{{{}}}{}", before, fmt::join(option.names, ","), tail);
}

std::string options_of(const CompletedCommand& command) {
  std::string lines;
  for (const CompletedOption& option : command.options)
    lines += "    " + specification(option) + " \\\n";
  return lines;
}

std::string leaf_function(const CompletedCommand& command) {
  return function_name(command) + "() {\n  _arguments -s -S \\\n" + options_of(command) +
         "    '*:file:_files'\n}\n\n";
}

/// Of a command that has others: their names with what they do, then what each completes itself.
std::string branch_function(const CompletedCommand& command) {
  std::string names, calls;
  for (const CompletedCommand& below : command.commands) {
    names += "        '" + below.name + ":" + zsh_text(below.sentence, ":\\") + "'\n";
    calls += "        " + below.name + ") " + function_name(below) + " ;;\n";
  }
  return function_name(command) +
         "() {\n  local curcontext=$curcontext state line\n  local -a commands\n"
         "  _arguments -C -s -S \\\n" +
         options_of(command) + "    '1: :->command' \\\n    '*:: :->rest'\n" +
         "  case $state in\n    command)\n      commands=(\n" + names +
         "      )\n      _describe -t commands command commands ;;\n    rest)\n"
         "      case $line[1] in\n" +
         calls + "      esac ;;\n  esac\n}\n\n";
}

}  // namespace

std::string zsh_script(const CompletedCommand& tree) {
  std::string script =
      "#compdef oriel\n# zsh completion for oriel, made by `oriel completion zsh`\n\n";
  for (const CompletedCommand* command : all_commands(tree))
    script += command->commands.empty() ? leaf_function(*command) : branch_function(*command);
  // Loaded by compinit the file is the function itself; sourced, it names it.
  return script +
         "if [ \"$funcstack[1]\" = _oriel ]; then\n  _oriel \"$@\"\nelse\n  compdef _oriel "
         "oriel\nfi\n";
}

}  // namespace oriel::cli
