#include "kernel/base/log.h"

#include <mutex>

#include <spdlog/spdlog.h>

namespace oriel {

namespace {

spdlog::level::level_enum level_of(LogLevel level) {
  switch (level) {
    case LogLevel::trace:
      return spdlog::level::trace;
    case LogLevel::debug:
      return spdlog::level::debug;
    case LogLevel::info:
      return spdlog::level::info;
    case LogLevel::warning:
      return spdlog::level::warn;
    case LogLevel::error:
      return spdlog::level::err;
    case LogLevel::off:
      return spdlog::level::off;
  }
  return spdlog::level::off;
}

}  // namespace

bool Log::is_on(LogLevel level) const { return logger_->should_log(level_of(level)); }

void Log::write(LogLevel level, std::string_view text) const {
  logger_->log(level_of(level), spdlog::string_view_t(text.data(), text.size()));
}

Log log(const std::string& name) {
  static std::mutex registering;
  const std::scoped_lock lock(registering);
  auto logger = spdlog::get(name);
  if (!logger) {
    logger = std::make_shared<spdlog::logger>(name);
    logger->set_level(spdlog::level::off);
    spdlog::register_logger(logger);
  }
  return Log(std::move(logger));
}

}  // namespace oriel
