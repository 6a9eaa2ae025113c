#include "oriel/reference/code_page.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <utility>

namespace oriel {

namespace {

/// A page of docs/ that was built in (oriel/CMakeLists.txt).
struct BuiltInPage {
  std::string_view name;
  std::string_view text;
};

constexpr std::array kPages = {
#include "code_pages.inc"
};

constexpr std::string_view kHeading = "\n### ";
constexpr std::string_view kRow = "\n| ";

/// The piece of `text` from `begin` up to the first of `ends`.
std::string_view up_to(std::string_view text, std::size_t begin,
                       std::initializer_list<std::string_view> ends) {
  std::size_t end = text.size();
  for (const std::string_view mark : ends) end = std::min(end, text.find(mark, begin));
  return text.substr(begin, end - begin);
}

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \n|");
  if (begin == std::string_view::npos) return "";
  return text.substr(begin, text.find_last_not_of(" \n|") + 1 - begin);
}

/// The section about a code, without its heading.
std::string_view section_of(std::string_view text, const std::string& code) {
  const std::size_t heading = text.find(std::string(kHeading) + code + " ");
  if (heading == std::string_view::npos) return "";
  const std::size_t begin = text.find('\n', heading + 1);
  return trimmed(up_to(text, begin, {"\n## ", "\n### ", "\n# "}));
}

/// The cell beside a code in a table.
std::string_view row_of(std::string_view text, const std::string& code) {
  for (const std::string_view after : {" |", " (", ","}) {
    const std::size_t row = text.find(std::string(kRow) + code + std::string(after));
    if (row == std::string_view::npos) continue;
    const std::string_view line = up_to(text, row + 1, {"\n"});
    return trimmed(line.substr(line.find('|', 1)));
  }
  return "";
}

/// A heading as the anchor that renderers of Markdown make of it.
std::string as_anchor(std::string_view heading) {
  std::string anchor;
  for (const char c : heading) {
    const auto u = static_cast<unsigned char>(c);
    if (std::isalnum(u) != 0 || c == '_' || c == '-') anchor += static_cast<char>(std::tolower(u));
    if (c == ' ') anchor += '-';
  }
  return anchor;
}

/// Page and text.
std::pair<std::string_view, std::string_view> find_page(Code code) {
  const std::string name = to_string(code);
  for (auto* look : {section_of, row_of})
    for (const BuiltInPage& page : kPages)
      if (const std::string_view found = name.empty() ? "" : look(page.text, name); !found.empty())
        return {page.name, found};
  return {};
}

}  // namespace

std::string_view page_of(Code code) { return find_page(code).second; }

std::string_view document_of(Code code) { return find_page(code).first; }

std::string anchor_of(Code code) {
  const std::string mark = std::string(kHeading) + to_string(code) + " ";
  for (const BuiltInPage& page : kPages) {
    const std::size_t at = code == Code::none ? std::string_view::npos : page.text.find(mark);
    if (at != std::string_view::npos)
      return as_anchor(up_to(page.text, at + kHeading.size(), {"\n"}));
  }
  return "";
}

}  // namespace oriel
