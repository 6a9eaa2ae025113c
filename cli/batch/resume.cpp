#include "cli/batch/resume.h"

#include "cli/batch/status.h"
#include "io/files/file_lock.h"
#include "io/files/output_file.h"
#include "kernel/base/issue.h"
#include "kernel/base/sha256.h"

#include <cerrno>
#include <cstdio>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <limits>
#include <stdexcept>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

using nlohmann::ordered_json;

constexpr std::uint64_t kWhole = std::numeric_limits<std::uint64_t>::max();

/// Beyond this the journal is written anew: states that are past are of no use.
constexpr std::size_t kMostBytes = 1 << 20;

std::string line_of(const char* key, const ordered_json& value) {
  ordered_json line = ordered_json::object();
  line[key] = value;
  return line.dump() + '\n';
}

/// The command line but for --resume, -j and what is logged, which change nothing in what is
/// written.
std::string command_line() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string text, word;
  bool is_value_next = false;
  while (std::getline(file, word, '\0')) {
    const bool has_value = word == "-j" || word == "--jobs" || word == "--log-level";
    if (std::exchange(is_value_next, has_value)) continue;
    if (word == "--resume" || word.starts_with("-j") || word.starts_with("--jobs") ||
        word.starts_with("--log-"))
      continue;
    text += word + '\0';
  }
  if (text.empty() || file.bad()) throw std::runtime_error("/proc/self/cmdline cannot be read");
  return text;
}

InputError not_the_same(const std::string& journal, const std::string& why) {
  Issue issue;
  issue.code = Code::E117;
  issue.sentence =
      fmt::format("{}: the run cannot be resumed; delete this file to start again", why);
  issue.place.file = journal;
  return InputError(std::move(issue));
}

}  // namespace

ordered_json to_json(const FileMarks& marks) {
  ordered_json json = ordered_json::object();
  for (const auto& [path, mark] : marks)
    json[path] = {{"bytes", mark.bytes}, {"lines", mark.lines}, {"sha256", mark.sha256}};
  return json;
}

std::uint64_t count_of(const ordered_json& json) {
  // To convert a number that is not whole may be undefined.
  if (!json.is_number_integer() || json.get<std::int64_t>() < 0)
    throw ordered_json::type_error::create(302, "a count is " + json.dump(), &json);
  return json.get<std::uint64_t>();
}

std::string reason_of(const ordered_json::exception& error) {
  const std::string_view text = error.what();
  return std::string(text.substr(text.find("] ") + 2));
}

std::map<std::string, int> counts_of(const ordered_json& json) {
  std::map<std::string, int> counts;
  for (const auto& [name, count] : json.items()) counts[name] = static_cast<int>(count_of(count));
  return counts;
}

FileMarks marks_of(const ordered_json& json) {
  FileMarks marks;
  for (const auto& [path, mark] : json.items())
    marks[path] = {count_of(mark.at("bytes")), count_of(mark.at("lines")), mark.at("sha256")};
  return marks;
}

JournalState journal_state_of(const ordered_json& json) {
  return {json.at("command"),
          {count_of(json.at("input")), count_of(json.at("records")), json.at("read_sha256")},
          marks_of(json.at("files"))};
}

InputError damaged_journal(const std::string& path) {
  return not_the_same(path, "is damaged: its content was not written by oriel");
}

Journal::~Journal() {
  if (is_new_) ::unlink(path_.c_str());
  if (descriptor_ >= 0) ::close(descriptor_);
}

bool Journal::begin() {
  descriptor_ = open_locked(path_, O_WRONLY | O_CREAT);
  if (descriptor_ < 0) fail_to_write(path_, errno);
  is_new_ = std::filesystem::is_empty(path_);
  return is_new_;
}

void Journal::clear() {
  if (::ftruncate(descriptor_, 0) != 0) fail_to_write(path_, errno);
  is_new_ = true;
}

std::optional<ordered_json> Journal::load() {
  std::ifstream file(path_, std::ios::binary);
  std::optional<ordered_json> state;
  for (std::string text; std::getline(file, text) && !file.eof();) {
    const ordered_json line = ordered_json::parse(text, nullptr, false);
    if (!line.is_object()) break;
    try {
      if (line.contains("done")) done_.merge(marks_of(line["done"]));
      if (line.contains("read")) read_.merge(marks_of(line["read"]));
    } catch (const ordered_json::exception&) {
      throw damaged_journal(path_);
    }
    if (line.contains("state")) state = line["state"];
  }
  return state;
}

