#include "cli/terminal/file_watch.h"

#include <thread>

namespace oriel::cli {

namespace {

/// Short against the time that a reader takes to look up, long against that of a look at a file.
constexpr std::chrono::milliseconds kBetweenLooks{50};

}  // namespace

FileWatch::Stamp FileWatch::stamp_of(const std::string& file) {
  Stamp stamp;
  std::error_code problem;
  stamp.time = std::filesystem::last_write_time(file, problem);
  if (!problem) stamp.size = std::filesystem::file_size(file, problem);
  stamp.is_there = !problem;
  return stamp.is_there ? stamp : Stamp();
}

void FileWatch::follow(const std::vector<std::string>& files) {
  for (const std::string& file : files) stamps_.try_emplace(file, stamp_of(file));
}

bool FileWatch::take_changes() {
  bool has_changed = false;
  for (auto& [file, stamp] : stamps_) {
    const Stamp now = stamp_of(file);
    if (!now.is_there || now == stamp) continue;
    stamp = now;
    has_changed = true;
  }
  return has_changed;
}

void FileWatch::wait() {
  while (!take_changes()) std::this_thread::sleep_for(kBetweenLooks);
  do std::this_thread::sleep_for(kBetweenLooks);
  while (take_changes());
}

}  // namespace oriel::cli
