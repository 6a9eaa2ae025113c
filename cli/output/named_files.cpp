#include "cli/output/named_files.h"

#include "cli/batch/inputs/neighbours.h"
#include "cli/batch/run_options.h"
#include "cli/options/options.h"
#include "io/files/partial_files.h"

#include <optional>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

namespace oriel::cli {

/// Where files are, each with what named it first.
class NamedFiles::Places {
 public:
  /// What named the same file before, or null; then it is remembered. `descriptor`: an open file in
  /// place of the path.
  const Named* enter(const Named& named, int descriptor = -1) {
    struct stat found {};
    const bool exists =
        (descriptor >= 0 ? ::fstat(descriptor, &found) : ::stat(named.path.c_str(), &found)) == 0;
    if (exists && !S_ISREG(found.st_mode)) return nullptr;
    if (!exists && descriptor >= 0) return nullptr;
    const Named* first = nullptr;
    if (exists) first = enter(by_number_, {found.st_dev, found.st_ino}, named);
    if (descriptor >= 0) return first;
    const Named* by_path = enter(by_path_, detail::resolved(named.path), named);
    return first != nullptr ? first : by_path;
  }

  /// Only one output can be stdout.
  const Named* enter_stdout(const Named& named) {
    if (stdout_ != nullptr) return stdout_;
    stdout_ = &named;
    return nullptr;
  }

 private:
  template <class Map>
  static const Named* enter(Map& map, const typename Map::key_type& key, const Named& named) {
    const auto [place, is_new] = map.try_emplace(key, &named);
    return is_new ? nullptr : place->second;
  }

  std::map<std::string, const Named*> by_path_;
  std::map<FileNumber, const Named*> by_number_;
  const Named* stdout_ = nullptr;
};

void NamedFiles::add_output(const std::string& option, const std::string& path,
                            const std::string& loss) {
  if (!path.empty()) outputs_.push_back({option, path, true, loss});
}

void NamedFiles::add_input(const std::string& option, const std::string& path) {
  if (!path.empty()) inputs_.push_back({option, path, false});
}

void NamedFiles::add(const RunOptions& options) {
  offers_force_ = options.offers_force;
  is_forced_ = options.is_forced;
  for (const std::string& input : options.inputs) add_input("input", input);
  for (const std::string& file : files_of_neighbours(options.neighbours_of, options.from))
    add_input("--neighbours", file);
  for (const std::string& file : options.keep_free) add_input("--keep-free", file);
  add_output("--timings", options.timings_file);
  if (options.status_stem.empty()) return;
  for (const char* ending : {".status.json", ".quarantine.jsonl", ".journal"})
    add_output("--status", options.status_stem + ending);
}

/// An input of the run, which comes back changed; never rules or truth.
bool NamedFiles::may_replace(const Named& output, const Named& first) {
  return !first.is_output && first.option == "input" && output.option == "-o";
}

void NamedFiles::refuse(const Named& named, const Named& first) const {
  if (first.is_output)
    refuse_usage(
        named.option, Code::E602,
        fmt::format("'{}' is written by {}, too; name another file", named.path, first.option));
  const bool offers_it = offers_force_ && may_replace(named, first);
  const bool is_lossy = offers_it && !named.loss.empty();
  refuse_usage(named.option, Code::E602,
               fmt::format("'{}' is an input, which would be overwritten{}; name another file{}",
                           named.path, is_lossy ? ": " + named.loss : "",
                           offers_it && !is_lossy ? ", or replace it with --force" : ""));
}

bool NamedFiles::check() const {
  bool replaces_input = false;
  static const Named kStdout{"stdout", "-", true};
  Places places;
  // The same input twice is no harm.
  for (const Named& input : inputs_) places.enter(input, input.path == "-" ? STDIN_FILENO : -1);
  for (const Named& output : outputs_) {
    const bool is_stdout = output.path == "-";
    const Named* first = is_stdout ? places.enter_stdout(output) : places.enter(output);
    if (first == nullptr) continue;
    if (!is_forced_ || !may_replace(output, *first) || !output.loss.empty()) refuse(output, *first);
    replaces_input = true;
  }
  if (const Named* first = places.enter(kStdout, STDOUT_FILENO)) refuse(*first, kStdout);
  return replaces_input;
}

}  // namespace oriel::cli
