#include "interpret/yaml/libyaml_events.h"

#include "interpret/pack/rule_base.h"
#include "tests/interpret/mutator.h"

#include <optional>
#include <sstream>
#include <string>
#include <string_view>

#include <doctest/doctest.h>
#include <yaml-cpp/eventhandler.h>
#include <yaml-cpp/exceptions.h>
#include <yaml-cpp/mark.h>
#include <yaml-cpp/parser.h>

using namespace oriel;
using namespace oriel::test;
using rules::read_by_libyaml;

namespace {

/// Writes down what a parser tells, with positions.
class EventLog : public YAML::EventHandler {
 public:
  [[nodiscard]] std::string text() const { return out_.str(); }

  void OnDocumentStart(const YAML::Mark& /*mark*/) override { out_ << "document\n"; }
  void OnDocumentEnd() override { out_ << "end\n"; }
  void OnNull(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    out_ << "null " << mark.pos << ' ' << anchor << '\n';
  }
  void OnAlias(const YAML::Mark& mark, YAML::anchor_t anchor) override {
    out_ << "alias " << mark.pos << ' ' << anchor << '\n';
  }
  void OnScalar(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                const std::string& value) override {
    out_ << "scalar " << mark.pos << ' ' << tag << ' ' << anchor << " <" << value << ">\n";
  }
  void OnSequenceStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                       YAML::EmitterStyle::value style) override {
    out_ << "list " << mark.pos << ' ' << tag << ' ' << anchor << ' ' << style << '\n';
  }
  void OnSequenceEnd() override { out_ << "end\n"; }
  void OnMapStart(const YAML::Mark& mark, const std::string& tag, YAML::anchor_t anchor,
                  YAML::EmitterStyle::value style) override {
    out_ << "map " << mark.pos << ' ' << tag << ' ' << anchor << ' ' << style << '\n';
  }
  void OnMapEnd() override { out_ << "end\n"; }

 private:
  std::ostringstream out_;
};

/// What is told of a text that is usual; nothing of others.
std::optional<std::string> told_of_usual(const std::string& text) {
  EventLog log;
  if (!read_by_libyaml(text, log)) return std::nullopt;
  return log.text();
}

/// What yaml-cpp tells, or what it finds wrong.
std::string told_by_yaml_cpp(const std::string& text) {
  EventLog log;
  std::istringstream stream(text);
  try {
    YAML::Parser parser(stream);
    while (parser.HandleNextDocument(log)) {
    }
  } catch (const YAML::Exception& problem) {
    return problem.what();
  }
  return log.text();
}

/// Texts of pieces that mean something in YAML, one after the other by chance.
std::string assembled(std::mt19937& random) {
  static constexpr std::string_view kPieces[] = {
      "a",  "b", "c1", "null", "a: ", "b: ", ": ", ":",  " ", "  ", "\n", "\n  ", "\n    ", "\n- ",
      "- ", "-", "[",  "]",    "{",   "}",   ", ", ",",  "#", " #", "\"", "'",    "\"x\"",  "'y'",
      "?",  "*", "&",  "!",    "|",   ">",   "%",  "\\", ".", "~",  "=",  "é",    "---"};
  std::string text = random() % 2 == 0 ? "k: " : "";
  const std::size_t size = 1 + random() % 24;
  for (std::size_t i = 0; i < size; ++i) text += kPieces[random() % std::size(kPieces)];
  return text;
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("every embedded pack is read without yaml-cpp and means the same") {
    for (const std::string& name : embedded_packs()) {
      const std::string text(*embedded_pack(name));
      CHECK_MESSAGE(told_of_usual(text) == told_by_yaml_cpp(text), name);
    }
  }

  TEST_CASE("usual YAML in all its forms is read as yaml-cpp reads it") {
    const std::string text =
        "# a comment\n"
        "\n"
        "schema: oriel/1   # behind a value\n"
        "quoted: 'it # is'\n"
        "\"key in quotes\": \"and: a, [value]\"\n"
        "with blanks : -1.5 m\n"
        "nested:\n"
        "    deeper: x:y\n"
        "    list:  # at the key's own column\n"
        "    - a = b and c#d\n"
        "    -   id: e\n"
        "        label: f\n"
        "    - - g\n"
        "      - h\n"
        "    -\n"
        "      i: j\n"
        "map: {k: l, 'm': [n, \"o\", {}], p: [\n"
        "    q,  # in brackets\n"
        "    r], s: $t} # behind brackets\n"
        "last: [[], {u: v,}\n"
        "]\n";
    const auto told = told_of_usual(text);
    REQUIRE(told.has_value());
    CHECK(*told == told_by_yaml_cpp(text));
  }

  TEST_CASE("YAML that is not usual is left to yaml-cpp") {
    for (const std::string_view text : {"",
                                        "# nothing\n",
                                        "a",
                                        "- a\n",
                                        "[a]\n",
                                        "a:\n",
                                        "a: ~\n",
                                        "a: null\n",
                                        "a: b\n  c\n",
                                        "a: b\n c: d\n",
                                        "a: b: c\n",
                                        "a: [b?]\n",
                                        "a: - b\n",
                                        "a: [b\n",
                                        "a: [b: c]\n",
                                        "a: {b}\n",
                                        "a: [b c\n  d]\n",
                                        "a: &b c\n",
                                        "a: *b\n",
                                        "a: !b c\n",
                                        "a: |\n  b\n",
                                        "a: \"b\\n\"\n",
                                        "a: 'b''c'\n",
                                        "a: \"b\n  c\"\n",
                                        "a: 'b' c\n",
                                        "a:\tb\n",
                                        "a: b\r\n",
                                        "? a\n",
                                        "--- \na: b\n",
                                        "a: b\n---\n",
                                        "a: {b: c}}\n",
                                        "\xEF\xBB\xBF"
                                        "a: b\n",
                                        "a: {b: [c}\n"})
      CHECK_MESSAGE(!told_of_usual(std::string(text)), text);
  }

  TEST_CASE("what is read of mutated packs is what yaml-cpp reads") {
    const std::string pack(*embedded_pack("surfaces-only"));
    std::size_t read = 0, left = 0;
    for (unsigned seed = 0; seed < 3000; ++seed) {
      const std::string text = Mutator(seed).mutated(pack);
      const auto told = told_of_usual(text);
      ++(told ? read : left);
      if (told) CHECK_MESSAGE(*told == told_by_yaml_cpp(text), text);
    }
    CHECK(read > 300);
    CHECK(left > 300);
  }

  TEST_CASE("what is read of texts made by chance is what yaml-cpp reads") {
    std::mt19937 random(5);
    std::size_t read = 0;
    for (int i = 0; i < 100'000; ++i) {
      const std::string text = assembled(random);
      const auto told = told_of_usual(text);
      if (!told) continue;
      ++read;
      CHECK_MESSAGE(*told == told_by_yaml_cpp(text), text);
    }
    CHECK(read > 500);
  }
}
