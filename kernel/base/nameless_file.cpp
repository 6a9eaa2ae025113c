#include "kernel/base/nameless_file.h"

#include "kernel/base/issue.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <filesystem>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace oriel {

namespace {

constexpr std::size_t kPieceBytes = 1 << 20;

}  // namespace

NamelessFile::NamelessFile(const std::string& folder, std::string about)
    : about_(std::move(about)), name_((std::filesystem::path(folder) / ".oriel-XXXXXX").string()) {
  descriptor_ = ::mkstemp(name_.data());
  if (descriptor_ < 0) fail(errno);
}

NamelessFile::~NamelessFile() {
  forget_name();
  ::close(descriptor_);
}

void NamelessFile::forget_name() {
  if (!name_.empty()) ::unlink(name_.c_str());
  name_.clear();
}

void NamelessFile::fail(int reason, const char* what) const {
  Issue issue;
  issue.code = Code::E601;
  issue.sentence = std::string(what) + ": " + std::generic_category().message(reason);
  issue.place.file = about_;
  throw OutputError(std::move(issue));
}

void NamelessFile::append(std::string_view bytes) {
  buffer_ += bytes;
  if (buffer_.size() >= kPieceBytes) flush();
}

void NamelessFile::flush() {
  std::string_view rest = buffer_;
  while (!rest.empty()) {
    const ssize_t written = ::write(descriptor_, rest.data(), rest.size());
    if (written < 0 && errno == EINTR) continue;
    if (written < 0) fail(errno);
    rest.remove_prefix(static_cast<std::size_t>(written));
  }
  buffer_.clear();
}

void NamelessFile::read(const std::function<std::size_t(std::string_view)>& take) {
  flush();
  std::string piece;
  off_t place = 0;
  while (true) {
    const std::size_t left = piece.size();
    piece.resize(left + kPieceBytes);
    const ssize_t got = ::pread(descriptor_, piece.data() + left, kPieceBytes, place);
    if (got < 0 && errno != EINTR) fail(errno);
    const auto size = static_cast<std::size_t>(std::max<ssize_t>(got, 0));
    piece.resize(left + size);
    if (got == 0) return;
    place += static_cast<off_t>(size);
    piece.erase(0, take(piece));
  }
}

void NamelessFile::read_at(std::uint64_t place, std::span<char> bytes) const {
  while (!bytes.empty()) {
    const ssize_t got = ::pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(place));
    if (got < 0 && errno == EINTR) continue;
    if (got <= 0) fail(got < 0 ? errno : EIO, "what was written cannot be read again");
    place += static_cast<std::uint64_t>(got);
    bytes = bytes.subspan(static_cast<std::size_t>(got));
  }
}

std::string scratch_folder(const std::string& output) {
  struct stat found {};
  const bool is_there = ::stat(output.c_str(), &found) == 0;
  std::error_code error;
  if (output == "-" || (is_there && !S_ISREG(found.st_mode))) {
    const std::string folder = std::filesystem::temp_directory_path(error).string();
    if (!error) return folder;
    const char* const named = std::getenv("TMPDIR");
    return named != nullptr ? named : "/tmp";
  }
  const std::filesystem::path folder = std::filesystem::path(output).parent_path();
  return folder.empty() ? "." : folder.string();
}

}  // namespace oriel
