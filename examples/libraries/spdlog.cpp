// spdlog: logs of the libraries, one named logger a room.
// Trap: the default logger writes to stdout, where results belong; sinks and levels are set by the
// program, never by a library.
#include <memory>
#include <sstream>
#include <string>

#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

/// What a library does: it takes the logger of its room and makes no choice about it.
void segment() { spdlog::get("kernel")->info("segmented: regions={} rejected={}", 42, 3); }

int main() {
  // The program chooses: stderr for people, here also a string to look at.
  std::ostringstream text;
  const auto screen = std::make_shared<spdlog::sinks::stderr_sink_st>();
  const auto memory = std::make_shared<spdlog::sinks::ostream_sink_st>(text);
  const auto logger =
      std::make_shared<spdlog::logger>("kernel", spdlog::sinks_init_list{screen, memory});
  logger->set_pattern("%n %l: %v");
  spdlog::register_logger(logger);

  segment();
  logger->set_level(spdlog::level::warn);
  segment();
  return text.str() == "kernel info: segmented: regions=42 rejected=3\n" ? 0 : 1;
}
