#pragma once

#include "tests/cli/command.h"

#include <string>
#include <vector>

namespace oriel::test {

/// How a command of a page ended.
struct Shown {
  int exit = -1;
  /// stdout and stderr, in the order in which a terminal shows them.
  std::vector<std::string> lines{};
};

/// A folder in which a reader of a page would work: a copy of the sources with the samples, rule
/// packs and test data at their places, `../shared` where it is there, and oriel, oriel-generate
/// and oriel-cuts on the PATH.
class Checkout {
 public:
  Checkout();

  /// Runs commands one after the other in one shell, so that variables and `cd` last. One that the
  /// shell did not come to has the exit code -1.
  [[nodiscard]] std::vector<Shown> run(const std::vector<std::string>& commands) const;
  [[nodiscard]] std::filesystem::path path() const { return folder_.path() / "oriel"; }

 private:
  Folder folder_;
};

/// `text` as one word of a shell.
std::string quoted(const std::string& text);

/// Whether the PATH has a program of this name.
bool has_program(const std::string& name);

}  // namespace oriel::test
