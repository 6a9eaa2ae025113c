#include "kernel/base/log.h"

#include <memory>
#include <sstream>
#include <string>

#include <doctest/doctest.h>
#include <spdlog/sinks/ostream_sink.h>
#include <spdlog/spdlog.h>

namespace oriel {
namespace {

TEST_SUITE("kernel/base") {
  TEST_CASE("a logger of the library is quiet by default") {
    const Log quiet = log("nobody listens");
    CHECK_FALSE(quiet.is_on(LogLevel::error));
    quiet.debug("never formatted: {}", 1);
    quiet.write(LogLevel::error, "goes nowhere");
    CHECK(spdlog::get("nobody listens")->sinks().empty());
  }

  TEST_CASE("a logger that the program registers gets the lines of the library at its level") {
    std::ostringstream text;
    const auto sink = std::make_shared<spdlog::sinks::ostream_sink_st>(text);
    const auto logger = std::make_shared<spdlog::logger>("somebody listens", sink);
    logger->set_pattern("%n %l: %v");
    logger->set_level(spdlog::level::info);
    spdlog::register_logger(logger);
    log("somebody listens").debug("too fine: {}", 1);
    log("somebody listens").info("segmented: features={} ms={}", 42, 118);
    CHECK(text.str() == "somebody listens info: segmented: features=42 ms=118\n");
  }
}

}  // namespace
}  // namespace oriel
