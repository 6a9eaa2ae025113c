#include "cli/batch/result_cache.h"

#include "cli/batch/resume.h"
#include "cli/batch/status.h"

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <fcntl.h>
#include <fstream>
#include <new>
#include <stdexcept>
#include <system_error>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::cli {

namespace {

using nlohmann::ordered_json;

constexpr const char* kNotesEnding = ".records.jsonl";

std::string note_text(const ordered_json& line) {
  return line.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::uint64_t key_of(std::string_view sha256) {
  std::uint64_t key = 0;
  std::from_chars(sha256.data(), sha256.data() + std::min<std::size_t>(16, sha256.size()), key, 16);
  return key;
}

/// `count` bytes of a file, or up to its end.
std::string stretch_of(int file, std::uint64_t at, std::uint64_t count) {
  std::string bytes(count, '\0');
  std::size_t got = 0;
  while (got < count) {
    const ssize_t more =
        ::pread(file, bytes.data() + got, count - got, static_cast<off_t>(at + got));
    if (more < 0 && errno == EINTR) continue;
    if (more <= 0) break;
    got += static_cast<std::size_t>(more);
  }
  bytes.resize(got);
  return bytes;
}

/// The line of a file that begins at `at`, without its line end.
std::string note_at(int file, std::uint64_t at) {
  constexpr std::uint64_t kChunk = 4096;
  std::string line;
  while (true) {
    const std::string more = stretch_of(file, at + line.size(), kChunk);
    const std::size_t end = more.find('\n');
    line += more.substr(0, end);
    if (end != std::string::npos || more.empty()) return line;
  }
}

}  // namespace

ResultCache::ResultCache(const std::string& status, const std::string& stem,
                         const std::string& recipe_sha256)
    : new_notes_(stem + kNotesEnding) {
  try {
    load(status, recipe_sha256);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& why) {
    fault_.emplace();
    fault_->severity = Severity::warning;
    fault_->code = Code::E124;
    fault_->sentence = fmt::format("this run cannot be reused: {}", why.what());
    fault_->place.file = status;
    notes_.clear();
  }
  if (new_notes_.size() == 0) new_notes_.append(note_text({{"recipe_sha256", recipe_sha256}}));
}

ResultCache::~ResultCache() {
  for (const auto& [path, file] : files_) ::close(file);
}

/// Files are opened before they are checked: this run may put others in their place.
void ResultCache::load(const std::string& status, const std::string& recipe_sha256) {
  if (!status.ends_with(kStatusEnding))
    throw std::runtime_error("its name does not end in .status.json");
  const FileMarks marks = read_status(status).outputs;
  notes_path_ =
      status.substr(0, status.size() - std::string_view(kStatusEnding).size()) + kNotesEnding;
  if (!marks.contains(notes_path_)) throw std::runtime_error("it was made without --reuse");
  for (const auto& [path, mark] : marks) {
    const int opened = ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
    if (opened < 0) throw std::runtime_error(path + ": " + std::generic_category().message(errno));
    files_[path] = opened;
    if (sha256_of_file(path) != mark.sha256) throw std::runtime_error(path + " has changed since");
  }
  std::ifstream notes(notes_path_, std::ios::binary);
  std::string line;
  std::getline(notes, line);
  if (line + "\n" != note_text({{"recipe_sha256", recipe_sha256}}))
    throw std::runtime_error("its rules, options or program differ");
  // A note begins with its hash: the rest is parsed when it is asked for.
  constexpr std::string_view kBegin = "{\"source_sha256\":\"";
  for (std::uint64_t at = line.size() + 1; std::getline(notes, line); at += line.size() + 1)
    notes_.push_back({key_of(std::string_view(line).substr(kBegin.size())), at});
  std::ranges::sort(notes_, {}, [](const Note& note) { return std::pair(note.key, note.at); });
}

std::optional<RecordOutcome> ResultCache::find(const std::string& source_sha256) const {
  Note sought;
  sought.key = key_of(source_sha256);
  const auto [from, to] = std::equal_range(notes_.begin(), notes_.end(), sought);
  for (auto note = from; note != to; ++note)
    if (auto outcome = outcome_at(*note, source_sha256)) return outcome;
  return std::nullopt;
}

std::optional<RecordOutcome> ResultCache::outcome_at(const Note& note,
                                                     const std::string& source_sha256) const {
  const ordered_json json =
      ordered_json::parse(note_at(files_.at(notes_path_), note.at), nullptr, false);
  if (!json.is_object() || json.at("source_sha256") != source_sha256) return std::nullopt;
  RecordOutcome outcome = outcome_of(json.at("outcome"));
  for (const ordered_json& part : json.at("parts")) {
    const auto file = files_.find(part.at(1).get<std::string>());
    if (file == files_.end()) return std::nullopt;
    std::string& bytes = outcome.product.bytes.at(part.at(0).get<std::size_t>());
    bytes = stretch_of(file->second, part.at(2), part.at(3));
    if (bytes.size() != part.at(3).get<std::size_t>()) return std::nullopt;
  }
  return outcome;
}

void ResultCache::add(const std::string& source_sha256, const PartPlaces& places,
                      const RecordOutcome& outcome) {
  ordered_json parts = ordered_json::array();
  for (std::size_t i = 0; i < kParts; ++i) {
    const std::size_t bytes = outcome.product.bytes[i].size();
    if (bytes > 0) parts.push_back({i, places[i].path, places[i].size, bytes});
  }
  new_notes_.append(note_text(
      {{"source_sha256", source_sha256}, {"parts", parts}, {"outcome", to_json(outcome)}}));
}

}  // namespace oriel::cli
