#include "cli/terminal/print_out.h"

#include "kernel/base/printable.h"

#include <cstdio>

namespace oriel::cli {

void print_out(const std::string& text, bool is_for_programs) {
  const std::string& lines = is_for_programs ? text : printable_lines(text);
  std::fwrite(lines.data(), 1, lines.size(), stdout);
}

}  // namespace oriel::cli
