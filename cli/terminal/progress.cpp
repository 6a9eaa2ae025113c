#include "cli/terminal/progress.h"

#include "cli/terminal/logging.h"
#include "kernel/base/text/counted.h"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <sys/stat.h>
#include <unistd.h>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

namespace fs = std::filesystem;

/// The bytes of all inputs; 0 if that is not known before they are read.
std::uint64_t size_of(const std::vector<std::string>& inputs) {
  std::uint64_t bytes = 0;
  for (const std::string& input : inputs) {
    std::error_code error;
    const bool is_known = input != "-" && fs::is_regular_file(input, error);
    const std::uintmax_t size = is_known ? fs::file_size(input, error) : 0;
    if (!is_known || error) return 0;
    bytes += size;
  }
  return bytes;
}

/// stdout is a pipe: the command after it may have a bar of its own.
bool is_piped_on() {
  struct stat found {};
  return ::fstat(STDOUT_FILENO, &found) == 0 && S_ISFIFO(found.st_mode);
}

}  // namespace

std::string bar_text(std::uint64_t done, std::uint64_t all) {
  constexpr std::size_t kWidth = 24;
  const std::size_t filled = all == 0 ? kWidth : done * kWidth / all;
  return fmt::format("[{}{}]", std::string(filled, '#'), std::string(kWidth - filled, '.'));
}

std::string time_text(double seconds) {
  const auto whole = static_cast<long>(seconds);
  if (whole < 60) return fmt::format("{} s", whole);
  if (whole < 3600) return fmt::format("{}:{:02} min", whole / 60, whole % 60);
  return fmt::format("{}:{:02} h", whole / 3600, whole / 60 % 60);
}

ProgressStyle progress_style_of(const std::string& name) {
  if (!progress_log().is_on(LogLevel::info)) return ProgressStyle::none;
  if (name == "json") return ProgressStyle::json;
  if (logs_json()) return ProgressStyle::none;
  const bool is_bar =
      name == "bar" || (name.empty() && isatty(STDERR_FILENO) != 0 && !is_piped_on());
  return is_bar ? ProgressStyle::bar : ProgressStyle::none;
}

Progress::Progress(ProgressStyle style, const std::vector<std::string>& inputs, int before)
    : style_(style),
      before_(before),
      all_bytes_(style == ProgressStyle::none ? 0 : size_of(inputs)) {
  counts_.buildings = before;
}

Progress::~Progress() { wipe(); }

void Progress::wipe() {
  if (has_bar_) std::fputs("\r\033[K", stderr);
  has_bar_ = false;
}

double Progress::seconds() const {
  return std::chrono::duration<double>(end_.value_or(Clock::now()) - start_).count();
}

double Progress::buildings_per_s() const { return (counts_.buildings - before_) / seconds(); }

double Progress::mb_per_s() const { return static_cast<double>(counts_.bytes) / 1e6 / seconds(); }

std::optional<double> Progress::seconds_left() const {
  if (all_bytes_ == 0 || counts_.bytes == 0) return std::nullopt;
  const auto done = static_cast<double>(std::min(counts_.bytes, all_bytes_));
  return seconds() / done * (static_cast<double>(all_bytes_) - done);
}

std::string Progress::bar() const {
  std::string text = "\r\033[K";
  const auto left = seconds_left();
  if (left) {
    const std::uint64_t done = std::min(counts_.bytes, all_bytes_);
    text += fmt::format("{} {} %, ", bar_text(done, all_bytes_), done * 100 / all_bytes_);
  }
  text +=
      fmt::format("{}, {} rejected, {:.0f}/s, {:.1f} MB/s", counted(counts_.buildings, "building"),
                  counts_.set_aside, buildings_per_s(), mb_per_s());
  if (left) text += ", " + time_text(*left) + " left";
  return text;
}

std::string Progress::json() const {
  std::string text = fmt::format(
      "{{\"buildings\":{},\"set_aside\":{},\"bytes\":{},\"seconds\":{:.3f},\"buildings_per_s\":"
      "{:.1f},\"mb_per_s\":{:.2f}",
      counts_.buildings, counts_.set_aside, counts_.bytes, seconds(), buildings_per_s(),
      mb_per_s());
  if (all_bytes_ > 0) text += fmt::format(",\"all_bytes\":{}", all_bytes_);
  if (const auto left = seconds_left()) text += fmt::format(",\"seconds_left\":{:.1f}", *left);
  text += fmt::format(",\"is_done\":{}}}", end_.has_value());
  return text;
}

void Progress::show(const ProgressCounts& counts) {
  counts_ = counts;
  if (style_ == ProgressStyle::none) return;
  const auto now = Clock::now();
  const auto every = std::chrono::milliseconds(style_ == ProgressStyle::bar ? 100 : 1000);
  if (now - last_ < every) return;
  last_ = now;
  if (style_ == ProgressStyle::json) return progress_log().write(LogLevel::info, json());
  has_bar_ = true;
  std::fputs(bar().c_str(), stderr);
  std::fflush(stderr);
}

void Progress::finish(const ProgressCounts& counts) {
  counts_ = counts;
  end_ = Clock::now();
  wipe();
  if (style_ == ProgressStyle::json) progress_log().write(LogLevel::info, json());
}

}  // namespace oriel::cli
