#pragma once

#include "cli/batch/earlier_run.h"
#include "cli/batch/intake.h"
#include "cli/batch/ledger.h"
#include "cli/batch/resume.h"
#include "cli/commands/options.h"
#include "cli/pipeline/line.h"
#include "cli/terminal/exit_code.h"
#include "cli/terminal/progress.h"
#include "cli/terminal/report.h"
#include "kernel/io/document.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace oriel::cli {

/// A command at work on its inputs: reads them record by record, runs their buildings down the
/// line, counts what came of them, and tells what was found. One input or building that fails does
/// not stop the others. With --jobs several records are on the line at the same time; they are
/// visited and told of in the order of the inputs all the same, one at a time.
class Run {
 public:
  /// `rules` may be null: then nothing is interpreted.
  Run(const LineArguments& arguments, const RuleBase* rules, Report& report);

  struct Visitor {
    /// Before the first record of an input.
    std::function<void(std::size_t input)> begin = [](std::size_t) {};
    /// A record was read; `lines` are its buildings on the line, in their order.
    std::function<void(const Document&, std::vector<OnLine>& lines)> record =
        [](const Document&, std::vector<OnLine>&) {};
    /// In place of `record`, in two steps. The first makes of a record of input number `input` what
    /// it adds to the outputs; it touches nothing else and may be called for several at the same
    /// time. The second puts it there, in the order of the records.
    std::function<Product(std::size_t input, const Document&, const std::vector<OnLine>& lines,
                          Timings&)>
        make{};
    std::function<void(const Document&, Product)> take{};
    /// With `make`: the outputs as they are.
    std::function<PartPlaces()> places{};
    /// With `make`: all that a product depends on beside source, configuration and rules.
    std::string recipe{};
    /// All inputs are done: outputs that are not yet in their place come there. Before the status
    /// is written.
    std::function<void()> commit = [] {};
    /// All inputs were done when an earlier run was killed: outputs of all of them together, which
    /// `begin` opens else, are to be opened for `commit`.
    std::function<void()> reopen = [] {};
    /// What was visited needs nothing but its outputs, so that the run can go on behind any record.
    bool is_streaming = false;
    /// Counts that belong to what was visited; kept and restored with the run.
    std::map<std::string, int>* counts = nullptr;
    /// After the last record. Not called for an input that could not be read as a whole.
    std::function<void(std::size_t input)> end = [](std::size_t) {};
  };

  /// All inputs, as often as --repeat says; issues are told the first time, results are for the
  /// last. Returns the gravest thing that happened.
  ExitCode go(const Visitor& visitor);

  /// With --resume: the same command did all this before. Nothing was visited.
  [[nodiscard]] bool was_done() const { return was_done_; }

  /// Other runs are for the clock: what they write goes to nowhere.
  [[nodiscard]] bool is_last_run() const { return run_ >= arguments_.repeat; }

  /// A building was set aside by the command itself.
  void set_aside(const Issue& why);

  /// Of the present run.
  [[nodiscard]] Timings& timings() { return timings_.back(); }
  [[nodiscard]] int buildings() const { return buildings_; }
  [[nodiscard]] int buildings_set_aside() const { return set_aside_; }
  /// Features by label ("" = unknown) of the last run.
  [[nodiscard]] const std::map<std::string, int>& labels() const { return labels_; }

  /// Of the last run, on stderr: with a bar a table with rates, else one line,
  /// "labelled 75 of 76 buildings: 2385 window, 76 door, …; 1 set aside (E302)". `counts`
  /// by label ("" = unknown); `what_of_them` follows the counts.
  void tell_summary(const std::string& verb, const std::map<std::string, int>& counts,
                    const std::string& what_of_them = "") const;

 private:
  void run_inputs(const Visitor& visitor);
  void run_isolated(Intake& intake, const Visitor& visitor);
  [[nodiscard]] OnLine on_line(const Building& building, Timings& timings) const;
  [[nodiscard]] BuildingOutcome outcome_of(OnLine& line) const;
  void work_on(Arrival& arrival, const Visitor& visitor) const;
  void set_all_aside(Arrival& arrival, Code code, const std::string& sentence) const;
  void reuse(Arrival& arrival) const;
  void make_product(Arrival& arrival, const Visitor& visitor) const;
  void settle(Arrival& arrival, const Visitor& visitor);
  void settle_record(Arrival& arrival, const Visitor& visitor);
  void settle_product(Arrival& arrival, const Visitor& visitor);
  [[nodiscard]] bool is_passed_over(const Arrival& arrival) const;
  void drop_unselected(Arrival& arrival) const;
  void settle_refused(const Arrival& arrival);
  void keep_errors(const std::vector<Issue>& issues);
  void close_books();
  void begin_reuse(const std::string& recipe);
  [[nodiscard]] bool begin_books(const Visitor& visitor);
  void note(const Arrival& arrival, const Visitor& visitor);
  [[nodiscard]] nlohmann::ordered_json state(const Visitor& visitor) const;
  void restore(const nlohmann::ordered_json& state, const Visitor& visitor);
  void tell(const std::vector<Issue>& issues);
  void log_stages() const;
  [[nodiscard]] std::string codes_text() const;
  void tell_table(const std::string& verb, const std::map<std::string, int>& counts,
                  const std::string& what_of_them) const;
  void raise(ExitCode code) { code_ = graver(code_, code); }

  const LineArguments& arguments_;
  const RuleBase* rules_;
  Report& report_;
  std::vector<Timings> timings_;  ///< by run
  int run_ = 0;
  ExitCode code_ = ExitCode::clean;
  int buildings_ = 0;
  int set_aside_ = 0;
  int open_ = 0;  ///< buildings that came to the end without a solid
  std::map<std::string, int> labels_;
  std::optional<Progress> progress_;  ///< of the present run
  std::uint64_t bytes_ = 0;           ///< read
  std::optional<Ledger> ledger_;
  std::optional<Resume> resume_;
  std::optional<EarlierRun> earlier_;  ///< with --reuse
  std::optional<RecordNotes> notes_;   ///< for a later one
  int reused_ = 0;                     ///< records
  bool was_done_ = false;
  Records records_;
  std::map<std::string, std::string> input_sha256_;
  std::vector<Issue> errors_;  ///< of the record at hand
};

}  // namespace oriel::cli
