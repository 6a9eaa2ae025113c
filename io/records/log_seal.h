#pragma once

#include <map>
#include <string>
#include <string_view>

namespace oriel {

/// Seals the log of a series while it is written, so that a change of it is found. Every line gets
/// a member "check", made of the line and the check before it; a last line has the number of
/// operations and the SHA-256 of each level (docs/formats.md).
class LogSealer {
 public:
  /// `lines` of operation_line(), each with its check.
  std::string sealed(std::string_view lines);
  /// The last line of the log. `levels`: the SHA-256 of each level's file, by N of 1:N.
  std::string end(const std::map<std::string, std::string>& levels);

 private:
  std::string sealed_line(std::string_view line);

  std::string check_;  ///< of the last line
  std::size_t operations_ = 0;
};

/// What a log says of its series.
struct LogSeal {
  /// False: the log has no checks at all, as those of older versions.
  bool is_sealed = false;
  /// The SHA-256 of each level's file, by N of 1:N.
  std::map<std::string, std::string> levels;
};

/// Reads a log once and compares all its checks. Throws InputError: E101 it cannot be read; E132,
/// with the line, it was changed, cut, or its lines were moved, or it is empty.
LogSeal check_log(const std::string& file);

/// True if a line of a log is the last one, which is no operation.
bool is_end_of_log(std::string_view line);

}  // namespace oriel