void Journal::append(const std::string& text) {
  for (std::size_t at = 0; at < text.size();) {
    const ssize_t count = ::write(descriptor_, text.data() + at, text.size() - at);
    if (count < 0 && errno != EINTR) fail_to_write(path_, errno);
    if (count > 0) at += static_cast<std::size_t>(count);
  }
  *bytes_ += text.size();
}

/// The journal takes its place by rename, so that there always is a whole one. The old one is
/// locked until the new one is in its place.
void Journal::compact(const std::string& state) {
  const std::string path = path_ + ".new";
  const int old = std::exchange(descriptor_, open_locked(path, O_WRONLY | O_CREAT | O_TRUNC));
  if (descriptor_ < 0) fail_to_write(path, errno);
  bytes_ = 0;
  if (!done_.empty()) append(line_of("done", to_json(done_)));
  if (!read_.empty()) append(line_of("read", to_json(read_)));
  append(state);
  if (std::rename(path.c_str(), path_.c_str()) != 0) fail_to_write(path_, errno);
  ::close(old);
  is_new_ = false;
}

void Journal::write(const FileMarks& done, const FileMarks& read, const ordered_json& state) {
  const std::string text = line_of("state", state);
  for (const auto& [path, mark] : done) done_[path] = mark;
  for (const auto& [path, mark] : read) read_[path] = mark;
  if (!bytes_ || *bytes_ > kMostBytes) return compact(text);
  if (!done.empty()) append(line_of("done", to_json(done)));
  if (!read.empty()) append(line_of("read", to_json(read)));
  append(text);
}

void Journal::remove() {
  ::unlink(path_.c_str());
  if (descriptor_ >= 0) ::close(std::exchange(descriptor_, -1));
}

std::string sha256_of_file(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) return {};
  return PartialFiles::mark_of(path, kWhole).sha256;
}

std::string program_sha256() {
  static const std::string sha256 =
      sha256_of_file(std::filesystem::read_symlink("/proc/self/exe").string());
  return sha256;
}

Resume::Resume(const RunOptions& options, const std::string& settings)
    : options_(options),
      journal_(options.status_stem + ".journal"),
      command_sha256_(sha256(command_line() + settings + program_sha256())) {
  PartialFiles::go_on();
  const bool is_new = journal_.begin();
  if (options.is_resumable) state_ = journal_.load();
  if (!state_) {
    if (!is_new) journal_.clear();
    return;
  }
  PartialFiles::keep();
  JournalState state;
  try {
    state = journal_state_of(*state_);
  } catch (const ordered_json::exception&) {
    throw damaged_journal(path());
  }
  if (state.command != command_sha256_)
    throw not_the_same(path(), "belongs to another command, program, rule pack or corrections");
  position_ = std::move(state.position);
  if (!PartialFiles::restore(state.files))
    throw not_the_same(path(), "lists outputs that no longer exist");
  for (const auto& [name, mark] : journal_.read())
    if (name != "-" && sha256_of_file(name) != mark.sha256)
      throw not_the_same(path(), name + " has changed since");
}

namespace {

std::optional<RunStatus> status_at(const std::string& stem) {
  try {
    return read_status(stem + kStatusEnding);
  } catch (const InputError&) {
    return std::nullopt;  // no status that oriel wrote: all is done again
  }
}

}  // namespace

std::optional<ExitCode> Resume::finished() const {
  if (state_) return std::nullopt;
  const auto status = status_at(options_.status_stem);
  if (!status || status->run_sha256 != run_sha256(*status, command_sha256_) ||
      status->state.code == ExitCode::input)
    return std::nullopt;
  for (const auto& [name, sha256] : status->input_sha256)
    if (sha256_of_file(name) != sha256) return std::nullopt;
  for (const auto& [path, mark] : status->outputs)
    if (PartialFiles::mark_of(path, kWhole) != mark) return std::nullopt;
  return status->state.code;
}

void Resume::note(const InputPosition& position, ordered_json state) {
  const FileMarks files = PartialFiles::flush();
  state["command"] = command_sha256_;
  state["input"] = position.input;
  state["records"] = position.records;
  state["read_sha256"] = position.sha256;
  state["files"] = to_json(files);
  PartialFiles::keep();
  journal_.write(PartialFiles::take_done(), std::exchange(read_, {}), state);
}

void Resume::note_read(const std::string& input, const std::string& sha256) {
  read_[input].sha256 = sha256;
}

FileMarks Resume::done() const {
  FileMarks done = PartialFiles::take_done(), earlier = journal_.done();
  done.merge(earlier);
  return done;
}

FileMarks Resume::read() const {
  FileMarks read = read_, earlier = journal_.read();
  read.merge(earlier);
  return read;
}

}  // namespace oriel::cli
