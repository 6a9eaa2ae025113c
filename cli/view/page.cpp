#include "cli/view/page.h"

#include "cli/view/embedded.h"

#include <string_view>

namespace oriel::cli {

std::string page_of(const std::string& data) {
  std::string page;
  std::string_view rest = page_html();
  const auto place = [&](std::string_view mark, std::string_view text) {
    const std::size_t at = rest.find(mark);
    page.append(rest.substr(0, at)).append(text);
    rest.remove_prefix(at + mark.size());
  };
  place("{{data}}", data);
  place("{{three}}", three_script());
  place("{{page}}", page_script());
  return page.append(rest);
}

}  // namespace oriel::cli
