#pragma once

#include "tests/cli/command.h"

#include <map>
#include <string>
#include <vector>

namespace oriel::test {

/// The files of a folder and of those in it: bytes by their path in it.
using Files = std::map<std::string, std::string>;

/// A command that writes. In `words` and `first` an @ is the folder of its files.
struct WritingCommand {
  std::string name;
  std::vector<std::string> words;
  /// What is in the folder, and commands that come before this one.
  Files inputs;
  std::vector<std::vector<std::string>> first{};
  /// Killed or failed, the same command goes on: what it left then is no leftover.
  bool is_resumable = false;
  /// Memory is not refused it: nlohmann-json 3.11 destroys objects that it got no memory for, and
  /// crashes there.
  bool needs_memory = false;
  /// TBB loads a library when it is used first, and the C library's dlopen crashes where there is
  /// no memory at all.
  bool has_threads = false;
};

/// How often a command calls each function that can be made to fail, by name
/// (preload/failing_calls.cpp). Of "malloc" also the calls that were the first from their place in
/// the program.
struct CallCounts {
  std::map<std::string, long> calls;
  std::vector<long> first_calls;
};

/// Runs a command with one call that fails, over and over, and compares with a run in which none
/// did.
class FaultedRuns {
 public:
  explicit FaultedRuns(WritingCommand command);

  [[nodiscard]] const CallCounts& counts() const { return counts_; }
  [[nodiscard]] const Outcome& undisturbed() const { return undisturbed_; }

  /// What is wrong when call `n` of `function` fails as `how` says, empty if nothing is:
  ///
  /// 1. No signal ends the command, and it ends.
  /// 2. Its exit code is that of the undisturbed run only if all its files and its stdout are the
  ///    same; otherwise it says an error.
  /// 3. Each file is what it was before or what the undisturbed run made of it; there are no
  ///    others. Exceptions: what a run says of itself, and whole outputs without the labels of a
  ///    building that a fault cost (E901, in a worker E123), with exit code 3.
  /// 4. A command that is resumable makes the same of it when it is given again.
  ///
  /// With `is_lasting` all later calls fail, too. `reason`: what its message has to say.
  [[nodiscard]] std::string fault_of(const std::string& function, long n, const std::string& how,
                                     bool is_lasting = false, const std::string& reason = "");
  /// The same of a call that is to be repeated: the command may not even notice.
  [[nodiscard]] std::string trace_of(const std::string& function, long n, const std::string& how);

 private:
  void restore() const;
  [[nodiscard]] Outcome run_command(const std::vector<std::string>& words,
                                    const std::string& variable = "") const;
  [[nodiscard]] Outcome run_with(const std::string& fault) const;
  [[nodiscard]] std::string strange_file(const Files& after, const Outcome& outcome) const;

  Folder folder_, notes_;
  WritingCommand command_;
  CallCounts counts_;
  Outcome undisturbed_;
  Files before_, made_;
};

/// Every command that writes files, on small inputs.
std::vector<WritingCommand> writing_commands();

}  // namespace oriel::test

/// Leaves the test with the line "skipped" where the library cannot be loaded before a sanitizer.
#ifdef ORIEL_FAILING_CALLS
#define ORIEL_NEEDS_FAILING_CALLS
#else
#define ORIEL_FAILING_CALLS ""
#define ORIEL_NEEDS_FAILING_CALLS                                 \
  MESSAGE("skipped: no library goes before that of a sanitizer"); \
  return
#endif
