#pragma once

#include <array>
#include <span>
#include <string_view>

namespace oriel::cli {

/// A page of docs/ that says what codes mean, built into the command.
struct HelpPage {
  std::string_view name;
  std::string_view text;
};

std::span<const HelpPage> help_pages();

}  // namespace oriel::cli
