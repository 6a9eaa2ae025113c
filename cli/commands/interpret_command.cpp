#include "cli/batch/arena.h"
#include "cli/batch/inputs/input_files.h"
#include "cli/commands/commands.h"
#include "cli/options/options.h"
#include "cli/output/column_choice.h"
#include "cli/output/named_files.h"
#include "cli/output/safe_cells.h"
#include "cli/terminal/logging.h"
#include "cli/terminal/print_out.h"
#include "cli/terminal/table.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/printable.h"
#include "oriel/interpret.h"

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <iterator>
#include <map>
#include <memory>
#include <oneapi/tbb/parallel_for.h>
#include <span>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

struct InterpretArguments : RulesChoice {
  std::vector<std::string> records;
  std::string out;
  std::vector<std::string> columns;
  bool has_safe_cells = false;
  std::size_t examples = 3;
  int jobs = 1;
  bool is_watching = false;
  bool is_verbose = false;
};

/// Short against the time that a reader takes to look up, long against that of a look at a file.
constexpr std::chrono::milliseconds kBetweenLooks{50};

/// Waits until somebody saves one of the files it follows. Goes by time and size of the file, a few
/// times a second: that works for every editor and file system.
class FileWatch {
 public:
  /// Files that are not followed yet are, as they are now. Names of packs that are built in are no
  /// files and never change.
  void follow(const std::vector<std::string>& files);

  /// Returns when a file has changed and is at rest. A file that is gone is waited for: editors
  /// replace files.
  void wait();

 private:
  struct Stamp {
    std::filesystem::file_time_type time;
    std::uintmax_t size = 0;
    bool is_there = false;
    friend bool operator==(const Stamp&, const Stamp&) = default;
  };
  static Stamp stamp_of(const std::string& file);
  bool take_changes();

  std::map<std::string, Stamp> stamps_;
};

FileWatch::Stamp FileWatch::stamp_of(const std::string& file) {
  Stamp stamp;
  std::error_code problem;
  stamp.time = std::filesystem::last_write_time(file, problem);
  if (!problem) stamp.size = std::filesystem::file_size(file, problem);
  stamp.is_there = !problem;
  return stamp.is_there ? stamp : Stamp();
}

void FileWatch::follow(const std::vector<std::string>& files) {
  for (const std::string& file : files) stamps_.try_emplace(file, stamp_of(file));
}

bool FileWatch::take_changes() {
  bool has_changed = false;
  for (auto& [file, stamp] : stamps_) {
    const Stamp now = stamp_of(file);
    if (!now.is_there || now == stamp) continue;
    stamp = now;
    has_changed = true;
  }
  return has_changed;
}

void FileWatch::wait() {
  while (!take_changes()) std::this_thread::sleep_for(kBetweenLooks);
  do std::this_thread::sleep_for(kBetweenLooks);
  while (take_changes());
}

/// What files of records have, in memory, to be interpreted as often as the rules change.
class StoredFeatures {
 public:
  /// Reads the files; reports what is wrong with them. Throws InputError as read_feature_tables
  /// does.
  StoredFeatures(std::vector<std::string> files, Report& report)
      : files_(std::move(files)), report_(report) {
    for (const std::string& file : files_) {
      RecordColumns columns;
      auto tables = read_feature_tables(file, &columns);
      report_.add(tables.issues);
      if (has_errors(tables.issues))
        code_ = graver(code_, tables.value ? ExitCode::set_aside : ExitCode::input);
      columns_.push_back(std::move(columns));
      if (!tables.value) continue;
      common_ = common_columns(common_, columns_.back());
      buildings_.insert(buildings_.end(), std::make_move_iterator(tables.value->begin()),
                        std::make_move_iterator(tables.value->end()));
    }
  }

  /// What reading them came to.
  [[nodiscard]] ExitCode code() const { return code_; }
  [[nodiscard]] const std::vector<DescribedBuilding>& buildings() const { return buildings_; }

  /// A warning E151 for each file that lacks columns which the rules read.
  [[nodiscard]] std::vector<Issue> lacking_columns(const RuleBase& rules) const {
    std::vector<Issue> issues;
    for (std::size_t i = 0; i < columns_.size(); ++i)
      if (auto lacking = lacks_columns(files_[i], columns_[i], rules))
        issues.push_back(std::move(*lacking));
    return issues;
  }

