#include "kernel/base/switch.h"

#include <array>
#include <atomic>
#include <cstdlib>
#include <fcntl.h>
#include <string>
#include <unistd.h>

#include <climits>

namespace oriel_mutants {

namespace {

constexpr int kUnread = INT_MIN;
constexpr int kNoting = -1;
constexpr int kMostNumbers = 10000;

/// Open before the process has threads; the lines of all processes end up in one file.
int notes = -1;
std::array<std::atomic<bool>, kMostNumbers> is_noted;

void note(const std::string& line) {
  if (notes >= 0 && ::write(notes, line.data(), line.size()) < 0) std::abort();
}

int read_choice() {
  const char* file = std::getenv("ORIEL_MUTANT_NOTES");
  if (file != nullptr) {
    notes = ::open(file, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0644);
    return kNoting;
  }
  const char* number = std::getenv("ORIEL_MUTANT");
  return number == nullptr ? INT_MAX : std::atoi(number);
}

}  // namespace

int chosen = kUnread;

bool answer(int number) {
  if (chosen == kUnread) chosen = read_choice();
  if (chosen == kNoting && !is_noted[static_cast<unsigned>(number)].exchange(true))
    note(std::to_string(number) + "\n");
  return chosen == number;
}

void begin_case(const char* name) {
  answer(0);
  if (chosen != kNoting) return;
  for (auto& is : is_noted) is = false;
  note(std::string("begin ") + name + "\n");
}

void end_case(double seconds, bool passed) {
  if (chosen == kNoting) note((passed ? "passed " : "failed ") + std::to_string(seconds) + "\n");
}

}  // namespace oriel_mutants
