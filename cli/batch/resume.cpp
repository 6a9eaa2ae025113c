#include "cli/batch/resume.h"

#include "kernel/base/sha256.h"

#include <filesystem>
#include <fstream>
#include <limits>
#include <utility>

#include <fmt/format.h>

namespace oriel::cli {

namespace {

using nlohmann::ordered_json;

constexpr std::uint64_t kWhole = std::numeric_limits<std::uint64_t>::max();

/// The command line but for -j and what is logged, which change nothing in what is written.
std::string command_line() {
  std::ifstream file("/proc/self/cmdline", std::ios::binary);
  std::string text, word;
  bool is_value_next = false;
  while (std::getline(file, word, '\0')) {
    const bool has_value = word == "-j" || word == "--jobs" || word == "--log-level";
    if (std::exchange(is_value_next, has_value)) continue;
    if (word.starts_with("-j") || word.starts_with("--jobs") || word.starts_with("--log-"))
      continue;
    text += word + '\0';
  }
  return text;
}

InputError not_the_same(const std::string& journal, const std::string& why) {
  Issue issue;
  issue.code = Code::E117;
  issue.sentence = fmt::format("{}: the run cannot go on; delete this file to begin anew", why);
  issue.place.file = journal;
  return InputError(std::move(issue));
}

}  // namespace

std::string sha256_of_file(const std::string& path) {
  if (!std::filesystem::is_regular_file(path)) return {};
  return PartialFiles::mark_of(path, kWhole).sha256;
}

std::string program_sha256() {
  static const std::string sha256 =
      sha256_of_file(std::filesystem::read_symlink("/proc/self/exe").string());
  return sha256;
}

Resume::Resume(const LineArguments& arguments, const std::string& rules_sha256)
    : arguments_(arguments),
      journal_(arguments.status_stem + ".journal"),
      command_sha256_(sha256(command_line() + rules_sha256 + program_sha256())) {
  PartialFiles::keep();
  state_ = journal_.load();
  if (!state_) return;
  const std::string path = arguments.status_stem + ".journal";
  if (state_->at("command") != command_sha256_)
    throw not_the_same(path, "is of another command, program or rule pack");
  position_ = {state_->at("input"), state_->at("records"), state_->at("read_sha256")};
  if (!PartialFiles::restore(marks_of(state_->at("files"))))
    throw not_the_same(path, "tells of outputs that are not there any more");
  for (const auto& [name, mark] : journal_.read())
    if (name != "-" && sha256_of_file(name) != mark.sha256)
      throw not_the_same(path, name + " has changed since");
}

std::optional<int> Resume::finished() const {
  if (state_) return std::nullopt;
  std::ifstream file(arguments_.status_stem + ".status.json", std::ios::binary);
  const ordered_json status = ordered_json::parse(file, nullptr, false);
  if (!status.is_object() || status.value("command_sha256", "") != command_sha256_)
    return std::nullopt;
  for (const auto& [name, sha256] : status.at("input_sha256").items())
    if (sha256_of_file(name) != sha256.get<std::string>()) return std::nullopt;
  for (const auto& [path, mark] : marks_of(status.at("outputs")))
    if (PartialFiles::mark_of(path, kWhole) != mark) return std::nullopt;
  return status.at("exit_code").get<int>();
}

void Resume::note(const Position& position, ordered_json state) {
  const FileMarks files = PartialFiles::flush();
  state["command"] = command_sha256_;
  state["input"] = position.input;
  state["records"] = position.records;
  state["read_sha256"] = position.sha256;
  state["files"] = to_json(files);
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
