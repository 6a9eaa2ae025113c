#include "tests/fuzz/support/scratch_file.h"

#include <fcntl.h>
#include <filesystem>
#include <stdexcept>
#include <unistd.h>

namespace oriel::fuzz {

ScratchFile::ScratchFile(const std::string& name) {
  const std::filesystem::path memory("/dev/shm");
  const auto parent =
      ::access(memory.c_str(), W_OK) == 0 ? memory : std::filesystem::temp_directory_path();
  folder_ = (parent / "oriel-fuzz-XXXXXX").string();
  if (::mkdtemp(folder_.data()) == nullptr) throw std::runtime_error("no folder " + folder_);
  path_ = folder_ + "/" + name;
}

ScratchFile::~ScratchFile() {
  std::error_code none;
  std::filesystem::remove_all(folder_, none);
}

const std::string& ScratchFile::write(std::string_view bytes) const {
  const int file = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0600);
  if (file < 0) throw std::runtime_error("cannot write " + path_);
  while (!bytes.empty()) {
    const ssize_t count = ::write(file, bytes.data(), bytes.size());
    if (count <= 0) break;
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  ::close(file);
  if (!bytes.empty()) throw std::runtime_error("cannot write " + path_);
  return path_;
}

}  // namespace oriel::fuzz
