#include "cli/terminal/step_progress.h"

#include "cli/terminal/logging.h"
#include "kernel/base/text/printable.h"

#include <cstdio>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::cli {

StepProgress::~StepProgress() {
  if (has_bar_) std::fputs("\r\033[K", stderr);
}

void StepProgress::show(const std::string& what, std::size_t done, std::size_t all) {
  if (style_ == ProgressStyle::none) return;
  const auto now = Clock::now();
  if (what != what_) {
    what_ = what;
    start_ = now;
  }
  const auto every = std::chrono::milliseconds(style_ == ProgressStyle::bar ? 100 : 1000);
  if (now - last_ < every && done < all) return;
  last_ = now;
  const double seconds = std::chrono::duration<double>(now - start_).count();
  const double left =
      done == 0 ? -1 : seconds / static_cast<double>(done) * static_cast<double>(all - done);
  if (style_ == ProgressStyle::json) {
    nlohmann::ordered_json line{{"step", what}, {"done", done}, {"all", all}};
    if (left >= 0) line["seconds_left"] = left;
    return progress_log().write(
        LogLevel::info,
        line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
  }
  has_bar_ = true;
  std::fputs(bar(left, done, all).c_str(), stderr);
  std::fflush(stderr);
}

std::string StepProgress::bar(double seconds_left, std::size_t done, std::size_t all) const {
  std::string text =
      fmt::format("\r\033[K{} {}: {} of {}", bar_text(done, all), printable(what_), done, all);
  if (seconds_left >= 0) text += fmt::format(", {} left", time_text(seconds_left));
  return text;
}

}  // namespace oriel::cli
