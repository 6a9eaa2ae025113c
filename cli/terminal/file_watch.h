#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace oriel::cli {

/// Waits until somebody saves one of the files it follows. Goes by time and size of the file, a few
/// times a second: that works for every editor and file system.
class FileWatch {
 public:
  /// Files that are not followed yet are, as they are now. Names of packs that are built in are no
  /// files and never change.
  void follow(const std::vector<std::string>& files);

  /// Returns when a file has changed and is at rest. A file that is gone is waited for: editors
  /// replace files.
  void wait();

 private:
  struct Stamp {
    std::filesystem::file_time_type time;
    std::uintmax_t size = 0;
    bool is_there = false;
    friend bool operator==(const Stamp&, const Stamp&) = default;
  };
  static Stamp stamp_of(const std::string& file);
  bool take_changes();

  std::map<std::string, Stamp> stamps_;
};

}  // namespace oriel::cli
