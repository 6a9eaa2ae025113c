#pragma once

#include "kernel/base/issue.h"

#include <optional>
#include <string>

namespace oriel::cli {

/// Several inputs that become one stream, or one file, have one header: this compares the later
/// ones with the first.
class CommonHeader {
 public:
  /// What becomes of the inputs: a stream has one grid, a file may be given a finer one.
  enum class Of { stream, file };
  explicit CommonHeader(Of of = Of::stream) : of_(of) {}

  /// Nothing if `header`, a CityJSON object, has the facts of the first (stream_header_facts, of a
  /// file file_facts). Else an error E116 in `input`.
  std::optional<Issue> check(const std::string& header, const std::string& input);

 private:
  Of of_;
  std::string facts_, input_;  ///< of the first
};

}  // namespace oriel::cli
