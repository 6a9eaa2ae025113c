#include "io/json/json_scan.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <functional>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace oriel {

namespace {

enum ByteKind : std::uint8_t { other, quote, open, close, separator, space };

constexpr std::array<std::uint8_t, 256> kKinds = [] {
  std::array<std::uint8_t, 256> kinds{};
  kinds['"'] = quote;
  kinds['{'] = kinds['['] = open;
  kinds['}'] = kinds[']'] = close;
  kinds[','] = kinds[':'] = separator;
  kinds[' '] = kinds['\t'] = kinds['\n'] = kinds['\r'] = space;
  return kinds;
}();

ByteKind kind_of(char c) { return static_cast<ByteKind>(kKinds[static_cast<unsigned char>(c)]); }

/// The offset behind the string whose opening quote is `text[at]`.
std::size_t end_of_string(std::string_view text, std::size_t at) {
  const std::size_t start = at + 1;
  for (at = text.find('"', start); at < text.size(); at = text.find('"', at + 1)) {
    std::size_t slashes = 0;
    while (at - slashes > start && text[at - slashes - 1] == '\\') ++slashes;
    if (slashes % 2 == 0) return at + 1;
  }
  return text.size();
}

constexpr std::size_t kBlockSize = 16;

/// What of sixteen bytes are quotes and brackets: bit masks, the first byte lowest.
struct Marks {
  unsigned quotes = 0, opens = 0, closes = 0;
  /// How many brackets there are.
  int open_count = 0, close_count = 0;
};

#if defined(__SSE2__)

/// All four brackets, and no other byte that JSON has outside strings, are { or } when bit 5 is
/// set. One sum of bytes counts both kinds: 1 for each that opens, 32 for each that closes.
Marks marks_of(const char* bytes) {
  const __m128i block = _mm_loadu_si128(reinterpret_cast<const __m128i*>(bytes));
  const __m128i folded = _mm_or_si128(block, _mm_set1_epi8(0x20));
  const __m128i opens = _mm_cmpeq_epi8(folded, _mm_set1_epi8('{'));
  const __m128i closes = _mm_cmpeq_epi8(folded, _mm_set1_epi8('}'));
  const __m128i quotes = _mm_cmpeq_epi8(block, _mm_set1_epi8('"'));
  const __m128i weights = _mm_or_si128(_mm_and_si128(opens, _mm_set1_epi8(1)),
                                       _mm_and_si128(closes, _mm_set1_epi8(32)));
  const __m128i sums = _mm_sad_epu8(weights, _mm_setzero_si128());
  const int sum = _mm_cvtsi128_si32(sums) + _mm_extract_epi16(sums, 4);
  const auto mask = [](__m128i of) { return static_cast<unsigned>(_mm_movemask_epi8(of)); };
  return {mask(quotes), mask(opens), mask(closes), sum % 32, sum / 32};
}

#else

Marks marks_of(const char* bytes) {
  Marks marks;
  for (std::size_t i = 0; i < kBlockSize; ++i) {
    const ByteKind kind = kind_of(bytes[i]);
    if (kind == quote) marks.quotes |= 1U << i;
    if (kind == open) marks.opens |= 1U << i;
    if (kind == close) marks.closes |= 1U << i;
  }
  marks.open_count = std::popcount(marks.opens);
  marks.close_count = std::popcount(marks.closes);
  return marks;
}

#endif

/// Counts brackets up to the one that closes what was opened.
class DepthCounter {
 public:
  /// Takes the brackets of a block before its first quote, if it has one. True if the last one is
  /// among them; then `last` is its place.
  bool close_in(const Marks& marks) {
    if (marks.quotes == 0 && depth_ > marks.close_count) {
      depth_ += marks.open_count - marks.close_count;
      return false;
    }
    const unsigned before = marks.quotes == 0 ? ~0U : (marks.quotes & -marks.quotes) - 1;
    for (unsigned left = (marks.opens | marks.closes) & before; left != 0; left &= left - 1) {
      last = std::countr_zero(left);
      depth_ += (marks.opens & (1U << static_cast<unsigned>(last))) != 0 ? 1 : -1;
      if (depth_ == 0) return true;
    }
    return false;
  }
  /// Takes one bracket; true if it is the last one.
  bool close_at(bool opens) {
    depth_ += opens ? 1 : -1;
    return depth_ == 0;
  }

  int last = 0;

 private:
  int depth_ = 0;
};

/// From `at` to `stop`, which is in no string. True if the last bracket is there; then `at` is
/// behind it.
bool close_before(std::string_view text, std::size_t& at, std::size_t stop, DepthCounter& counter) {
  while (at + kBlockSize <= stop) {
    const Marks marks = marks_of(&text[at]);
    if (counter.close_in(marks)) {
      at += static_cast<std::size_t>(counter.last) + 1;
      return true;
    }
    if (marks.quotes == 0)
      at += kBlockSize;
    else
      at = end_of_string(text, at + static_cast<std::size_t>(std::countr_zero(marks.quotes)));
  }
  for (; at < stop; ++at) {
    const ByteKind kind = kind_of(text[at]);
    if (kind == quote) at = end_of_string(text, at) - 1;
    if ((kind == open || kind == close) && counter.close_at(kind == open)) {
      ++at;
      return true;
    }
  }
  return false;
}

/// The offset behind the object or array whose opening bracket is `text[at]`.
std::size_t end_of_container(std::string_view text, std::size_t at,
                             std::span<const std::string_view> known) {
  constexpr std::less<const char*> comes_before;
  const auto start = [](std::string_view array) { return array.data(); };
  const char* const end = text.data() + text.size();
  DepthCounter counter;
  auto next = std::ranges::lower_bound(known, text.data() + at, comes_before, start);
  for (; next != known.end() && comes_before(next->data(), end); ++next) {
    const auto begin = static_cast<std::size_t>(next->data() - text.data());
    if (begin == at) return at + next->size();
    if (close_before(text, at, begin, counter)) return at;
    at = begin + next->size();
  }
  return close_before(text, at, text.size(), counter) ? at : text.size();
}

}  // namespace

std::size_t skip_space(std::string_view text, std::size_t at) {
  while (at < text.size() && kind_of(text[at]) == space) ++at;
  return at;
}

std::size_t end_of_value(std::string_view text, std::size_t at,
                         std::span<const std::string_view> known) {
  if (at >= text.size()) return text.size();
  const ByteKind kind = kind_of(text[at]);
  if (kind == quote) return end_of_string(text, at);
  if (kind == open) return end_of_container(text, at, known);
  while (at < text.size() && kind_of(text[at]) == other) ++at;
  return at;
}

void append_arrays_in(std::string_view text, std::vector<std::string_view>& arrays) {
  int depth = 0;
  std::size_t begin = 0, at = 0;
  const auto take = [&](std::size_t place, bool opens) {
    if (opens && ++depth == 2) begin = place;
    if (!opens && --depth == 1) arrays.push_back(text.substr(begin, place + 1 - begin));
  };
  for (; at + kBlockSize <= text.size(); at += kBlockSize) {
    const Marks marks = marks_of(&text[at]);
    for (unsigned left = marks.opens | marks.closes; left != 0; left &= left - 1)
      take(at + static_cast<std::size_t>(std::countr_zero(left)),
           (marks.opens & left & -left) != 0);
  }
  for (; at < text.size(); ++at)
    if (const ByteKind kind = kind_of(text[at]); kind == open || kind == close)
      take(at, kind == open);
}

}  // namespace oriel
