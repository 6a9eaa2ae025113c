#include "tests/cli/pages/ellipsis.h"

#include <algorithm>
#include <functional>
#include <optional>

namespace oriel::test {

namespace {

using Parts = std::vector<std::string>;

const std::string kEllipsis = "…";

/// Where nothing is alike, a longer text is cut to its first and last lines.
constexpr std::size_t kMostLines = 30;
constexpr std::size_t kFirstLines = 12;
constexpr std::size_t kLastLines = 3;
/// More new lines in a row become an ellipsis where the block has one already.
constexpr std::size_t kMostNew = 12;

std::string without_end(std::string line) {
  while (line.ends_with(' ')) line.pop_back();
  return line;
}

/// Whether `shown`, in which kEllipsis is any number of parts, is `printed`.
template <class IsSame>
bool fits_parts(const Parts& shown, const Parts& printed, IsSame is_same) {
  std::size_t i = 0, j = 0;
  // Behind the last ellipsis, and the part that it is tried from.
  std::optional<std::size_t> back;
  std::size_t from = 0;
  while (j < printed.size()) {
    if (i < shown.size() && shown[i] == kEllipsis) {
      back = ++i;
      from = j;
    } else if (i < shown.size() && is_same(shown[i], printed[j])) {
      ++i, ++j;
    } else if (back) {
      i = *back;
      j = ++from;
    } else {
      return false;
    }
  }
  while (i < shown.size() && shown[i] == kEllipsis) ++i;
  return i == shown.size();
}

/// Words, runs of spaces and ellipses; with `is_by_character` each character by itself.
Parts parts_of(const std::string& line, bool is_by_character) {
  Parts parts;
  bool is_joined = false;
  for (std::size_t i = 0; i < line.size();) {
    const bool is_ellipsis = line.compare(i, kEllipsis.size(), kEllipsis) == 0;
    const std::string part = is_ellipsis ? kEllipsis : line.substr(i, 1);
    i += part.size();
    const bool is_joined_on = is_joined && !is_ellipsis && !is_by_character &&
                              (part == " ") == (parts.back().back() == ' ');
    if (is_joined_on)
      parts.back() += part;
    else
      parts.push_back(part);
    is_joined = !is_ellipsis;
  }
  return parts;
}

bool fits_line(const std::string& shown, const std::string& printed) {
  if (shown == printed) return true;
  if (shown.find(kEllipsis) == std::string::npos) return without_end(shown) == without_end(printed);
  return fits_parts(parts_of(without_end(shown), true), parts_of(without_end(printed), true),
                    std::equal_to<>());
}

/// Pairs of indices, both rising, with the greatest sum of `alike`.
template <class Alike>
std::vector<std::pair<std::size_t, std::size_t>> align(const Parts& shown, const Parts& printed,
                                                       Alike alike) {
  const std::size_t rows = shown.size(), columns = printed.size();
  std::vector<std::vector<double>> sum(rows + 1, std::vector<double>(columns + 1)), own = sum;
  for (std::size_t i = rows; i-- > 0;)
    for (std::size_t j = columns; j-- > 0;) {
      own[i][j] = shown[i] == kEllipsis ? 0 : alike(shown[i], printed[j]);
      sum[i][j] = std::max(
          {sum[i + 1][j], sum[i][j + 1], own[i][j] > 0 ? own[i][j] + sum[i + 1][j + 1] : 0.0});
    }
  std::vector<std::pair<std::size_t, std::size_t>> pairs;
  for (std::size_t i = 0, j = 0; i < rows && j < columns;) {
    if (own[i][j] > 0 && sum[i][j] == own[i][j] + sum[i + 1][j + 1])
      pairs.emplace_back(i++, j++);
    else if (sum[i][j] == sum[i][j + 1])
      ++j;
    else
      ++i;
  }
  return pairs;
}

/// What was printed, with an ellipsis wherever one stood between the same neighbours. `write` says
/// how a part is written that is like one that was shown.
template <class Alike, class Write>
Parts merge_parts(const Parts& shown, const Parts& printed, Alike alike, Write write) {
  Parts merged;
  std::size_t i = 0, j = 0;
  const bool shortens = std::ranges::find(shown, kEllipsis) != shown.end();
  const auto fill = [&](std::size_t i_end, std::size_t j_end) {
    const auto begin = shown.begin();
    const bool is_long = shortens && j + kMostNew < j_end;
    const bool has_ellipsis =
        is_long || std::any_of(begin + static_cast<std::ptrdiff_t>(i),
                               begin + static_cast<std::ptrdiff_t>(i_end),
                               [](const std::string& part) { return part == kEllipsis; });
    if (has_ellipsis && j < j_end) merged.push_back(kEllipsis);
    for (; !has_ellipsis && j < j_end; ++j) merged.push_back(printed[j]);
  };
  for (const auto& [row, column] : align(shown, printed, alike)) {
    fill(row, column);
    merged.push_back(write(shown[row], printed[column]));
    i = row + 1;
    j = column + 1;
  }
  fill(shown.size(), printed.size());
  return merged;
}

double alike_words(const std::string& a, const std::string& b) {
  if (a != b) return 0;
  return a.front() == ' ' ? 0.1 : 1;
}

double alike_lines(const std::string& a, const std::string& b) {
  if (a.empty() || b.empty()) return a == b ? 0.1 : 0;
  if (fits_line(a, b)) return 2;
  const Parts words = parts_of(a, false), others = parts_of(b, false);
  const auto common = static_cast<double>(align(words, others, alike_words).size());
  const double share = 2 * common / static_cast<double>(words.size() + others.size());
  return share < 0.5 ? 0 : share;
}

/// The printed line, with the ellipses of the shown one where they still fit.
std::string line_again(const std::string& shown, const std::string& printed) {
  if (fits_line(shown, printed)) return shown;
  if (shown.find(kEllipsis) == std::string::npos) return without_end(printed);
  std::string line;
  for (const std::string& part :
       merge_parts(parts_of(shown, false), parts_of(without_end(printed), false), alike_words,
                   [](const std::string&, const std::string& word) { return word; }))
    line += part;
  return line;
}

Parts shortened(const Parts& printed) {
  if (printed.size() <= kMostLines) return printed;
  Parts lines(printed.begin(), printed.begin() + kFirstLines);
  lines.push_back(kEllipsis);
  lines.insert(lines.end(), printed.end() - kLastLines, printed.end());
  return lines;
}

}  // namespace

bool fits(const Parts& shown, const Parts& printed) {
  return fits_parts(shown, printed, fits_line);
}

Parts shown_again(const Parts& shown, const Parts& printed) {
  if (fits(shown, printed)) return shown;
  Parts trimmed;
  for (const std::string& line : printed) trimmed.push_back(without_end(line));
  if (align(shown, trimmed, alike_lines).empty()) return shortened(trimmed);
  return merge_parts(shown, trimmed, alike_lines, line_again);
}

}  // namespace oriel::test
