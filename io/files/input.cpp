#include "io/files/input.h"

#include "io/json/text.h"
#include "kernel/base/issue.h"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <sys/stat.h>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace oriel {

namespace {

constexpr std::size_t kChunk = 1 << 18;
/// At least simdjson's padding (64 bytes).
constexpr std::size_t kPadding = 128;

InputError failure(const std::string& path, Fault fault) {
  const TextName name{path == "-" ? "stdin" : path, 0};
  return InputError(error_in(name, std::move(fault)));
}

InputError unreadable(const std::string& path, int reason) {
  return failure(path, {Code::E101, "cannot be read: " + std::generic_category().message(reason)});
}

void check_size(const std::string& path, std::size_t size) {
  if (size <= Input::kMaxBytes) return;
  throw failure(path,
                {Code::E505, "a record of more than 4 GB; split the file, or use CityJSONSeq"});
}

}  // namespace

Input::Input(std::string path) : path_(std::move(path)) {
  descriptor_ = path_ == "-" ? STDIN_FILENO : ::open(path_.c_str(), O_RDONLY | O_CLOEXEC);
  if (descriptor_ < 0) throw unreadable(path_, errno);
}

Input::~Input() {
  if (descriptor_ > STDIN_FILENO) ::close(descriptor_);
}

bool Input::fill() {
  buffer_.resize(kChunk);
  at_ = 0;
  ssize_t count = 0;
  do count = ::read(descriptor_, buffer_.data(), buffer_.size());
  while (count < 0 && errno == EINTR);
  const int reason = errno;
  buffer_.resize(count > 0 ? static_cast<std::size_t>(count) : 0);
  if (count < 0) throw unreadable(path_, reason);
  bytes_read_ += buffer_.size();
  return count > 0;
}

std::string_view Input::read_some() {
  if (at_ >= buffer_.size()) fill();
  const std::string_view bytes = std::string_view(buffer_).substr(at_);
  if (hash_) hash_->add(bytes);
  at_ = buffer_.size();
  return bytes;
}

std::string Input::read_all() {
  std::string text;
  if (struct stat status{}; ::fstat(descriptor_, &status) == 0 && S_ISREG(status.st_mode))
    text.reserve(std::min(static_cast<std::size_t>(status.st_size), kMaxBytes) + kPadding);
  do {
    text.append(buffer_, at_);
    if (hash_) hash_->add(std::string_view(buffer_).substr(at_));
    at_ = buffer_.size();
    check_size(path_, text.size());
  } while (fill());
  text.reserve(text.size() + kPadding);
  return text;
}

bool Input::read_line(std::string& line) {
  line.clear();
  bool is_begun = false;
  while (at_ < buffer_.size() || fill()) {
    is_begun = true;
    const std::size_t newline = buffer_.find('\n', at_);
    const std::size_t end = newline == std::string::npos ? buffer_.size() : newline;
    line.reserve(line.size() + (end - at_) + kPadding);
    line.append(buffer_, at_, end - at_);
    check_size(path_, line.size());
    const std::size_t next = newline == std::string::npos ? end : end + 1;
    if (hash_) hash_->add(std::string_view(buffer_).substr(at_, next - at_));
    at_ = next;
    if (newline != std::string::npos) break;
  }
  if (line.ends_with('\r')) line.pop_back();
  return is_begun;
}

}  // namespace oriel
