#pragma once

/// Preconditions. ORIEL_ASSERT(condition) and ORIEL_ASSERT(condition, "sentence") state what a
/// caller must see to. With ORIEL_ASSERTIONS (the default of debug and sanitizer builds) a
/// condition that does not hold is printed with its place and the process aborts; otherwise the
/// condition is compiled but never evaluated. Faults of the user's data are no case for it: they
/// are issues.
namespace oriel {

/// Prints `file:line: assertion failed: condition (sentence)` and aborts.
[[noreturn]] void assertion_failed(const char* file, int line, const char* condition,
                                   const char* sentence = nullptr);

}  // namespace oriel

#ifdef ORIEL_ASSERTIONS
#define ORIEL_ASSERT(condition, ...) \
  (static_cast<bool>(condition)      \
       ? static_cast<void>(0)        \
       : ::oriel::assertion_failed(__FILE__, __LINE__, #condition __VA_OPT__(, ) __VA_ARGS__))
#else
#define ORIEL_ASSERT(condition, ...) static_cast<void>(sizeof(static_cast<bool>(condition)))
#endif
