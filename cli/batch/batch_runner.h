#pragma once

#include "cli/batch/batch_command.h"
#include "cli/batch/record_worker.h"
#include "cli/batch/result_cache.h"
#include "cli/batch/resume.h"
#include "cli/batch/run_options.h"
#include "cli/batch/status.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/logging.h"
#include "cli/terminal/progress.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oriel::cli {

/// A command at work on its inputs: reads them record by record, runs their buildings down the
/// pipeline, counts what came of them, and reports what was found. One input or building that fails
/// does not stop the others. With --jobs several records are worked on at the same time; they are
/// given to the command and reported in the order of the inputs all the same, one at a time.
class BatchRunner {
 public:
  /// `rules` may be null: then nothing is interpreted.
  BatchRunner(const RunOptions& options, const RuleBase* rules, Report& report)
      : options_(options), rules_(rules), report_(report) {}

  /// All inputs, as often as --repeat says; issues are reported the first time, results are for the
  /// last. Returns the gravest thing that happened.
  ExitCode run(VisitingCommand& command);
  ExitCode run(ProducingCommand& command);

  /// The same command did all this before (--resume). The command was given nothing.
  [[nodiscard]] bool was_done() const { return was_done_; }

  /// Other runs are for the clock: what they write goes to nowhere.
  [[nodiscard]] bool is_last_run() const { return run_ >= options_.repeat; }

  /// A building was set aside by the command itself.
  void set_aside(const Issue& why);
  /// A warning of the command itself.
  void warn(const Issue& issue) { report({issue}); }

  /// Of the present run.
  [[nodiscard]] Timings& timings() { return timings_.back(); }
  /// Of the last run.
  [[nodiscard]] const RunState& state() const { return state_; }

  /// Of the last run, on stderr: with a bar a table with rates, else one line,
  /// "labelled 75 of 76 buildings: 2385 window, 76 door, …; 1 set aside (E302)". `counts`
  /// by label ("" = unknown); `suffix` follows the counts.
  void report_summary(const std::string& verb, const std::map<std::string, int>& counts,
                      const std::string& suffix = "") const;

 private:
  ExitCode run_all();
  [[nodiscard]] bool begin_status();
  [[nodiscard]] bool begin_journal();
  [[nodiscard]] std::string recipe_sha256() const;
  void run_inputs();
  void run_in_threads(InputReader& reader);
  void run_isolated(InputReader& reader);
  [[nodiscard]] std::unique_ptr<WorkItem> next(InputReader& reader) const;
  void reuse(WorkItem& item) const;
  [[nodiscard]] RecordWorker worker() const { return {options_, rules_, producer_}; }

  void settle(WorkItem& item);
  void settle(WorkItem& item, const Record& record);
  void settle(const InputEnd& end);
  void settle(const InputFailure& failure);
  [[nodiscard]] bool loses_records(const InputEnd& end);
  void settle_read(WorkItem& item, const Record& record);
  void settle_refused(const Record& record);
  void note_found_ids(const Checked<Document>& document);
  void report_emptiness();
  void report_featureless();
  [[nodiscard]] int partly_featureless() const;
  void settle_product(WorkItem& item, const Document& document);
  void report(const std::vector<Issue>& issues);
  void keep_errors(const std::vector<Issue>& issues);

  void note(const InputPosition& position);
  void restore(const nlohmann::ordered_json& journal);
  void write_status();
  void log_stages() const;
  [[nodiscard]] ProgressCounts progress_counts() const;
  [[nodiscard]] std::string summary_table(const std::string& verb,
                                          const std::map<std::string, int>& counts,
                                          const std::string& suffix) const;

  const RunOptions& options_;
  const RuleBase* rules_;
  Report& report_;
  BatchCommand* command_ = nullptr;
  VisitingCommand* visitor_ = nullptr;    ///< the command, or null
  ProducingCommand* producer_ = nullptr;  ///< the command, or null
  std::vector<Timings> timings_;          ///< by run
  int run_ = 0;
  RunState state_;                    ///< of the present run; of a resumed one with all before
  std::optional<Progress> progress_;  ///< of the present run
  std::uint64_t bytes_ = 0;           ///< read
  std::optional<StatusWriter> status_;
  std::map<std::string, std::string> input_sha256_;  ///< for it
  std::vector<Issue> errors_;                        ///< for it, of the record at hand
  std::optional<Resume> resume_;
  bool was_done_ = false;
  std::optional<ResultCache> cache_;
  int reused_ = 0;  ///< records from it
  bool replaces_input_ = false;
  std::size_t refused_of_input_ = 0;   ///< records, of the input at hand
  std::vector<std::string> seen_ids_;  ///< the first ones, if --id asks for some
};

}  // namespace oriel::cli
