#include "io/files/output_file.h"

#include "io/files/file_lock.h"
#include "io/files/leftovers.h"
#include "io/files/partial_files.h"
#include "io/json/text.h"
#include "kernel/base/issue.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <climits>

namespace oriel {

namespace {

/// Small, so that it stays in the caches; what is larger is written without a copy of it.
constexpr std::size_t kBuffer = 1 << 15;
/// Leftovers of crashed runs that may stand in the way of a temporary name.
constexpr int kMaxTries = 1000;

using detail::resolved;

/// A temporary file that is open. Signal handlers may only read plain memory, hence no string.
struct Listed {
  enum State { is_free, is_taken, is_set };
  std::atomic<int> state{is_free};
  std::array<char, PATH_MAX> name{};
};
std::array<Listed, 16> temporaries;  // more than that are not open at once; one more is not listed

int list_temporary(const std::string& name) {
  for (std::size_t i = 0; i < temporaries.size(); ++i) {
    Listed& listed = temporaries[i];
    int expected = Listed::is_free;
    if (name.size() >= listed.name.size() ||
        !listed.state.compare_exchange_strong(expected, Listed::is_taken))
      continue;
    std::memcpy(listed.name.data(), name.c_str(), name.size() + 1);
    listed.state = Listed::is_set;
    return static_cast<int>(i);
  }
  return -1;
}

/// A second descriptor of an open file, which keeps its lock when the first is closed.
class LockHolder {
 public:
  explicit LockHolder(int descriptor) : descriptor_(::fcntl(descriptor, F_DUPFD_CLOEXEC, 0)) {}
  ~LockHolder() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  LockHolder(const LockHolder&) = delete;
  LockHolder& operator=(const LockHolder&) = delete;

 private:
  int descriptor_;
};

void strike_temporary(int listed) {
  if (listed >= 0) temporaries[static_cast<std::size_t>(listed)].state = Listed::is_free;
}

}  // namespace

void remove_temporary_files() noexcept {
  for (const Listed& listed : temporaries)
    if (listed.state == Listed::is_set) ::unlink(listed.name.data());
}

OutputFile::OutputFile(std::string path) : path_(std::move(path)), target_(resolved(path_)) {
  if (path_ == "-") {
    descriptor_ = STDOUT_FILENO;
    return;
  }
  struct stat found {};
  const bool exists = ::stat(target_.c_str(), &found) == 0;
  if (exists && S_ISDIR(found.st_mode)) fail(EISDIR);
  if (exists && !S_ISREG(found.st_mode)) {
    descriptor_ = ::open(target_.c_str(), O_WRONLY | O_CLOEXEC);
    if (descriptor_ < 0) fail(errno);
    return;
  }
  detail::remove_leftovers(target_);
  if (PartialFiles::can_go_on())
    open_partial();
  else
    open_temporary();
  if (exists) ::fchmod(descriptor_, found.st_mode & 07777U);
}

void OutputFile::open_temporary() {
  for (int i = 0; i < kMaxTries; ++i) {
    const std::string name = detail::temporary_name(target_, i);
    listed_ = list_temporary(name);  // first, as a signal may come at any time
    descriptor_ = ::open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    const int reason = errno;
    if (descriptor_ >= 0 && detail::lock_temporary(descriptor_)) {
      temporary_ = name;
      return;
    }
    if (descriptor_ >= 0) {  // another run took it for a leftover before it was locked
      ::close(std::exchange(descriptor_, -1));
      strike_temporary(std::exchange(listed_, -1));
      continue;
    }
    strike_temporary(std::exchange(listed_, -1));
    errno = reason;
    if (errno != EEXIST) break;
  }
  fail(errno);
}

void OutputFile::open_partial() {
  temporary_ = PartialFiles::name_of(target_);
  descriptor_ = open_locked(temporary_, O_WRONLY | O_CREAT);
  if (descriptor_ < 0) {
    temporary_.clear();
    fail(errno);
  }
  PartialFiles::enter(*this);
  if (::ftruncate(descriptor_, static_cast<off_t>(size_)) != 0 ||
      ::lseek(descriptor_, 0, SEEK_END) < 0)
    fail(errno);
}

OutputFile::~OutputFile() {
  PartialFiles::leave(*this);
  if (descriptor_ > STDOUT_FILENO) ::close(descriptor_);
  if (!temporary_.empty() && !PartialFiles::are_kept()) ::unlink(temporary_.c_str());
  strike_temporary(listed_);
}

void fail_to_write(const std::string& path, int reason) {
  const TextName name{path == "-" ? "stdout" : path, 0};
  const std::string why = reason == EWOULDBLOCK ? "another process is writing it"
                                                : std::generic_category().message(reason);
  throw OutputError(error_in(name, {Code::E601, "cannot be written: " + why}));
}

void OutputFile::append(std::string_view bytes) {
  size_ += bytes.size();
  if (PartialFiles::are_watched()) {
    hash_.add(bytes);
    lines_ += static_cast<std::uint64_t>(std::ranges::count(bytes, '\n'));
  }
  if (buffer_.size() + bytes.size() > kBuffer) flush();
  if (bytes.size() > kBuffer)
    write(bytes);
  else
    buffer_ += bytes;
}

void OutputFile::flush() {
  write(buffer_);
  buffer_.clear();
}

void OutputFile::write(std::string_view left) {
  while (!left.empty()) {
    const ssize_t count = ::write(descriptor_, left.data(), left.size());
    if (count < 0 && errno != EINTR) fail(errno);
    if (count > 0) left.remove_prefix(static_cast<std::size_t>(count));
  }
}

void OutputFile::commit() {
  flush();
  if (temporary_.empty()) return;
  if (::fsync(descriptor_) != 0) fail(errno);
  // The lock is held until the file has its name: what is closed first is only one of two.
  const LockHolder lock(descriptor_);
  if (::close(std::exchange(descriptor_, -1)) != 0) fail(errno);
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
  PartialFiles::note_done(*this);
  strike_temporary(std::exchange(listed_, -1));
}

void write_file(const std::string& path, std::string_view bytes) {
  OutputFile file(path);
  file.append(bytes);
  file.commit();
}

}  // namespace oriel
