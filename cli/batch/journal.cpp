#include "cli/batch/journal.h"

#include "kernel/base/issue.h"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <fstream>
#include <system_error>
#include <unistd.h>
#include <utility>

namespace oriel::cli {

namespace {

using nlohmann::ordered_json;

/// Beyond this the journal is written anew: states that are past are of no use.
constexpr std::size_t kMostBytes = 1 << 20;

[[noreturn]] void fail(const std::string& path) {
  Issue issue;
  issue.code = Code::E601;
  issue.sentence = "cannot be written: " + std::generic_category().message(errno);
  issue.place.file = path;
  throw OutputError(std::move(issue));
}

std::string line_of(const char* key, const ordered_json& value) {
  ordered_json line;
  line[key] = value;
  return line.dump() + '\n';
}

}  // namespace

ordered_json to_json(const FileMarks& marks) {
  ordered_json json = ordered_json::object();
  for (const auto& [path, mark] : marks)
    json[path] = {{"bytes", mark.bytes}, {"lines", mark.lines}, {"sha256", mark.sha256}};
  return json;
}

FileMarks marks_of(const ordered_json& json) {
  FileMarks marks;
  for (const auto& [path, mark] : json.items())
    marks[path] = {mark.at("bytes"), mark.at("lines"), mark.at("sha256")};
  return marks;
}

Journal::~Journal() {
  if (descriptor_ >= 0) ::close(descriptor_);
}

std::optional<ordered_json> Journal::load() {
  std::ifstream file(path_, std::ios::binary);
  std::optional<ordered_json> state;
  for (std::string text; std::getline(file, text) && !file.eof();) {
    const ordered_json line = ordered_json::parse(text, nullptr, false);
    if (!line.is_object()) break;
    if (line.contains("done")) done_.merge(marks_of(line["done"]));
    if (line.contains("read")) read_.merge(marks_of(line["read"]));
    if (line.contains("state")) state = line["state"];
  }
  return state;
}

void Journal::open(bool is_fresh) {
  if (descriptor_ >= 0) ::close(descriptor_);
  const int mode = O_WRONLY | O_CREAT | O_CLOEXEC | (is_fresh ? O_TRUNC : O_APPEND);
  const std::string path = is_fresh ? path_ + ".new" : path_;
  descriptor_ = ::open(path.c_str(), mode, 0666);
  if (descriptor_ < 0) fail(path);
  bytes_ = 0;
}

void Journal::append(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t count = ::write(descriptor_, text.data() + at, text.size() - at);
    if (count < 0 && errno != EINTR) fail(path_);
    if (count > 0) at += static_cast<std::size_t>(count);
  }
  bytes_ += text.size();
}

/// The journal takes its place by rename, so that there always is a whole one.
void Journal::compact(const std::string& state) {
  open(true);
  if (!done_.empty()) append(line_of("done", to_json(done_)));
  if (!read_.empty()) append(line_of("read", to_json(read_)));
  append(state);
  if (std::rename((path_ + ".new").c_str(), path_.c_str()) != 0) fail(path_);
}

void Journal::write(const FileMarks& done, const FileMarks& read, const ordered_json& state) {
  const std::string text = line_of("state", state);
  for (const auto& [path, mark] : done) done_[path] = mark;
  for (const auto& [path, mark] : read) read_[path] = mark;
  if (descriptor_ < 0 || bytes_ > kMostBytes) return compact(text);
  if (!done.empty()) append(line_of("done", to_json(done)));
  if (!read.empty()) append(line_of("read", to_json(read)));
  append(text);
}

void Journal::remove() {
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
  ::unlink(path_.c_str());
}

}  // namespace oriel::cli
