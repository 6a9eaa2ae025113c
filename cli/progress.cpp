#include "cli/progress.h"

#include <cstdio>
#include <string>
#include <unistd.h>

#include <fmt/format.h>

namespace oriel::cli {

Progress::Progress(std::size_t inputs) : inputs_(inputs), is_shown_(isatty(STDERR_FILENO) != 0) {}

Progress::~Progress() {
  if (has_written_) std::fputs("\r\033[K", stderr);
}

void Progress::show(std::size_t input, int buildings) {
  const auto now = Clock::now();
  constexpr auto kEvery = std::chrono::milliseconds(100);
  if (!is_shown_ || now - last_ < kEvery) return;
  last_ = now;
  has_written_ = true;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  std::string line = fmt::format("\r\033[K{} buildings, {:.0f}/s", buildings, buildings / seconds);
  if (inputs_ > 1 && input > 0) {
    const auto done = static_cast<double>(input), all = static_cast<double>(inputs_);
    constexpr std::size_t kWidth = 24;
    const auto filled = static_cast<std::size_t>(done / all * kWidth);
    line += fmt::format(" [{}{}] {}/{} files, {:.0f} s left", std::string(filled, '#'),
                        std::string(kWidth - filled, '.'), input, inputs_,
                        seconds / done * (all - done));
  }
  std::fputs(line.c_str(), stderr);
  std::fflush(stderr);
}

}  // namespace oriel::cli
