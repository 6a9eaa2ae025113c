#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace oriel::test {

/// How a command ended. `exit` is its exit code, 128 + n if signal n ended it.
struct Outcome {
  int exit = -1;
  std::string out;
  std::string err;

  [[nodiscard]] bool says(const std::string& text) const {
    return err.find(text) != std::string::npos;
  }
};

struct Surroundings {
  /// What the command reads from stdin.
  std::string in{};
  /// The folder that it runs in; empty: that of the tests.
  std::string folder{};
  /// Where its stdout goes, if not into Outcome::out.
  std::string stdout_file{};
  /// stdout is a pipe that nobody reads any more.
  bool has_broken_pipe = false;
  /// The largest file it may write, in bytes; 0: any.
  unsigned file_limit = 0;
  /// The seconds of CPU that it may take, then SIGXCPU ends it; 0: any.
  unsigned cpu_limit_s = 0;
  /// The address space that it may take, in bytes; 0: any.
  std::size_t memory_limit = 0;
  /// NAME=value, added to the environment.
  std::vector<std::string> environment{};
  /// stderr is a terminal.
  bool has_terminal = false;
  /// stdout is a terminal, which holds some 4 kB.
  bool has_terminal_out = false;
  /// It is sent this signal as soon as a file with `watched_name` in its name appears in `watched`.
  int signal = 0;
  std::filesystem::path watched{};
  std::string watched_name = ".tmp-";
  /// Its first forked worker is sent this signal as soon as it is there.
  int worker_signal = 0;
};

/// Runs the built `oriel` as a process and waits for its end.
Outcome run(const std::vector<std::string>& arguments, const Surroundings& around = {});

/// A folder of its own, removed with all that is in it.
class Folder {
 public:
  Folder();
  ~Folder();
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  /// The path of a file in it.
  [[nodiscard]] std::string operator/(const std::string& name) const { return path_ / name; }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }
  /// Writes a file and returns its path.
  std::string write(const std::string& name, const std::string& bytes) const;
  /// The names of what is in it, sorted: also of files that nobody should have left there.
  [[nodiscard]] std::vector<std::string> names() const;

 private:
  std::filesystem::path path_;
};

/// The bytes of a file; empty if there is none.
std::string bytes_of(const std::filesystem::path& path);

/// The path of examples/samples/NAME.stripped.city.json.
std::string sample(const std::string& name);

/// `text` with the first `from` replaced, which must be in it.
std::string replaced(std::string text, const std::string& from, const std::string& to);

/// Without their ends.
std::vector<std::string> lines_of(const std::string& text);

}  // namespace oriel::test
