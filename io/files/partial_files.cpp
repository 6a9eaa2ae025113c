#include "io/files/partial_files.h"

#include "io/files/input.h"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace oriel {

namespace detail {

std::string resolved(const std::string& path) {
  std::error_code error;
  const auto full = std::filesystem::absolute(path, error);
  if (error) return path;
  const auto target = std::filesystem::weakly_canonical(full, error);
  return error ? path : target.string();
}

}  // namespace detail

namespace {

enum class Care { none, watch, go_on, keep };

/// What an earlier run left in a file.
struct Left {
  std::uint64_t bytes = 0, lines = 0;
  Sha256 hash;
};

Care care = Care::none;
std::vector<OutputFile*> open_files;
std::map<std::string, Left> left_by_target;
FileMarks done;

/// Throws InputError E101 if the file is there and cannot be read: part of it is not the whole.
Left left_in(const std::string& path, std::uint64_t bytes) {
  Left left;
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return left;
  Input file(path);
  while (left.bytes < bytes) {
    const std::string_view got = file.read_some().substr(0, bytes - left.bytes);
    if (got.empty()) break;
    left.hash.add(got);
    left.bytes += got.size();
    left.lines += static_cast<std::uint64_t>(std::ranges::count(got, '\n'));
  }
  return left;
}

FileMark mark_of_left(const Left& left) { return {left.bytes, left.lines, left.hash.digest()}; }

using detail::resolved;

}  // namespace

void PartialFiles::watch() { care = std::max(care, Care::watch); }
void PartialFiles::go_on() { care = std::max(care, Care::go_on); }
void PartialFiles::keep() { care = Care::keep; }
bool PartialFiles::are_watched() { return care != Care::none; }
bool PartialFiles::can_go_on() { return care >= Care::go_on; }
bool PartialFiles::are_kept() { return care == Care::keep; }

std::string PartialFiles::name_of(const std::string& target) { return target + ".partial"; }

FileMark PartialFiles::mark_of(const std::string& path, std::uint64_t bytes) {
  return mark_of_left(left_in(path, bytes));
}

bool PartialFiles::restore(const FileMarks& marks) {
  std::map<std::string, Left> found;
  std::vector<std::pair<std::string, std::string>> moves;
  for (const auto& [path, mark] : marks) {
    const std::string target = resolved(path), partial = name_of(target);
    Left left = left_in(partial, mark.bytes);
    if (mark_of_left(left) != mark) {
      left = left_in(target, mark.bytes);
      if (mark_of_left(left) != mark) return false;
      moves.emplace_back(target, partial);
    }
    found.emplace(target, std::move(left));
  }
  for (const auto& [target, partial] : moves) std::filesystem::rename(target, partial);
  left_by_target = std::move(found);
  return true;
}

FileMarks PartialFiles::flush() {
  FileMarks marks;
  for (OutputFile* file : open_files) {
    file->flush();
    marks[file->path_] = {file->size_, file->lines_, file->hash_.digest()};
  }
  return marks;
}

FileMarks PartialFiles::take_done() { return std::exchange(done, {}); }

void PartialFiles::enter(OutputFile& file) {
  open_files.push_back(&file);
  const auto left = left_by_target.find(file.target_);
  if (left == left_by_target.end()) return;
  file.size_ = left->second.bytes;
  file.lines_ = left->second.lines;
  file.hash_ = std::move(left->second.hash);
  left_by_target.erase(left);
}

void PartialFiles::leave(OutputFile& file) { std::erase(open_files, &file); }

void PartialFiles::note_done(const OutputFile& file) {
  std::erase(open_files, &file);
  if (care != Care::none) done[file.path_] = {file.size_, file.lines_, file.hash_.digest()};
}

}  // namespace oriel
