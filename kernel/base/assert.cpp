#include "kernel/base/assert.h"

#include <cstdio>
#include <cstdlib>

namespace oriel {

void assertion_failed(const char* file, int line, const char* condition, const char* sentence) {
  std::fprintf(stderr, "%s:%d: assertion failed: %s", file, line, condition);
  if (sentence != nullptr) std::fprintf(stderr, " (%s)", sentence);
  std::fputc('\n', stderr);
  std::abort();
}

}  // namespace oriel
