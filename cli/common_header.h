#pragma once

#include "kernel/model/issue.h"

#include <optional>
#include <string>

namespace oriel::cli {

/// Several inputs that become one stream have one header: this compares the later ones with the
/// first.
class CommonHeader {
 public:
  /// Nothing if `header`, a CityJSON object, has the facts of the first (stream_header_facts). Else
  /// an error E116 in `input`.
  std::optional<Issue> check(const std::string& header, const std::string& input);

 private:
  std::string facts_, input_;  ///< of the first
};

}  // namespace oriel::cli
