#include "interpret/pack/rule_base.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <unistd.h>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

namespace oriel {
namespace {

namespace fs = std::filesystem;

/// A folder of packs, removed at the end.
class Packs {
 public:
  Packs() : folder_(fs::temp_directory_path() / fmt::format("oriel-packs-{}", ::getpid())) {
    fs::create_directories(folder_);
  }
  ~Packs() { fs::remove_all(folder_); }
  Packs(const Packs&) = delete;
  Packs& operator=(const Packs&) = delete;

  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
    return folder_ / name;
  }

 private:
  fs::path folder_;
};

/// The canonical form, which must be its own.
std::string formatted(const std::string& text) {
  const Packs packs;
  const auto once = format_pack_file(packs.write("p.yaml", text));
  REQUIRE(once.value);
  const auto twice = format_pack_file(packs.write("p.yaml", *once.value));
  REQUIRE(twice.value);
  CHECK(*twice.value == *once.value);
  return *once.value;
}

std::vector<std::string> comments_of(const std::string& text) {
  std::vector<std::string> comments;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);)
    if (const auto at = line.find("# "); at != std::string::npos)
      comments.push_back(line.substr(at));
  std::ranges::sort(comments);
  return comments;
}

std::string bytes_of(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

const std::string kHead =
    "schema: oriel/1\npack: {name: t, version: 1.0.0}\nclasses: {window: {}, door: {}}\n";

TEST_SUITE("interpret") {
  TEST_CASE("every pack that loads has one canonical form with all its comments") {
    std::size_t packs = 0;
    for (const char* folder : {"rules", "tests/data/rules", "bench/rules"})
      for (const auto& entry : fs::directory_iterator(fs::path(ORIEL_SOURCE_DIR) / folder)) {
        const std::string path = entry.path();
        if (!path.ends_with(".yaml") || !load_pack_file(path).value) continue;
        CAPTURE(path);
        const std::string text = bytes_of(path);
        CHECK(comments_of(formatted(text)) == comments_of(text));
        ++packs;
      }
    CHECK(packs >= 3);
  }

  TEST_CASE("a pack in canonical form is easy to read") {
    CHECK(formatted(
              "schema:   oriel/1\npack:\n  name: t\n  version: 1.0.0\n\n\n\n"
              "classes: {window: {}, # panes\n  door: }   # leaves\n"
              "# What is named.\nrules: [{id: w, label: window, require: [ \"sense in [hole]\" ],"
              " score: [a: {rise: 0 m .. 1 m}, natural]}]\ndecide:\n    min_score: 0.5\n") ==
          "schema: oriel/1\n"
          "pack: {name: t, version: 1.0.0}\n"
          "\n"
          "classes:\n"
          "  window: {}  # panes\n"
          "  door:  # leaves\n"
          "# What is named.\n"
          "rules:\n"
          "  - id: w\n"
          "    label: window\n"
          "    require: [\"sense in [hole]\"]\n"
          "    score:\n"
          "      - a: {rise: 0 m .. 1 m}\n"
          "      - natural\n"
          "decide: {min_score: 0.5}\n");
  }

  TEST_CASE("quotes and marks in texts are no comments and stay") {
    const std::string text = formatted(
        kHead + "params:\n  p: {value: 1 m, why: \"a # is 'no' comment\"}  # but this is's\n" +
        "  q: {value: 1 m, why: 'say \"it\" #2'}\n  r:\n    value: 1 m\n    why: |\n      two # "
        "lines\n"
        "      of text\nrules:\n  - id: w\n    label: window\n    require: a > $p + $q + $r\n");
    CHECK(text.find("why: \"a # is 'no' comment\"}  # but this is's\n") != std::string::npos);
    CHECK(text.find("why: 'say \"it\" #2'}\n") != std::string::npos);
    CHECK(text.find("why: \"two # lines\\x0aof text\\x0a\"") != std::string::npos);
  }

  TEST_CASE("a pack with errors has no canonical form") {
    const Packs packs;
    const auto wrong = format_pack_file(packs.write("p.yaml", kHead));
    CHECK_FALSE(wrong.value);
    REQUIRE_FALSE(wrong.issues.empty());
    CHECK(wrong.issues[0].code == Code::R210);
    CHECK_FALSE(format_pack_file("/nowhere.yaml").value);
  }

  TEST_CASE("a merged pack stands alone and says what the packs say together") {
    const Packs packs;
    packs.write("base.yaml", kHead +
                                 "params: {p: {value: 1 m, range: 0 m .. 2 m}}\nrules:\n"
                                 "  - {id: w, label: window, require: a > $p}\n"
                                 "  - {id: d, label: door, require: natural}\n");
    const std::string upper =
        packs.write("upper.yaml",
                    "schema: oriel/1\npack: {name: upper, version: 2.0.0}\nextends: base.yaml\n"
                    "params: {p: {value: 1.5 m}}\nrules:\n  - {id: d, remove: true}\n"
                    "  - {id: e, label: door, require: not natural}\n");
    const auto merged = merge_pack_file(upper);
    REQUIRE(merged.value);
    CHECK(merged.value->find("extends") == std::string::npos);
    CHECK(merged.value->find("p: {value: 1.5 m, range: 0 m .. 2 m}") != std::string::npos);
    CHECK(merged.value->find("id: d\n") == std::string::npos);
    const auto alone = load_pack(*merged.value, "alone.yaml");
    CHECK(alone.issues.empty());
    REQUIRE(alone.value);
    CHECK(alone.value->name() == "upper");
    CHECK(alone.value->rule_count() == 2);
    const auto again = merge_pack_file(packs.write("alone.yaml", *merged.value));
    CHECK(again.value == merged.value);
  }

  TEST_CASE("packs that are too long for one when they are merged are refused with their limit") {
    const Packs packs;
    const auto params = [](char first, int count) {
      std::string text = "params:\n";
      for (int i = 0; i < count; ++i)
        text += fmt::format("  {}{}: {{value: 1 m, why: {}}}\n", first, i, std::string(1500, 'x'));
      return text;
    };
    packs.write("base.yaml", kHead + "rules: []\n" + params('a', 400));
    const std::string upper = packs.write(
        "upper.yaml", "schema: oriel/1\npack: {name: upper, version: 2.0.0}\nextends: base.yaml\n" +
                          params('b', 400));
    REQUIRE(load_pack_file(upper).value);
    const auto merged = merge_pack_file(upper);
    CHECK_FALSE(merged.value);
    REQUIRE_FALSE(merged.issues.empty());
    CHECK(to_string(merged.issues.back()) ==
          upper + ": R213 the pack could not be read when printed: a pack is no longer than 1 MiB");
  }

  TEST_CASE("the default pack merged into one is the default pack") {
    const Packs packs;
    const auto whole = merge_pack_file("residential");
    const auto upper =
        merge_pack_file(packs.write("mine.yaml",
                                    "schema: oriel/1\npack: {name: residential, version: 1.0.0}\n"
                                    "extends: residential\n"));
    REQUIRE(whole.value);
    CHECK(whole.value == upper.value);
    CHECK(load_pack(*whole.value, "whole.yaml").value->rule_count() ==
          load_pack_file("residential").value->rule_count());
  }
}

}  // namespace
}  // namespace oriel
