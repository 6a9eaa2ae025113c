#include <cstdlib>

#define DOCTEST_CONFIG_IMPLEMENT
#include <doctest/doctest.h>

/// What the leak sanitizer passes over: fontconfig keeps what it has read, for Cairo.
extern "C" const char* __lsan_default_suppressions();  // NOLINT: its name is the sanitizer's
const char* __lsan_default_suppressions() { return "leak:libfontconfig\n"; }

int main(int argc, char** argv) {
  // The same cases in every run; a set RC_PARAMS wins, to search further or to repeat a failure.
  ::setenv("RC_PARAMS", "seed=20041 max_success=50", 0);
  return doctest::Context(argc, argv).run();
}
