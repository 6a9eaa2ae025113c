#include "cli/batch/inputs/neighbours.h"

#include "cli/batch/inputs/input_files.h"
#include "kernel/base/log.h"
#include "oriel/neighbours.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace oriel::cli {

namespace {

/// The run itself says what is wrong with an input.
void add_input(const std::string& file, const RunOptions& options, NeighbourSearch& search) {
  try {
    add_buildings(file, options.read_options(file), search, [](const std::vector<Issue>&) {});
  } catch (const InputError&) {
    run_log().debug("neighbours: {} cannot be read", file);
  }
}

}  // namespace

std::vector<std::string> files_of_neighbours(const std::vector<std::string>& named,
                                             const std::string& from) {
  std::vector<std::string> files;
  for (const std::string& name : named) {
    if (name == kInputsOnly) continue;
    std::error_code error;
    const auto in_folder = std::filesystem::is_directory(name, error) ? files_in(name, from)
                                                                      : std::vector<std::string>{};
    if (in_folder.empty())
      files.push_back(name);
    else
      files.insert(files.end(), in_folder.begin(), in_folder.end());
  }
  return files;
}

void find_neighbours(RunOptions& options, Report& report, const std::string& output) {
  if (options.neighbours_of.empty()) return;
  const std::vector<std::string> files = files_of_neighbours(options.neighbours_of, options.from);
  if (files.empty() && std::ranges::count(options.inputs, "-") > 0)
    throw CLI::ValidationError(
        "--neighbours",
        "stdin can be read only once, and neighbours are looked for before the first building is "
        "written: name a file that has all buildings, --neighbours=FILE");
  auto search = std::make_shared<NeighbourSearch>(ScratchSpace{.beside = output});
  for (const std::string& input : options.inputs)
    if (input != "-") add_input(input, options, *search);
  for (const std::string& file : files) {
    refuse_folder(file);
    add_buildings(file, options.read_options(file), *search,
                  [&](const std::vector<Issue>& issues) { report.add(faults_beside(issues)); });
  }
  search->finish();
  report.add(search->issues());
  run_log().info("neighbours: buildings={}", search->size());
  options.neighbours = std::move(search);
}

void find_kept_ground(RunOptions& options) {
  if (!options.keep_free.empty())
    options.kept = read_kept_ground(options.keep_free, options.neighbours.get());
}

}  // namespace oriel::cli
