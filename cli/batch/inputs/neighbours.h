#pragma once

#include "cli/batch/run_options.h"
#include "cli/terminal/logging.h"

#include <string>
#include <vector>

namespace oriel::cli {

/// What --neighbours without a file is read as.
inline constexpr const char* kInputsOnly = "true";

/// The files that --neighbours names besides the inputs, of what was given; a folder stands for its
/// files, of the format `from` if that is not empty.
std::vector<std::string> files_of_neighbours(const std::vector<std::string>& named,
                                             const std::string& from);

/// With --neighbours: reads all inputs and the files that it names, keeps of each building what
/// others must know of it, and fills options.neighbours. The inputs are settled. What is wrong with
/// an input is left to the run itself; a named file that cannot be read is an InputError. Throws
/// CLI::ValidationError if stdin is the only source: it can be read once only. What does not fit
/// into memory is kept beside the output (ScratchSpace::beside).
void find_neighbours(RunOptions& options, Report& report, const std::string& output = {});

/// With --keep-free: reads the files and fills options.kept. Throws InputError as
/// read_kept_ground() does.
void find_kept_ground(RunOptions& options);

}  // namespace oriel::cli
