#pragma once

#include <algorithm>

namespace oriel::cli {

/// What the command ends with. Of several the gravest counts: internal > output > input > rules >
/// set aside.
enum class ExitCode {
  clean = 0,
  internal = 1,
  usage = 2,
  set_aside = 3,
  rules = 4,
  input = 5,
  output = 6
};

/// The graver of two.
constexpr ExitCode graver(ExitCode p, ExitCode q) {
  constexpr auto rank = [](ExitCode code) {
    switch (code) {
      case ExitCode::internal:
        return 6;
      case ExitCode::output:
        return 5;
      case ExitCode::input:
        return 4;
      case ExitCode::rules:
        return 3;
      case ExitCode::set_aside:
        return 2;
      case ExitCode::usage:
        return 1;
      case ExitCode::clean:
        return 0;
    }
    return 6;
  };
  return rank(p) >= rank(q) ? p : q;
}

}  // namespace oriel::cli
