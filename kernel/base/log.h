#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <fmt/format.h>

namespace spdlog {
class logger;
}  // namespace spdlog

namespace oriel {

enum class LogLevel { trace, debug, info, warning, error, off };

/// One named logger of spdlog. Text that nobody reads is not formatted.
class Log {
 public:
  explicit Log(std::shared_ptr<spdlog::logger> logger) : logger_(std::move(logger)) {}

  [[nodiscard]] bool is_on(LogLevel level) const;
  /// One line without its line end.
  void write(LogLevel level, std::string_view text) const;

  template <class... Values>
  void debug(fmt::format_string<Values...> format, Values&&... values) const {
    if (is_on(LogLevel::debug))
      write(LogLevel::debug, fmt::format(format, std::forward<Values>(values)...));
  }
  template <class... Values>
  void info(fmt::format_string<Values...> format, Values&&... values) const {
    if (is_on(LogLevel::info))
      write(LogLevel::info, fmt::format(format, std::forward<Values>(values)...));
  }

 private:
  std::shared_ptr<spdlog::logger> logger_;
};

/// The logger of a room: "kernel", "interpret", "generalise", "oriel". It is the one that the
/// program has registered with spdlog under this name; else a new one without sinks and with level
/// off, so that the library is quiet by default. The library itself never sets levels or sinks.
/// Lines have the form `segmented: building=b1 features=42 ms=118`: debug is one line for each
/// stage of a building, info one for each stage of a run; no line in an inner loop. May be called
/// by several threads.
Log log(const std::string& name);

}  // namespace oriel
