#include "io/json/plain_arrays.h"

#include "kernel/base/index.h"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace oriel::detail {

namespace {

/// Steps through a text that ends with a zero byte.
class NumberScan {
 public:
  NumberScan(const char* from, const char* end) : at_(from), end_(end) {}

  [[nodiscard]] const char* place() const { return at_; }

  /// Passes `c`, and white space before it; false, and at rest, if it does not come.
  bool take(char c) {
    if (*at_ != c && !(is_space(*at_) && comes_behind_space(c))) return false;
    ++at_;
    return true;
  }

  /// A digit comes next, without white space before it.
  [[nodiscard]] bool is_at_digit() const { return is_digit(*at_); }

  /// Passes the digits of a whole number of JSON and white space before them. False if there is
  /// none, or one of more than 16 digits.
  bool take_digits(std::uint64_t& number) {
    const unsigned count = take_eight(number);
    if (count == 0 || count == 8) return take_others(count, number);
    return count == 1 || at_[-static_cast<int>(count)] != '0';
  }

 private:
  static bool is_space(char c) { return c == ' ' || c == '\t' || c == '\n' || c == '\r'; }
  static bool is_digit(char c) { return c >= '0' && c <= '9'; }

  bool comes_behind_space(char c) {
    while (is_space(*at_)) ++at_;
    return *at_ == c;
  }

  /// Behind white space, or with eight digits that may have more behind them.
  bool take_others(unsigned count, std::uint64_t& number) {
    if (count == 0) {
      if (!is_space(*at_)) return false;
      while (is_space(*at_)) ++at_;
      return is_digit(*at_) && take_digits(number);
    }
    const bool starts_with_zero = at_[-8] == '0';
    std::uint64_t more = 0;
    const unsigned next = take_eight(more);
    for (unsigned i = 0; i < next; ++i) number *= 10;
    number += more;
    return !starts_with_zero && !is_digit(*at_);
  }

  /// Up to eight digits at once (D. Lemire, "Quickly parsing eight digits", 2018). Returns how
  /// many came.
  unsigned take_eight(std::uint64_t& number) {
    static_assert(std::endian::native == std::endian::little);
    std::uint64_t block = 0;
    const auto left = static_cast<std::size_t>(end_ - at_);
    if (left >= 8)
      std::memcpy(&block, at_, 8);
    else
      std::memcpy(&block, at_, left);
    block ^= 0x3030303030303030ULL;
    const std::uint64_t others = (block | (block + 0x7676767676767676ULL)) & 0x8080808080808080ULL;
    const auto count = static_cast<unsigned>(std::countr_zero(others)) / 8;
    number = 0;
    if (count == 0) return 0;
    block <<= 8 * (8 - count);
    block = block * 10 + (block >> 8U);
    number = ((block & 0x000000FF000000FFULL) * (100 + (1000000ULL << 32U)) +
              ((block >> 16U) & 0x000000FF000000FFULL) * (1 + (10000ULL << 32U))) >>
             32U;
    at_ += count;
    return count;
  }

  const char* at_;
  const char* end_;
};

constexpr std::uint64_t kMostBoundary = 999'999'999;

bool take_coordinate(NumberScan& scan, double& coordinate) {
  const bool is_negative = scan.take('-');
  std::uint64_t digits = 0;
  if ((is_negative && !scan.is_at_digit()) || !scan.take_digits(digits)) return false;
  const auto number = static_cast<std::int64_t>(digits);
  coordinate = static_cast<double>(is_negative ? -number : number);
  return true;
}

/// From the first bracket to behind the last one; false if they are not plain.
bool take_vertices(NumberScan& scan, std::vector<Vec3>& vertices) {
  if (!scan.take('[')) return false;
  if (scan.take(']')) return true;
  do {
    Vec3 v;
    const bool is_plain = scan.take('[') && take_coordinate(scan, v.x) && scan.take(',') &&
                          take_coordinate(scan, v.y) && scan.take(',') &&
                          take_coordinate(scan, v.z) && scan.take(']');
    if (!is_plain) return false;
    vertices.push_back(v);
  } while (scan.take(','));
  return scan.take(']');
}

/// The numbers of an array whose bracket is passed, to behind its end.
bool take_numbers(NumberScan& scan, std::vector<int>& numbers) {
  do {
    std::uint64_t number = 0;
    if (!scan.take_digits(number) || number > kMostBoundary) return false;
    numbers.push_back(static_cast<int>(number));
  } while (scan.take(','));
  return scan.take(']');
}

/// As take_vertices.
bool take_nested(NumberScan& scan, NestedNumbers& nested) {
  int open = 0;
  while (open <= NestedNumbers::kMaxDepth && scan.take('[')) ++open;
  nested.depth = open;
  if (open < 3 || open > NestedNumbers::kMaxDepth) return false;
  while (true) {
    if (!take_numbers(scan, nested.numbers)) return false;
    nested.ends[0].push_back(static_cast<int>(nested.numbers.size()));
    for (--open; open > 0 && scan.take(']'); --open) {
      const std::size_t level = at(nested.depth - open);
      nested.ends[level].push_back(static_cast<int>(nested.ends[level - 1].size()));
    }
    if (open == 0) return true;
    if (!scan.take(',')) return false;
    for (; open < nested.depth; ++open)
      if (!scan.take('[')) return false;
  }
}

}  // namespace

void NestedNumbers::clear() {
  depth = 0;
  numbers.clear();
  for (auto& level : ends) level.clear();
}

bool PlainArrays::read(std::string_view text, std::span<const TextRange> cut) {
  rest_.clear();
  size_ = 0;
  return read_arrays(text, cut) && rest_.find('\\') == std::string::npos;
}

/// Goes from string to string: without a backslash every second quote ends one.
bool PlainArrays::read_arrays(std::string_view text, std::span<const TextRange> cut) {
  std::size_t copied = 0;
  std::size_t next = text.find('"');
  while (true) {
    for (; !cut.empty() && next >= cut[0].begin; cut = cut.subspan(1)) {
      rest_.append(text, copied, cut[0].begin - copied).append("{}");
      copied = cut[0].end;
      next = text.find('"', copied);
    }
    if (next == std::string::npos) break;
    const std::size_t close = text.find('"', next + 1);
    if (close == std::string::npos) return false;
    const std::string_view string(&text[next + 1], close - next - 1);
    const std::size_t colon = skip_space(text, close + 1);
    const bool has_vertices = string == "vertices";
    const bool is_key =
        (has_vertices || string == "boundaries") && colon < text.size() && text[colon] == ':';
    next = close + 1;
    if (is_key) {
      Array& array = next_array();
      array.place.begin = skip_space(text, colon + 1);
      if (array.place.begin >= text.size()) return false;
      NumberScan scan(text.data() + array.place.begin, text.data() + text.size());
      if (has_vertices ? !take_vertices(scan, array.vertices)
                       : !take_nested(scan, array.boundaries))
        return false;
      array.place.end = next = static_cast<std::size_t>(scan.place() - text.data());
      const std::size_t depth = has_vertices ? 2 : at(array.boundaries.depth);
      rest_.append(text, copied, array.place.begin - copied);
      rest_.append(depth, '[').append(std::to_string(size_ - 1)).append(depth, ']');
      copied = next;
    }
    next = text.find('"', next);
  }
  rest_.append(text, copied, std::string::npos);
  return true;
}

PlainArrays::Array& PlainArrays::next_array() {
  if (size_ == arrays_.size()) arrays_.emplace_back();
  Array& array = arrays_[size_++];
  array.vertices.clear();
  array.boundaries.clear();
  return array;
}

}  // namespace oriel::detail
