#include "io/files/file_lock.h"

#include <cerrno>
#include <chrono>
#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <thread>
#include <unistd.h>

namespace oriel {

namespace {

/// Workers of a process that was killed end a moment after it.
constexpr int kMaxLockTries = 50;
constexpr std::chrono::milliseconds kBetween{10};

bool has_name(int descriptor, const std::string& path) {
  struct stat open {
  }, named{};
  return ::fstat(descriptor, &open) == 0 && ::stat(path.c_str(), &named) == 0 &&
         open.st_ino == named.st_ino && open.st_dev == named.st_dev;
}

}  // namespace

int open_locked(const std::string& path, int flags) {
  for (int tries = 0; tries < kMaxLockTries; ++tries) {
    const int descriptor = ::open(path.c_str(), flags | O_CLOEXEC, 0666);
    if (descriptor < 0) return -1;
    const bool is_taken = ::flock(descriptor, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    if (!is_taken && has_name(descriptor, path)) return descriptor;
    ::close(descriptor);
    if (is_taken) std::this_thread::sleep_for(kBetween);
  }
  errno = EWOULDBLOCK;
  return -1;
}

}  // namespace oriel
