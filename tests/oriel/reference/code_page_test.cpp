#include "oriel/reference/code_page.h"

#include <fstream>
#include <iterator>
#include <map>
#include <string>

#include <doctest/doctest.h>

using namespace oriel;

namespace {

std::string text_of_page(const std::string& name) {
  std::ifstream file(std::string(ORIEL_SOURCE_DIR) + "/docs/" + name, std::ios::binary);
  REQUIRE(file);
  return {std::istreambuf_iterator<char>(file), {}};
}

/// What stands between the heading of a code and the next heading, by code.
std::map<std::string, std::string> sections_of_page(const std::string& page) {
  std::map<std::string, std::string> sections;
  std::string code, line;
  bool is_in_block = false;
  std::ifstream file(std::string(ORIEL_SOURCE_DIR) + "/docs/" + page);
  while (std::getline(file, line)) {
    if (line.starts_with("```")) is_in_block = !is_in_block;
    const bool is_heading = !is_in_block && line.starts_with("#");
    if (is_heading) code = line.starts_with("### ") ? line.substr(4, 4) : "";
    if (!is_heading && !code.empty()) sections[code] += line + "\n";
  }
  return sections;
}

std::string trimmed(std::string text) {
  text.erase(0, text.find_first_not_of('\n'));
  text.erase(text.find_last_not_of('\n') + 1);
  return text;
}

}  // namespace

TEST_SUITE("oriel") {
  TEST_CASE("the page of a code is what the documentation says of it to the letter") {
    auto sections = sections_of_page("errors.md");
    sections.merge(sections_of_page("rules.md"));
    std::size_t found = 0;
    for (const Code code : all_codes()) {
      CAPTURE(to_string(code));
      const auto section = sections.find(to_string(code));
      if (section == sections.end()) continue;
      ++found;
      CHECK(page_of(code) == trimmed(section->second));
    }
    CHECK(found > 140);
  }

  TEST_CASE("every code has a page and says where it is") {
    for (const Code code : all_codes()) {
      CAPTURE(to_string(code));
      CHECK_FALSE(page_of(code).empty());
      const std::string page(document_of(code));
      REQUIRE_FALSE(page.empty());
      CHECK(text_of_page(page).find(page_of(code)) != std::string::npos);
    }
    CHECK(page_of(Code::none).empty());
    CHECK(page_of(Code::R274).starts_with("its sizes "));
    CHECK(document_of(Code::R274) == "generalisation.md");
  }

  TEST_CASE("a section of a code has an anchor, and a row of a table has none") {
    CHECK(anchor_of(Code::E901).starts_with("e901-"));
    CHECK(anchor_of(Code::E901).find(' ') == std::string::npos);
    CHECK(anchor_of(Code::none).empty());
    CHECK(anchor_of(Code::R274).empty());
  }
}
