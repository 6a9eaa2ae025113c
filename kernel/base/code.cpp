#include "kernel/base/code.h"

#include <algorithm>
#include <array>
#include <iterator>

namespace oriel {

namespace {

struct Row {
  std::string_view text;
  int val3dity;
  std::string_view meaning;
};

constexpr Row kRows[] = {{"", 0, ""},  // Code::none
#define ORIEL_CODE(code, val3dity, meaning) {#code, val3dity, meaning},
                         ORIEL_CODES(ORIEL_CODE)
#undef ORIEL_CODE
};

static_assert(std::ranges::is_sorted(kRows, {}, &Row::text));

const Row& row_of(Code code) { return kRows[static_cast<std::size_t>(code)]; }

constexpr Code kCodes[] = {
#define ORIEL_CODE(code, val3dity, meaning) Code::code,
    ORIEL_CODES(ORIEL_CODE)
#undef ORIEL_CODE
};

}  // namespace

std::string to_string(Code code) { return std::string(row_of(code).text); }

std::optional<Code> code_of(std::string_view text) {
  const auto found = std::ranges::lower_bound(kRows, text, {}, &Row::text);
  if (text.empty() || found == std::end(kRows) || found->text != text) return std::nullopt;
  return static_cast<Code>(found - std::begin(kRows));
}

std::string_view meaning_of(Code code) { return row_of(code).meaning; }

int val3dity_number(Code code) { return row_of(code).val3dity; }

std::span<const Code> all_codes() { return kCodes; }

bool is_about_geometry(Code code) { return row_of(code).text.starts_with("E3"); }

}  // namespace oriel
