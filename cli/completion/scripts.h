#pragma once

#include "cli/completion/command_tree.h"

#include <string>

namespace oriel::cli {

/// Scripts by which a shell completes the commands, options and values of `oriel`; where a file may
/// stand, its names of files.
std::string bash_script(const CompletedCommand& tree);
std::string zsh_script(const CompletedCommand& tree);
std::string fish_script(const CompletedCommand& tree);

}  // namespace oriel::cli
