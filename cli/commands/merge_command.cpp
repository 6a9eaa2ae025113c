#include "cli/batch/status.h"
#include "cli/commands/commands.h"
#include "cli/output/named_files.h"
#include "cli/streams/shards.h"
#include "cli/streams/stream_lines.h"
#include "cli/terminal/logging.h"
#include "io/cityjson/id_set.h"
#include "io/cityjson/stream_header.h"
#include "io/files/output_file.h"
#include "io/files/partial_files.h"
#include "kernel/base/issue.h"
#include "kernel/base/text/counted.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

namespace fs = std::filesystem;

struct MergeArguments {
  std::vector<std::string> files;
  std::string list;
  std::vector<std::string> through;
  std::string out = "-";
};

std::string name_of(const std::string& file) {
  const std::string name = fs::path(file).filename().string();
  return name.substr(0, name.find('.'));
}

/// What a stage made of what.
struct ProcessingStep {
  std::vector<std::string> inputs;  ///< hashes
  std::uint64_t left_out = 0;       ///< records
};

/// The steps that a status file names, by the hash of their output; none if there is no such file.
/// Throws as read_status.
std::multimap<std::string, ProcessingStep> steps_of(const fs::path& path) {
  std::multimap<std::string, ProcessingStep> steps;
  if (!fs::exists(path)) return steps;
  const RunStatus status = read_status(path.string());
  ProcessingStep step;
  for (const auto& [name, sha256] : status.input_sha256) step.inputs.push_back(sha256);
  step.left_out = status.state.records.refused + status.state.records.not_selected;
  for (const auto& [name, mark] : status.outputs) steps.emplace(mark.sha256, step);
  return steps;
}

/// Nothing if `file`, whose bytes are `mark`, was made of the whole shard: by the hashes in
/// NAME.status.json next to it (the file is its output, its input is the shard) or over several
/// such files in `through`, and as many lines as the shard has but those that a stage refused or
/// did not select. Without a status file: if it has as many lines as the shard. Where nothing is
/// left out, `ids_sha256` is that of the shard. Else an error E118. Throws as read_status.
std::optional<Issue> check_provenance(const Shard& shard, const std::string& file,
                                      const FileMark& mark, const std::string& ids_sha256,
                                      const std::vector<std::string>& through) {
  const std::string status = shard.name + ".status.json";
  const fs::path status_file = fs::path(file).parent_path() / status;
  std::uint64_t expected = shard.features + 1;
  if (fs::exists(status_file) || !through.empty()) {
    std::multimap<std::string, ProcessingStep> steps = steps_of(status_file);
    for (const std::string& folder : through) steps.merge(steps_of(fs::path(folder) / status));
    std::string sha256 = mark.sha256;
    bool has_step = false;
    while (sha256 != shard.sha256) {
      const auto step = steps.find(sha256);
      if (step == steps.end())
        return shard_issue(
            file, !has_step ? fmt::format("is not the output that {} lists", status)
                            : fmt::format("was not made from shard {}: {} has another input",
                                          shard.name, status));
      if (step->second.inputs.size() != 1)
        return shard_issue(file, "was made from several inputs; expected one shard");
      expected -= std::min(expected, step->second.left_out);
      sha256 = step->second.inputs[0];
      has_step = true;
      steps.erase(step);  // a stage may change nothing
    }
  }
  if (mark.lines == shard.features + 1 && ids_sha256 != shard.ids_sha256)
    return shard_issue(
        file, fmt::format("has other features than shard {}, or another order", shard.name));
  if (mark.lines == expected) return std::nullopt;
  return shard_issue(file, fmt::format("has {}; shard {} has {}, of which {} left out",
                                       counted(mark.lines, "line"), shard.name, shard.features + 1,
                                       counted(shard.features + 1 - expected, "was", "were")));
}

void check_names(const MergeArguments& arguments) {
  NamedFiles files;
  for (const std::string& file : arguments.files) files.add_input("shards", file);
  files.add_input("--split", arguments.list);
  files.add_output("-o", arguments.out);
  files.check();
}

/// The files of the list's shards, in its order. Says which are missing, strange or there twice.
class Merger {
 public:
  explicit Merger(const MergeArguments& arguments)
      : arguments_(arguments), list_(ShardList::load(arguments.list)), report_(true) {}

