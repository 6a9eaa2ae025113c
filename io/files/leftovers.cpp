#include "io/files/leftovers.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <map>
#include <mutex>
#include <string_view>
#include <sys/file.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <vector>

namespace oriel::detail {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kMark = ".tmp-";

bool is_number(std::string_view text) {
  return !text.empty() && text.size() <= 10 &&
         std::ranges::all_of(text, [](char c) { return c >= '0' && c <= '9'; });
}

/// NAME of a file that is called NAME.tmp-PID-N; else empty.
std::string_view target_in(std::string_view name) {
  const std::size_t mark = name.rfind(kMark);
  if (mark == std::string_view::npos) return {};
  const std::string_view numbers = name.substr(mark + kMark.size());
  const std::size_t dash = numbers.find('-');
  if (dash == std::string_view::npos || !is_number(numbers.substr(0, dash)) ||
      !is_number(numbers.substr(dash + 1)))
    return {};
  return name.substr(0, mark);
}

/// By the output that they were for.
using LeftoversByName = std::multimap<std::string, std::string>;

LeftoversByName leftovers_in(const fs::path& folder) {
  LeftoversByName found;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error)) {
    const std::string name = at->path().filename().string();
    if (const std::string_view target = target_in(name); !target.empty())
      found.emplace(target, at->path().string());
  }
  return found;
}

bool is_regular(int descriptor) {
  struct stat found {};
  return ::fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode);
}

/// Locked before it goes: a run that has just made it sees that it is gone (lock_temporary).
void remove_if_nobody_has(const std::string& path) {
  const int descriptor = ::open(path.c_str(), O_WRONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
  if (descriptor < 0) return;
  if (is_regular(descriptor) && ::flock(descriptor, LOCK_EX | LOCK_NB) == 0) ::unlink(path.c_str());
  ::close(descriptor);
}

}  // namespace

std::string temporary_name(const std::string& target, int number) {
  return target + std::string(kMark) + std::to_string(::getpid()) + "-" + std::to_string(number);
}

bool lock_temporary(int descriptor) {
  int locked = 0;
  do locked = ::flock(descriptor, LOCK_EX);
  while (locked != 0 && errno == EINTR);
  if (locked != 0) return true;
  struct stat found {};
  return ::fstat(descriptor, &found) != 0 || found.st_nlink > 0;
}

void remove_leftovers(const std::string& target) {
  static std::mutex mutex;
  static std::map<fs::path, LeftoversByName> folders;
  const fs::path path(target);
  const std::scoped_lock lock(mutex);
  const auto [folder, is_new] = folders.try_emplace(path.parent_path());
  if (is_new) folder->second = leftovers_in(folder->first);
  const auto [first, last] = folder->second.equal_range(path.filename().string());
  for (auto at = first; at != last; ++at) remove_if_nobody_has(at->second);
  folder->second.erase(first, last);
}

}  // namespace oriel::detail
