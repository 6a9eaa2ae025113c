#include "tests/faults/commands/faulted_run.h"

#include <cstdlib>
#include <cstring>
#include <utility>

#include <doctest/doctest.h>

using namespace oriel::test;

namespace {

/// A call that fails once, with the words that the command has to find for it; "" where it may do
/// without what it asked for.
struct Failure {
  const char* function;
  const char* how;
  bool is_lasting = false;
};

constexpr Failure kFailures[] = {
    {"write", "ENOSPC"},  {"write", "ENOSPC", true}, {"write", "EIO"}, {"fsync", "EIO"},
    {"rename", "EACCES"}, {"open", "EMFILE"},        {"close", "EIO"}, {"read", "EIO"},
    {"mkdir", "EACCES"},  {"fork", "EAGAIN"},
};

constexpr std::pair<const char*, const char*> kRepeated[] = {
    {"write", "short"}, {"write", "EINTR"}, {"read", "short"},
    {"read", "EINTR"},  {"poll", "EINTR"},  {"wait", "EINTR"},
};

/// Every so many-th call of a function fails, of each command others; with ORIEL_SLOW all do.
constexpr long kCallStep = 8;

long call_step() { return std::getenv("ORIEL_SLOW") != nullptr ? 1 : kCallStep; }

}  // namespace

TEST_SUITE("faults/commands") {
  TEST_CASE("a call that fails takes no output in silence whichever it is") {
    ORIEL_NEEDS_FAILING_CALLS;
    int runs = 0;
    long first = 0;
    for (const WritingCommand& command : writing_commands()) {
      FaultedRuns faulted(command);
      const auto& calls = faulted.counts().calls;
      CHECK_MESSAGE(faulted.undisturbed().exit == 0, faulted.undisturbed().err);
      CHECK(calls.at("rename") > 0);
      for (const auto& [function, how, is_lasting] : kFailures)
        for (long n = 1 + first++ % call_step(); n <= calls.at(function);
             n += call_step(), ++runs) {
          const std::string fault = faulted.fault_of(function, n, how, is_lasting);
          CHECK_MESSAGE(fault.empty(), fault);
        }
    }
    MESSAGE(runs, " runs");
  }

  TEST_CASE("a call that was interrupted or did half of its work is repeated") {
    ORIEL_NEEDS_FAILING_CALLS;
    int runs = 0;
    long first = 0;
    for (const WritingCommand& command : writing_commands()) {
      FaultedRuns faulted(command);
      for (const auto& [function, how] : kRepeated)
        for (long n = 1 + first++ % call_step(); n <= faulted.counts().calls.at(function);
             n += call_step(), ++runs) {
          const std::string trace = faulted.trace_of(function, n, how);
          CHECK_MESSAGE(trace.empty(), trace);
        }
    }
    MESSAGE(runs, " runs");
  }
}