  /// What can be written: the columns that all files have, the labels, and the names if they can be
  /// made.
  [[nodiscard]] RecordColumns writable_columns(const RuleBase& rules) const {
    if (common_.empty()) return {};
    RecordColumns columns = common_;
    const RecordColumns labels = chosen_columns({"labels"}, rules);
    for (std::size_t field = 0; field < columns.size(); ++field)
      columns[field] = columns[field] || labels[field];
    const auto name = static_cast<std::size_t>(std::ranges::find(record_fields(), "name") -
                                               record_fields().begin());
    columns[name] = columns[name] && has_columns_of_names(common_);
    return columns;
  }

  /// One for each building. Up to `jobs` shares are interpreted at the same time; what comes of it
  /// does not depend on that.
  [[nodiscard]] std::vector<Interpretation> interpreted(const RuleBase& rules, int jobs) const {
    constexpr std::size_t kShare = 64;
    const std::span<const DescribedBuilding> all(buildings_);
    std::vector<Interpretation> run(all.size());
    const auto interpret_share = [&](std::size_t number) {
      const std::size_t begin = number * kShare;
      const auto share = all.subspan(begin, std::min(kShare, all.size() - begin));
      std::ranges::move(interpret(rules, share), run.begin() + static_cast<long>(begin));
    };
    const std::size_t shares = (all.size() + kShare - 1) / kShare;
    if (jobs > 1)
      in_arena(jobs, [&] { tbb::parallel_for(std::size_t{0}, shares, interpret_share); });
    else
      for (std::size_t number = 0; number < shares; ++number) interpret_share(number);
    for (const Interpretation& interpretation : run) report_.add(interpretation.issues);
    return run;
  }

  /// Writes the records as they were read with the verdicts of `run`.
  void write(const std::string& path, bool has_safe_cells, const std::vector<Interpretation>& run,
             const RecordColumns& columns) {
    const RecordFormat format = *record_format_of(path);
    FeatureRecordWriter writer(path, columns);
    RecordLabeller labeller(buildings_, run);
    for (const std::string& file : files_) {
      // Of one building: labels of others are parts of a feature's name.
      std::vector<FeatureRecord> records;
      const auto write_building = [&] {
        if (has_columns_of_names(common_)) set_names(records);
        const std::string text = FeatureRecordWriter::text(format, records, columns);
        const bool is_safe = has_safe_cells && format == RecordFormat::csv;
        writer.append(is_safe ? with_safe_cells(text) : text);
        records.clear();
      };
      const auto issues = visit_feature_records(file, [&](FeatureRecord record) {
        if (!labeller.label(record)) return;
        if (!records.empty() && records.back().building != record.building) write_building();
        records.push_back(std::move(record));
      });
      write_building();
      // Boxes and polygons, without which the tables could be read, are not reported yet.
      if (has_errors(issues) && code_ == ExitCode::clean) {
        report_.add(issues);
        code_ = ExitCode::set_aside;
      }
    }
    writer.commit();
  }

 private:
  std::vector<std::string> files_;
  Report& report_;
  ExitCode code_ = ExitCode::clean;
  std::vector<DescribedBuilding> buildings_;
  /// File by file, and those that all have.
  std::vector<RecordColumns> columns_;
  RecordColumns common_;
};

/// A table of how many features each label and rule has.
std::string listing(const std::vector<Interpretation>& run) {
  std::map<std::pair<std::string, std::string>, std::size_t> counts;
  for (const Interpretation& interpretation : run)
    for (const Verdict& verdict : interpretation.verdicts) ++counts[{verdict.label, verdict.rule}];
  std::vector<std::vector<std::string>> rows{{"label", "rule", "features"}};
  for (const auto& [naming, count] : counts)
    rows.push_back({naming.first.empty() ? "unknown" : naming.first,
                    naming.second.empty() ? "-" : naming.second, fmt::format("{}", count)});
  return table(rows);
}

void print_now(const std::string& text) {
  print_out(text);
  std::fflush(stdout);
}

