#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

namespace oriel::cli {

/// What options take, as CLI11 checks it and as `--help` and completion show it; a value that is
/// refused is named with what is expected in its place.

/// One of `words`; of one that is misspelt the nearest word is named.
CLI::Validator one_of(std::vector<std::string> words);

/// A number from `least` to `most`.
CLI::Validator number_in(double least, double most);

/// A whole number from `least` to `most`.
CLI::Validator count_in(std::int64_t least, std::int64_t most);

/// A number above 0, and one of at least 0.
CLI::Validator above_zero();
CLI::Validator at_least_zero();

}  // namespace oriel::cli
