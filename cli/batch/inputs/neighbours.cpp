#include "cli/batch/inputs/neighbours.h"

#include "cli/batch/inputs/input_files.h"
#include "kernel/base/log.h"
#include "oriel/neighbours.h"
#include "oriel/read.h"

#include <algorithm>
#include <filesystem>
#include <memory>
#include <system_error>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

namespace oriel::cli {

namespace {

/// Calls tell(issues) for what is wrong in the file.
template <class Tell>
void add_buildings_of(const std::string& file, const RunOptions& options, NeighbourSearch& search,
                      Tell tell) {
  Reader reader(file, options.read_options(file));
  while (const auto document = reader.next()) {
    tell(document->issues);
    if (!document->value) continue;
    for (const Building& building : document->value->buildings) search.add(building);
  }
}

/// Errors of a file that is only looked at cost its buildings, not the run: they are warnings.
std::vector<Issue> as_warnings(std::vector<Issue> issues) {
  std::erase_if(issues, [](const Issue& issue) { return issue.severity != Severity::error; });
  for (Issue& issue : issues) issue.severity = Severity::warning;
  return issues;
}

/// The run itself says what is wrong with an input.
void add_input(const std::string& file, const RunOptions& options, NeighbourSearch& search) {
  try {
    add_buildings_of(file, options, search, [](const std::vector<Issue>&) {});
  } catch (const InputError&) {
    run_log().debug("neighbours: {} cannot be read", file);
  }
}

}  // namespace

std::vector<std::string> files_of_neighbours(const RunOptions& options) {
  std::vector<std::string> files;
  for (const std::string& named : options.neighbours_of) {
    if (named == kInputsOnly) continue;
    std::error_code error;
    const auto in_folder = std::filesystem::is_directory(named, error)
                               ? files_in(named, options.from)
                               : std::vector<std::string>{};
    if (in_folder.empty())
      files.push_back(named);
    else
      files.insert(files.end(), in_folder.begin(), in_folder.end());
  }
  return files;
}

void find_neighbours(RunOptions& options, Report& report, const std::string& output) {
  if (options.neighbours_of.empty()) return;
  const std::vector<std::string> files = files_of_neighbours(options);
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
    add_buildings_of(file, options, *search,
                     [&](const std::vector<Issue>& issues) { report.add(as_warnings(issues)); });
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
