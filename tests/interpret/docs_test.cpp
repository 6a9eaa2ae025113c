#include "tests/interpret/support.h"

#include <fstream>
#include <iterator>
#include <optional>

using namespace oriel;
using namespace oriel::test;

namespace {

std::string read_file(const std::string& path) {
  std::ifstream file(std::string(ORIEL_SOURCE_DIR) + "/" + path);
  REQUIRE(file);
  return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

std::string read_docs() { return read_file("docs/rules.md"); }

/// The next fenced block that opens with `fence` at or after `at`, which is moved behind it.
std::optional<std::string> take_block(const std::string& text, const std::string& fence,
                                      std::size_t& at) {
  const std::size_t open = text.find(fence + "\n", at);
  if (open == std::string::npos) return std::nullopt;
  const std::size_t begin = open + fence.size() + 1;
  const std::size_t end = text.find("```", begin);
  at = end + 4;
  return text.substr(begin, end - begin);
}

std::string findings_of(const std::string& pack) {
  std::string printed;
  for (const Issue& issue : load_pack(pack, "pack.yaml").issues) printed += to_string(issue) + "\n";
  return printed;
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("the pack in the README is the first pack and loads without findings") {
    const std::string readme = read_file("README.md");
    std::size_t at = 0;
    const auto pack = take_block(readme, "```yaml", at);
    REQUIRE(pack);
    CHECK(*pack == read_file("examples/first_pack.yaml"));
    CHECK(findings_of(*pack).empty());
  }

  TEST_CASE("the packs in the reference load without findings") {
    const std::string docs = read_docs();
    const std::string text = docs.substr(0, docs.find("## Codes"));
    std::size_t packs = 0;
    std::size_t at = 0;
    while (const auto pack = take_block(text, "```yaml", at)) {
      if (!pack->starts_with("schema")) continue;  // of surfaces and tests
      ++packs;
      CHECK(findings_of(*pack).empty());
    }
    CHECK(packs >= 3);
  }

  TEST_CASE("every code of the reference is given for its example word by word") {
    const std::string docs = read_docs();
    std::size_t at = docs.find("## Codes");
    const auto header = take_block(docs, "```yaml", at);
    REQUIRE(header);
    std::size_t examples = 0;
    for (std::size_t section = docs.find("\n### R", at); section != std::string::npos;) {
      const std::size_t next = docs.find("\n### R", section + 1);
      const std::string text = docs.substr(section, next - section);
      const std::string code = text.substr(5, 4);
      std::size_t inside = 0;
      const auto example = take_block(text, "```yaml", inside);
      const auto message = example ? take_block(text, "```", inside) : std::nullopt;
      section = next;
      if (!example) continue;
      REQUIRE(message);
      ++examples;
      const bool is_whole = example->starts_with("schema");
      CHECK(findings_of(is_whole ? *example : *header + *example) == *message);
      CHECK(message->find(code) != std::string::npos);
    }
    CHECK(examples > 30);
  }
}
