#include "tests/faults/commands/faulted_run.h"

#include <cstdlib>

#include <doctest/doctest.h>

using namespace oriel::test;

namespace {

/// Every so many-th place that asks for memory is refused it, of each command others; with
/// ORIEL_SLOW all are.
constexpr std::size_t kMemoryStep = 256;

}  // namespace

TEST_SUITE("faults/commands") {
  TEST_CASE("memory that is refused once or for good ends a command with a word") {
    ORIEL_NEEDS_FAILING_CALLS;
    const std::size_t step = std::getenv("ORIEL_SLOW") != nullptr ? 1 : kMemoryStep;
    std::size_t first = 0;
    int runs = 0;
    for (const WritingCommand& command : writing_commands()) {
      if (command.needs_memory) continue;
      const auto refused_for_good = [&](FaultedRuns& faulted, long call) {
        return command.has_threads ? "" : faulted.fault_of("malloc", call, "ENOMEM", true);
      };
      FaultedRuns faulted(command);
      const std::vector<long>& calls = faulted.counts().first_calls;
      for (std::size_t i = first++ % step; i < calls.size(); i += step, runs += 2) {
        const std::string once = faulted.fault_of("malloc", calls[i], "ENOMEM"),
                          for_good = refused_for_good(faulted, calls[i]);
        CHECK_MESSAGE(once.empty(), once);
        CHECK_MESSAGE(for_good.empty(), for_good);
      }
    }
    MESSAGE(runs, " runs");
  }
}