  ExitCode go() {
    find_files();
    if (has_errors_) return ExitCode::input;
    OutputFile out(arguments_.out);
    for (const Shard& shard : list_.shards) try {
        append(shard, file_of_.at(shard.name), out);
      } catch (const InputError& error) {
        tell(error.issue());
      }
    if (has_errors_) return ExitCode::input;
    out.commit();
    run_log().info("merged {} of {}", counted_of(features_, expected_, "feature"),
                   counted(list_.shards.size(), "shard"));
    return ExitCode::clean;
  }

 private:
  void tell(const Issue& issue) {
    report_.add(issue);
    has_errors_ = true;
  }

  void find_files() {
    std::set<std::string> known;
    for (const Shard& shard : list_.shards) known.insert(shard.name);
    for (const std::string& file : arguments_.files) {
      const std::string name = name_of(file);
      if (!known.contains(name))
        tell(shard_issue(file, fmt::format("is not a shard of {}", arguments_.list)));
      else if (const auto [twin, is_new] = file_of_.try_emplace(name, file); !is_new)
        tell(shard_issue(file, fmt::format("is the same shard as {}", twin->second)));
    }
    for (const std::string& name : known)
      if (!file_of_.contains(name))
        tell(shard_issue(arguments_.list, fmt::format("shard {} is missing", name)));
  }

  void append(const Shard& shard, const std::string& path, OutputFile& out) {
    std::ifstream file(path, std::ios::binary);
    if (!file) {
      Issue issue = shard_issue(path, "cannot be read: " + std::generic_category().message(errno));
      issue.code = Code::E101;
      return tell(issue);
    }
    FileMark mark;
    Sha256 hash, ids;
    for (std::string line; std::getline(file, line);) {
      if (file.eof()) return tell(shard_issue(path, "ends within a line"));
      line += '\n';
      hash.add(line);
      if (mark.lines++ > 0 || is_first_) out.append(line);
      if (mark.lines > 1) {
        add_feature(feature_id(line), path, mark.lines, ids);
        continue;
      }
      is_first_ = false;
      if (const auto issue = headers_.check(line, path)) return tell(*issue);
    }
    mark.bytes = hash.bytes();
    mark.sha256 = hash.digest();
    expected_ += shard.features;
    features_ += mark.lines - std::min<std::uint64_t>(mark.lines, 1);
    if (const auto issue = check_provenance(shard, path, mark, ids.digest(), arguments_.through))
      tell(*issue);
  }

  void add_feature(const std::string& id, const std::string& path, std::uint64_t line,
                   Sha256& ids) {
    ids.add(id + '\n');
    if (id.empty() || ids_.insert(id)) return;
    Issue issue = building_issue(Severity::error, Code::E207, id, "an earlier line has this id");
    issue.place.file = path;
    issue.place.line = static_cast<int>(line);
    tell(issue);
  }

  const MergeArguments& arguments_;
  ShardList list_;
  Report report_;
  CommonHeader headers_;
  IdSet ids_;
  std::map<std::string, std::string> file_of_;
  std::uint64_t features_ = 0, expected_ = 0;
  bool is_first_ = true, has_errors_ = false;
};

}  // namespace

void add_merge(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<MergeArguments>();
  CLI::App* command = app.add_subcommand(
      "merge", "Combine the outputs made from the shards of `split`, in their order");
  command
      ->add_option(
          "shards", arguments->files,
          "Outputs made from all shards, in any order, each with its NAME.status.json next to it")
      ->required();
  command->add_option("--split", arguments->list, "The split.json of the shards")->required();
  command
      ->add_option("--through", arguments->through,
                   "Folder with the NAME.status.json files of an earlier stage; may be repeated")
      ->allow_extra_args(false);
  command->add_option("-o,--output", arguments->out, "File, or - for stdout")
      ->capture_default_str();
  command->footer(
      "Hashes, counts and gaps are checked; nothing is written unless everything "
      "matches.\nExample:\n  oriel merge labelled/*.city.jsonl --split shards/split.json -o "
      "city.city.jsonl");
  command->callback([arguments, &action] {
    action = [arguments] {
      check_names(*arguments);
      return Merger(*arguments).go();
    };
  });
}

}  // namespace oriel::cli