/// Interprets again whenever the pack, or one that it extends, is saved; ends by a signal only. A
/// pack with errors, or without a param that is set, changes nothing: what comes next is compared
/// with the last labels.
[[noreturn]] void watch(const InterpretArguments& arguments, const StoredFeatures& features,
                        Report& report) {
  FileWatch files;
  files.follow({arguments.rules});
  std::vector<Interpretation> last;
  bool is_first = true;
  while (true) {
    const auto start = std::chrono::steady_clock::now();
    const auto pack = load_pack(arguments.rules, report);
    if (pack) files.follow(pack->files());
    if (const auto rules = pack ? with_params(*pack, arguments.params, report) : std::nullopt) {
      report.add(features.lacking_columns(*rules));
      auto run = features.interpreted(*rules, arguments.jobs);
      print_now(is_first
                    ? listing(run)
                    : to_text(diff_labels(features.buildings(), last, run, arguments.examples)));
      last = std::move(run);
      is_first = false;
    }
    const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
    run_log().info("{} in {:.2f} s; waiting for {} to be saved",
                   counted(features.buildings().size(), "building"), took.count(),
                   printable(arguments.rules));
    files.wait();
  }
}

/// Those that are asked for; a column that is named and that the records lack is wrong usage.
RecordColumns columns_to_write(const InterpretArguments& arguments, const StoredFeatures& features,
                               const RuleBase& rules) {
  const RecordColumns writable = features.writable_columns(rules);
  for (const std::string& word : arguments.columns)
    for (std::size_t field = 0; field < record_fields().size(); ++field)
      if (record_fields()[field] == word && !has_column(writable, field))
        throw CLI::ValidationError(
            "--columns",
            fmt::format("the records have no column '{}', or not what it takes", word));
  return common_columns(writable, chosen_columns(arguments.columns, rules));
}

ExitCode work(InterpretArguments& arguments) {
  if (!arguments.columns.empty() && arguments.out.empty())
    throw CLI::ValidationError("--columns", "needs -o, the table that has them");
  if (arguments.is_watching && !arguments.out.empty())
    throw CLI::ValidationError("--watch", "writes no file: leave out -o");
  Report report(arguments.is_verbose);
  read_once(arguments.records, report);
  NamedFiles names;
  for (const std::string& records : arguments.records) names.add_input("records", records);
  names.add_input("--rules", arguments.rules);
  names.add_output("-o", arguments.out);
  names.check();
  if (arguments.is_watching) {
    const StoredFeatures features(arguments.records, report);
    if (features.code() == ExitCode::input) return ExitCode::input;
    watch(arguments, features, report);
  }
  const auto rules = load_rules(arguments, report);
  if (!rules) return ExitCode::rules;
  StoredFeatures features(arguments.records, report);
  const auto lacking = features.lacking_columns(*rules);
  report.add(lacking);
  const auto run = features.interpreted(*rules, arguments.jobs);
  if (arguments.out.empty())
    print_now(listing(run));
  else if (!features.buildings().empty() || features.code() != ExitCode::input)
    features.write(arguments.out, arguments.has_safe_cells, run,
                   columns_to_write(arguments, features, *rules));
  const ExitCode code =
      graver(features.code(), lacking.empty() ? ExitCode::clean : ExitCode::set_aside);
  if (!features.buildings().empty() || features.code() == ExitCode::input) return code;
  report.add(nothing_to_work_on(arguments.records, "no feature"));
  return graver(features.code(), ExitCode::set_aside);
}

}  // namespace

void add_interpret(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<InterpretArguments>();
  CLI::App* command = app.add_subcommand(
      "interpret", "Label stored features by rules, without their buildings, to try rules out");
  command
      ->add_option("records", arguments->records,
                   "Records of features, as segment or label --features writes them")
      ->required();
  add_rules_arguments(*command, *arguments);
  add_records_output(*command, "-o,--output", arguments->out,
                     "Write the records with their new labels: .csv, .json or .jsonl");
  add_columns_argument(*command, arguments->columns);
  add_safe_cells_argument(*command, arguments->has_safe_cells);
  command->add_flag("--watch", arguments->is_watching,
                    "Run again whenever the pack is saved, and report what changed");
  command
      ->add_option("--examples", arguments->examples,
                   "With --watch: how many features of each change to list")
      ->capture_default_str();
  add_jobs_argument(*command, arguments->jobs);
  command->add_flag("-v,--verbose", arguments->is_verbose, "Also show notes");
  command->footer(
      "Without -o, it lists how many features each label and rule has.\nExample:\n  oriel segment "
      "city/*.city.json --features parts.csv\n  oriel interpret parts.csv --rules my_rules.yaml "
      "--watch");
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
