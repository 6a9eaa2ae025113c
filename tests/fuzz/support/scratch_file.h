#pragma once

#include <string>
#include <string_view>

namespace oriel::fuzz {

/// A file for readers that take nothing but a path: in memory (/dev/shm) where there is such a
/// place. Each process has its own, which goes with it.
class ScratchFile {
 public:
  /// The name says the format to readers: "a.csv".
  explicit ScratchFile(const std::string& name);
  ~ScratchFile();
  ScratchFile(const ScratchFile&) = delete;
  ScratchFile& operator=(const ScratchFile&) = delete;

  /// Replaces all of it; returns the path.
  const std::string& write(std::string_view bytes) const;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  std::string folder_;
  std::string path_;
};

}  // namespace oriel::fuzz
