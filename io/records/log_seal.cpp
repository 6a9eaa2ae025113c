#include "io/records/log_seal.h"

#include "io/files/input.h"
#include "io/json/text.h"
#include "kernel/base/sha256.h"
#include "kernel/base/text/counted.h"

#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel {

namespace {

using nlohmann::ordered_json;

/// So many hexadecimal digits tell two logs apart; a line is not longer for it than it must be.
constexpr std::size_t kCheckDigits = 16;
/// What stands between a line and its check, and what the last line begins with.
constexpr std::string_view kCheckMember = ",\"check\":\"", kCheckEnd = "\"}",
                           kEndOfLog = "{\"end\":";

std::string check_of(const std::string& before, std::string_view rest) {
  return sha256(before + std::string(rest)).substr(0, kCheckDigits);
}

/// A line without and with its check.
struct CheckedLine {
  std::string_view rest;
  std::string check;
};

std::optional<CheckedLine> taken_apart(std::string_view line) {
  const std::size_t length = kCheckMember.size() + kCheckDigits + kCheckEnd.size();
  if (line.size() < length || !line.ends_with(kCheckEnd)) return std::nullopt;
  const std::string_view rest = line.substr(0, line.size() - length);
  if (!line.substr(rest.size()).starts_with(kCheckMember)) return std::nullopt;
  return CheckedLine{rest,
                     std::string(line.substr(rest.size() + kCheckMember.size(), kCheckDigits))};
}

/// Goes through a log and remembers what its checks say.
class LogChecker {
 public:
  explicit LogChecker(const std::string& file) : name_{file, 0}, input_(file) {}

  LogSeal check() {
    std::string line;
    while (input_.read_line(line)) {
      ++name_.line;
      if (is_ended_) refuse("comes after the end of the log");
      check_line(line);
    }
    if (name_.line == 0) refuse("the log is empty; one without operations has a line that says so");
    if (has_checks_ && !is_ended_) refuse("the log ends here, and its last line is missing");
    return std::move(seal_);
  }

 private:
  [[noreturn]] void refuse(std::string sentence) {
    throw InputError(error_in(name_, {Code::E132, std::move(sentence)}));
  }

  void check_line(std::string_view line) {
    const auto parts = taken_apart(line);
    if (name_.line == 1) has_checks_ = parts.has_value() || is_end_of_log(line);
    if (!has_checks_ && !parts && !is_end_of_log(line)) return;
    if (!parts) refuse("has no check, but the other lines of this log have one");
    if (!has_checks_) refuse("has a check, but the lines before it have none");
    if (check_of(check_, parts->rest) != parts->check)
      refuse("is not the line that was written here: its check does not match");
    check_ = parts->check;
    seal_.is_sealed = true;
    if (is_end_of_log(line))
      read_end(line);
    else
      ++operations_;
  }

  void read_end(std::string_view line) {
    is_ended_ = true;
    const ordered_json end = ordered_json::parse(line, nullptr, false);
    if (!end.is_object() || end.at("end") != operations_ || !end.contains("levels"))
      refuse(fmt::format("does not fit the {} before it", counted(operations_, "operation")));
    end.at("levels").get_to(seal_.levels);
  }

  TextName name_;
  Input input_;
  std::string check_;
  std::size_t operations_ = 0;
  bool has_checks_ = false, is_ended_ = false;
  LogSeal seal_;
};

}  // namespace

std::string LogSealer::sealed_line(std::string_view line) {
  const std::string_view rest = line.substr(0, line.size() - 1);  // without its brace
  check_ = check_of(check_, rest);
  return fmt::format("{}{}{}{}\n", rest, kCheckMember, check_, kCheckEnd);
}

std::string LogSealer::sealed(std::string_view lines) {
  std::string out;
  while (!lines.empty()) {
    const std::size_t end = lines.find('\n');
    out += sealed_line(lines.substr(0, end));
    lines.remove_prefix(end + 1);
    ++operations_;
  }
  return out;
}

std::string LogSealer::end(const std::map<std::string, std::string>& levels) {
  ordered_json line{{"end", operations_}};
  line["levels"] = levels;
  return sealed_line(line.dump());
}

LogSeal check_log(const std::string& file) { return LogChecker(file).check(); }

bool is_end_of_log(std::string_view line) { return line.starts_with(kEndOfLog); }

}  // namespace oriel
