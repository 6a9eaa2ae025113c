#include "studio/session/saved_file.h"

#include "io/files/file_lock.h"
#include "io/files/output_file.h"
#include "studio/session/request_body.h"

#include <cerrno>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>
#include <unistd.h>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

namespace fs = std::filesystem;

/// The lock of the folder of a file: the file itself may not be there yet, and is replaced.
class FolderLock {
 public:
  explicit FolderLock(const std::string& path) {
    std::error_code problem;
    const fs::path folder =
        fs::weakly_canonical(fs::absolute(path, problem), problem).parent_path();
    descriptor_ = open_locked(folder.string(), O_RDONLY | O_DIRECTORY);
    if (descriptor_ < 0 && errno == EWOULDBLOCK)
      throw RefusedRequest(409, fmt::format("another program is saving beside '{}'", path));
  }
  ~FolderLock() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_ = -1;
};

}  // namespace

std::optional<std::string> read_text_file(const std::string& path) {
  std::error_code problem;
  if (!fs::is_regular_file(path, problem)) return std::nullopt;
  std::ifstream file(path, std::ios::binary);
  if (!file) return std::nullopt;
  return std::string(std::istreambuf_iterator<char>(file), {});
}

std::string save_file(
    const std::string& path,
    const std::function<std::string(const std::optional<std::string>& on_disk)>& change) {
  const FolderLock lock(path);
  std::string text = change(read_text_file(path));
  try {
    write_file(path, text);
  } catch (const OutputError& fault) {
    throw RefusedRequest(500, fault.issue().sentence, fault.issue().code);
  }
  return text;
}

}  // namespace oriel::studio
