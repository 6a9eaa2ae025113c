#include "cli/terminal/print_out.h"

#include "kernel/base/text/printable.h"

#include <cerrno>
#include <cstdio>
#include <unistd.h>

namespace oriel::cli {

namespace {

int first_failure = 0;

}  // namespace

void print_out(const std::string& text, bool is_for_programs) {
  const bool is_exact = is_for_programs && ::isatty(STDOUT_FILENO) == 0;
  const std::string& lines = is_exact ? text : printable_lines(text);
  errno = 0;
  if (std::fwrite(lines.data(), 1, lines.size(), stdout) != lines.size() && first_failure == 0)
    first_failure = errno;
}

int print_failure() { return first_failure; }

}  // namespace oriel::cli
