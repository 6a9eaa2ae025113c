#include "cli/terminal/option_values.h"

#include "kernel/base/text/printable.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::cli {

namespace {

/// The sentence in place of CLI11's, which prints the largest double in full.
CLI::Validator saying(CLI::Validator validator, std::string expected) {
  const auto accepts = validator;
  validator.operation([accepts, expected = std::move(expected)](std::string& text) {
    return accepts(text).empty() ? std::string()
                                 : fmt::format("'{}' is not {}", printable(text), expected);
  });
  return validator;
}

/// "0.000001", "30": never with an exponent.
std::string plain(double number) {
  std::string text = fmt::format("{:.6f}", number);
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text;
}

}  // namespace

CLI::Validator one_of(std::vector<std::string> words) {
  CLI::Validator validator = CLI::IsMember(words);
  validator.operation([words = std::move(words)](std::string& text) {
    if (std::ranges::find(words, text) != words.end()) return std::string();
    const std::string meant = nearest(text, words);
    return fmt::format("'{}' is not one of {}{}", printable(text), fmt::join(words, ", "),
                       meant.empty() ? "" : fmt::format("; did you mean '{}'?", meant));
  });
  return validator;
}

CLI::Validator number_in(double least, double most) {
  return saying(CLI::Range(least, most),
                fmt::format("a number from {} to {}", plain(least), plain(most)));
}

CLI::Validator count_in(std::int64_t least, std::int64_t most) {
  return saying(CLI::Range(least, most), fmt::format("a whole number from {} to {}", least, most));
}

CLI::Validator above_zero() { return saying(CLI::PositiveNumber, "a number above 0"); }

CLI::Validator at_least_zero() { return saying(CLI::NonNegativeNumber, "a number of at least 0"); }

}  // namespace oriel::cli
