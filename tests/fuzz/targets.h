#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::fuzz {

/// What takes bytes that may be anything and hands them to a part of oriel. Whatever they are, it
/// comes to its end: what is wrong with them is an issue or an InputError, which the target takes.
/// Everything else is a fault of oriel's own: other exceptions, and BrokenPromise. Results depend
/// on the bytes only.
struct Target {
  /// Of the file that defines it and of its folder under corpus/ and regressions/.
  std::string_view name;
  void (*run)(std::string_view bytes);
};

/// All of them, by name. The table is made by CMake: a target is a file in readers/ or geometry/
/// called NAME.cpp that defines `void NAME(std::string_view)` in this namespace.
const std::vector<Target>& targets();

/// Something that holds for every input did not hold for this one.
class BrokenPromise : public std::logic_error {
 public:
  using std::logic_error::logic_error;
};

/// Throws BrokenPromise, with the promise and what is known of its breach, unless it is kept.
inline void promise(bool is_kept, const char* promise, const std::string& but = {}) {
  if (!is_kept) throw BrokenPromise(but.empty() ? promise : std::string(promise) + ": " + but);
}

}  // namespace oriel::fuzz
