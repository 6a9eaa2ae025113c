#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace oriel::cli {

struct RunOptions;

/// The files that a command line names, by the options that name them, to find one that two outputs
/// would write, or that is read and written.
class NamedFiles {
 public:
  /// A file that is written. Empty: not asked for; "-" is stdout. `loss`: what an input would lose
  /// that it replaces, as a sentence; empty: nothing.
  void add_output(const std::string& option, const std::string& path, const std::string& loss = {});
  /// A file that is read; "-" is stdin.
  void add_input(const std::string& option, const std::string& path);
  /// The inputs of a run, and what it writes about itself: --timings, --status.
  void add(const RunOptions& options);

  /// Throws CLI::ValidationError E602, which names --force where the command has it, if an output
  /// is the same file as another output, an input or what stdout goes to, under whatever name:
  /// links are resolved and regular files compared by their number on the disk. With --force -o may
  /// be an input of the run that loses nothing; true is returned if it is one. What is no regular
  /// file (/dev/null, a pipe) may be named twice.
  bool check() const;

 private:
  struct Named {
    std::string option, path;
    bool is_output = false;
    std::string loss{};
  };
  using FileNumber = std::pair<std::uint64_t, std::uint64_t>;  ///< device, file
  class Places;

  [[noreturn]] void refuse(const Named& named, const Named& first) const;
  [[nodiscard]] static bool may_replace(const Named& output, const Named& first);

  std::vector<Named> inputs_, outputs_;
  bool offers_force_ = false, is_forced_ = false;
};

}  // namespace oriel::cli
