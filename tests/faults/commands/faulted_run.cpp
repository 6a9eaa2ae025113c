#include "tests/faults/commands/faulted_run.h"

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <fstream>
#include <regex>
#include <sstream>
#include <stdexcept>

#include <fmt/format.h>

namespace oriel::test {

namespace {

namespace fs = std::filesystem;

/// Without what differs from run to run: peak memory in status files, milliseconds.
std::string steady(const std::string& name, std::string bytes) {
  static const std::regex memory("\"peak_memory_bytes\": \\d+"), time("_ms\":[0-9.]+");
  if (name.ends_with(".status.json")) return std::regex_replace(bytes, memory, "");
  if (name.ends_with("times.json")) return std::regex_replace(bytes, time, "");
  return bytes;
}

Files raw_files_in(const fs::path& folder) {
  Files files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file())
      files[fs::relative(entry.path(), folder).string()] = bytes_of(entry.path());
  return files;
}

Files files_in(const fs::path& folder) {
  Files files = raw_files_in(folder);
  for (auto& [name, bytes] : files) bytes = steady(name, std::move(bytes));
  return files;
}

/// What a run says of itself, which is another if it fails.
bool is_about_the_run(const std::string& name) {
  for (const char* ending : {".status.json", ".quarantine.jsonl", ".records.jsonl", "report.xml"})
    if (name.ends_with(ending)) return true;
  return false;
}

/// A building that a fault cost stands in the outputs as it came, and its features nowhere.
bool is_building_rejected(const Outcome& outcome) {
  constexpr int kSetAside = 3;
  return outcome.exit == kSetAside && (outcome.says("E507") || outcome.says("E123"));
}

/// A GLB says in its head how long it is.
bool is_whole_glb(const std::string& bytes) {
  constexpr std::size_t kLengthAt = 8, kHead = 12;
  if (!bytes.starts_with("glTF") || bytes.size() < kHead) return false;
  std::size_t length = 0;
  for (std::size_t i = 0; i < 4; ++i)
    length += std::size_t{static_cast<unsigned char>(bytes[kLengthAt + i])} << (8 * i);
  return length == bytes.size();
}

bool ends_alike(const std::string& p, const std::string& q) {
  if (p.starts_with("glTF")) return is_whole_glb(q);
  return p.empty() || q.empty() || p.back() == q.back();
}

bool is_of_a_run_that_goes_on(const std::string& name) {
  return name.ends_with(".partial") || name.ends_with(".part") || name.ends_with(".journal") ||
         name.ends_with(".journal.new");
}

CallCounts counts_in(const std::string& path) {
  CallCounts counts;
  std::istringstream text(bytes_of(path));
  std::string name;
  for (long count = 0; text >> name >> count;) {
    if (name == "at")
      counts.first_calls.push_back(count);
    else
      counts.calls[name] = count;
  }
  std::ranges::sort(counts.first_calls);
  return counts;
}

}  // namespace

FaultedRuns::FaultedRuns(WritingCommand command) : command_(std::move(command)) {
  before_ = command_.inputs;
  restore();
  for (const auto& words : command_.first)
    if (const Outcome outcome = run_command(words); outcome.exit != 0)
      throw std::runtime_error("a first step fails: " + outcome.err);
  before_ = raw_files_in(folder_.path());
  undisturbed_ = run_command(command_.words, "ORIEL_FAULT_COUNTS=" + notes_ / "counts");
  made_ = files_in(folder_.path());
  counts_ = counts_in(notes_ / "counts");
  if (counts_.calls.empty()) throw std::runtime_error("no call was counted");
}

void FaultedRuns::restore() const {
  for (const auto& entry : fs::directory_iterator(folder_.path())) fs::remove_all(entry.path());
  for (const auto& [name, bytes] : before_) {
    fs::create_directories((folder_.path() / name).parent_path());
    std::ofstream(folder_.path() / name, std::ios::binary) << bytes;
  }
}

Outcome FaultedRuns::run_command(const std::vector<std::string>& words,
                                 const std::string& variable) const {
  std::vector<std::string> arguments;
  for (std::string word : words) {
    if (const auto at = word.find('@'); at != std::string::npos)
      word.replace(at, 1, folder_.path().string());
    arguments.push_back(std::move(word));
  }
  if (variable.empty()) return run(arguments);
  return run(arguments,
             {.environment = {std::string("LD_PRELOAD=") + ORIEL_FAILING_CALLS, variable}});
}

Outcome FaultedRuns::run_with(const std::string& fault) const {
  restore();
  return run_command(command_.words, "ORIEL_FAULT=" + fault);
}

/// The name of a file that is neither as before nor as made.
std::string FaultedRuns::strange_file(const Files& after, const Outcome& outcome) const {
  const bool may_be_another = is_building_rejected(outcome);
  for (const auto& [name, bytes] : after) {
    if (command_.is_resumable && is_of_a_run_that_goes_on(name)) continue;
    const auto before = before_.find(name), made = made_.find(name);
    if (before != before_.end() && steady(name, before->second) == bytes) continue;
    if (made == made_.end()) return name;
    if (made->second == bytes) continue;
    if (!may_be_another && (outcome.exit == undisturbed_.exit || !is_about_the_run(name)))
      return name;
    if (!ends_alike(made->second, bytes)) return name;
  }
  for (const auto& [name, bytes] : before_)
    if (!after.contains(name)) return name;
  return {};
}

std::string FaultedRuns::fault_of(const std::string& function, long n, const std::string& how,
                                  bool is_lasting, const std::string& reason) {
  const std::string fault = fmt::format("{}:{}{}:{}", function, n, is_lasting ? "+" : "", how);
  const Outcome outcome = run_with(fault);
  const Files after = files_in(folder_.path());
  const auto problem = [&](const std::string& what) {
    return fmt::format("{} {}: {}; exit code {}, it says: {}", command_.name, fault, what,
                       outcome.exit, outcome.err);
  };
  if (outcome.exit == 128 + SIGALRM) return problem("does not end");
  if (outcome.exit >= 124) return problem("ended by a signal");
  if (const std::string name = strange_file(after, outcome); !name.empty())
    return problem(name + " is not whole");
  if (outcome.exit == undisturbed_.exit) {
    if (after != made_) return problem("files are missing or left over");
    return outcome.out == undisturbed_.out ? "" : problem("stdout is another");
  }
  if (!outcome.says("error: ") || !outcome.says(reason)) return problem("does not say why");
  if (!command_.is_resumable || is_building_rejected(outcome)) return {};
  const Outcome again = run_command(command_.words);
  if (again.exit == undisturbed_.exit && files_in(folder_.path()) == made_) return {};
  return problem(fmt::format("does not go on: exit code {}, {}", again.exit, again.err));
}

std::string FaultedRuns::trace_of(const std::string& function, long n, const std::string& how) {
  const Outcome outcome = run_with(fmt::format("{}:{}:{}", function, n, how));
  if (outcome.exit == undisturbed_.exit && outcome.out == undisturbed_.out &&
      outcome.err == undisturbed_.err && files_in(folder_.path()) == made_)
    return {};
  return fmt::format("{}: call {} of {} is not repeated after {}; exit code {}, it says: {}",
                     command_.name, n, function, how, outcome.exit, outcome.err);
}

}  // namespace oriel::test
