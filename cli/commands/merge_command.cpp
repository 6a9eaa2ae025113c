#include "cli/commands/commands.h"
#include "cli/streams/common_header.h"
#include "cli/streams/provenance.h"
#include "cli/streams/shards.h"
#include "cli/terminal/logging.h"
#include "cli/terminal/report.h"
#include "kernel/io/files/output_file.h"

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <fstream>
#include <map>
#include <memory>
#include <set>
#include <system_error>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

namespace fs = std::filesystem;

struct Arguments {
  std::vector<std::string> files;
  std::string list;
  std::vector<std::string> through;
  std::string out = "-";
};

std::string name_of(const std::string& file) {
  const std::string name = fs::path(file).filename().string();
  return name.substr(0, name.find('.'));
}

/// The files of the list's shards, in its order. Says which are missing, strange or there twice.
class Merger {
 public:
  explicit Merger(const Arguments& arguments)
      : arguments_(arguments), list_(ShardList::load(arguments.list)), report_(true) {}

  ExitCode go() {
    find_files();
    if (has_errors_) return ExitCode::input;
    OutputFile out(arguments_.out);
    for (const Shard& shard : list_.shards) append(shard, file_of_.at(shard.name), out);
    if (has_errors_) return ExitCode::input;
    out.commit();
    run_log().info("merged {} of {} features of {} shards", features_, expected_,
                   list_.shards.size());
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
        tell(shard_issue(file, fmt::format("is no shard of {}", arguments_.list)));
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
    Sha256 hash;
    for (std::string line; std::getline(file, line);) {
      if (file.eof()) return tell(shard_issue(path, "ends within a line"));
      line += '\n';
      hash.add(line);
      if (mark.lines++ > 0 || is_first_) out.append(line);
      if (mark.lines > 1) continue;
      is_first_ = false;
      if (const auto issue = headers_.check(line, path)) return tell(*issue);
    }
    mark.bytes = hash.bytes();
    mark.sha256 = hash.digest();
    expected_ += shard.features;
    features_ += mark.lines - std::min<std::uint64_t>(mark.lines, 1);
    if (const auto issue = check_provenance(shard, path, mark, arguments_.through)) tell(*issue);
  }

  const Arguments& arguments_;
  ShardList list_;
  Report report_;
  CommonHeader headers_;
  std::map<std::string, std::string> file_of_;
  std::uint64_t features_ = 0, expected_ = 0;
  bool is_first_ = true, has_errors_ = false;
};

}  // namespace

void add_merge(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "merge", "Put what was made of the shards of `split` together, in their order");
  command
      ->add_option(
          "shards", arguments->files,
          "What was made of every shard, in any order, each with its NAME.status.json next to it")
      ->required();
  command->add_option("--split", arguments->list, "The split.json of the shards")->required();
  command
      ->add_option("--through", arguments->through,
                   "Folder with the NAME.status.json of a stage before; may be repeated")
      ->allow_extra_args(false);
  command->add_option("-o,--output", arguments->out, "File, or - for stdout")
      ->capture_default_str();
  command->footer(
      "Hashes, counts and gaps are checked; nothing is written if something does not fit.\n"
      "Example:\n  oriel merge labelled/*.city.jsonl --split shards/split.json -o city.city.jsonl");
  command->callback(
      [arguments, &action] { action = [arguments] { return Merger(*arguments).go(); }; });
}

}  // namespace oriel::cli
