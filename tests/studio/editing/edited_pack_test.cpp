#include "tests/studio/editing/marked_text.h"

#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>

using namespace oriel;
using namespace oriel::test;

namespace {

std::string marked(std::string text, const std::string& word, std::size_t nth = 0) {
  std::size_t at = text.find(word);
  while (nth-- > 0) at = text.find(word, at + 1);
  return text.insert(at + 1, "|");
}

std::string hovered(const std::string& text, const std::string& word, std::size_t nth = 0) {
  const MarkedText at(marked(text, word, nth));
  const auto hover = at.pack().hover(at.offset);
  if (!hover) return "";
  CHECK(at.text.substr(hover->where.begin, hover->where.end - hover->where.begin) == word);
  return hover->text;
}

std::string stated(const std::string& text, const std::string& word, std::size_t nth = 0) {
  const MarkedText at(marked(text, word, nth));
  const auto place = at.pack().definition(at.offset);
  if (!place) return "";
  return (place->is_here ? "here" : place->file) + ":" + std::to_string(place->begin.line);
}

std::string renamed(const std::string& text, const std::string& word, const std::string& name,
                    std::size_t nth = 0) {
  const MarkedText at(marked(text, word, nth));
  const EditedPack pack = at.pack();
  const Renaming renaming = pack.rename(at.offset, name);
  CHECK(pack.renameable(at.offset).has_value());
  if (!renaming.refusal.empty()) return renaming.refusal;
  return with_edits(at.text, renaming.files.front().edits);
}

std::string file_text(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary) << text;
}

}  // namespace

TEST_SUITE("studio/editing") {
  TEST_CASE("the sample of these tests is a pack without faults") {
    const EditedPack pack(kTown, "town.yaml");
    for (const TextFinding& finding : pack.findings()) CAPTURE(finding.sentence);
    CHECK(pack.rules());
  }

  TEST_CASE("a word under the pointer says what it means") {
    CHECK(hovered(kTown, "sill", 1) == "sill: param, 0.9 m in 0.6 m .. 1.1 m\nas high as a table");
    CHECK(hovered(kTown, "cut_in", 1) == "cut_in: macro\nsense in [hole, imprint]");
    CHECK(hovered(kTown, "window").find("window: class, is opening") == 0);
    CHECK(hovered(kTown, "base_height").find("base_height: attribute, m") == 0);
    CHECK(hovered(kTown, "exists").find("exists: function") == 0);
    CHECK(hovered(kTown, "imprint").find("imprint: value of sense") == 0);
    CHECK(hovered(kTown, "close", 1).find("close: relation, within same storey") == 0);
    CHECK(hovered(kTown, "unless").find("unless: vetoes") == 0);
    CHECK(hovered(kTown, "omit", 1).find("omit: operator") == 0);
    CHECK(hovered(kTown, "mm@map").find("mm@map: unit") == 0);
    CHECK(hovered("extends: residential\nrules: [{id: a, label: x, require: width < $parapet}]",
                  "parapet")
              .find("stated in residential.yaml:") != std::string::npos);
  }

  TEST_CASE("a name leads to where it is stated") {
    CHECK(stated(kTown, "sill", 1) == "here:4");
    CHECK(stated(kTown, "cut_in", 1) == "here:11");
    CHECK(stated(kTown, "opening", 1) == "here:7");
    CHECK(stated(kTown, "close", 1) == "here:13");
    CHECK(stated("extends: residential\nemit: {chimney: {}}", "chimney")
              .starts_with("residential.yaml:"));
    CHECK(stated("extends: residential\n", "residential") == "residential.yaml:1");
    CHECK(stated(kTown, "width").empty());
  }

  TEST_CASE("a name is found on a line that cannot be read") {
    const std::string text = kTown + "  - {id: b, for: window, when: \"width < $wide\n";
    CHECK(stated(text, "wide", 2) == "here:5");
  }

  TEST_CASE("a param is renamed wherever it stands") {
    std::string text = kTown + "# compare $sill with $sill_of_others\n";
    const std::string after = renamed(text, "sill", "parapet", 1);
    CHECK(after.find("$sill ") == std::string::npos);
    CHECK(after.find("  parapet: {value") != std::string::npos);
    CHECK(after.find("base_height >= $parapet") != std::string::npos);
    CHECK(after.find("# compare $parapet with $sill_of_others") != std::string::npos);
    CHECK(load_pack(after, "town.yaml").value);
    CHECK(renamed(after, "parapet", "sill") == text);
  }

  TEST_CASE("classes, macros, relations and rules are renamed wherever they stand") {
    for (const auto& [word, name] :
         std::vector<std::pair<std::string, std::string>>{{"opening", "gap_in_wall"},
                                                          {"window", "light"},
                                                          {"cut_in", "recessed"},
                                                          {"close", "nearby"},
                                                          {"row", "strip"},
                                                          {"door.low", "door.ground"}}) {
      CAPTURE(word);
      const std::size_t nth = word == "opening" ? 1 : 0;
      const std::string after = renamed(kTown, word, name, nth);
      CHECK(load_pack(after, "town.yaml").value);
      CHECK(after.size() != kTown.size());
    }
  }

  TEST_CASE("what cannot be renamed says why") {
    CHECK(renamed(kTown, "sill", "wide") == "there is a param 'wide' already");
    CHECK(renamed(kTown, "sill", "Two Words").find("cannot be called") != std::string::npos);
    CHECK(renamed(kTown, "cut_in", "width") == "there is an attribute 'width'");
    const MarkedText at("extends: residential\nemit: {chi|mney: {}}");
    CHECK(at.pack().rename(at.offset, "stack_of_bricks").refusal ==
          "'chimney' is stated in residential.yaml: rename it there");
    CHECK_FALSE(at.pack().renameable(at.offset));
  }

  TEST_CASE("tests next to the pack are renamed with it") {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / "oriel_edited_pack_test";
    std::filesystem::create_directories(folder);
    write_text(folder / "town.yaml", kTown);
    write_text(folder / "town.test.yaml",
               "tests_for: town.yaml\nfixtures:\n  front: {features: {w: {base_height: $sill}}}\n"
               "tests:\n  - name: w\n    given: front\n    expect: {w: not window}\n"
               "    because: {window.high: 'fails at \"base_height >= $sill\"'}\n");
    const MarkedText at(marked(kTown, "sill"));
    const EditedPack pack = at.pack((folder / "town.yaml").string());
    const Renaming renaming = pack.rename(at.offset, "parapet");
    REQUIRE(renaming.files.size() == 2);
    const std::string tests = with_edits(renaming.files[1].text, renaming.files[1].edits);
    CHECK(tests.find("sill") == std::string::npos);
    CHECK(tests.find("base_height >= $parapet") != std::string::npos);
    const MarkedText of_class(marked(kTown, "window"));
    const Renaming classes =
        of_class.pack((folder / "town.yaml").string()).rename(of_class.offset, "light");
    REQUIRE(classes.files.size() == 2);
    const std::string labels = with_edits(classes.files[1].text, classes.files[1].edits);
    CHECK(labels.find("w: not light") != std::string::npos);
    CHECK(labels.find("window.high") != std::string::npos);
    std::filesystem::remove_all(folder);
  }

  TEST_CASE("the outline has every name with its lines") {
    const EditedPack pack(kTown, "town.yaml");
    const auto outline = pack.outline();
    const auto rule = std::ranges::find(outline, "window.high", &OutlineItem::name);
    REQUIRE(rule != outline.end());
    CHECK(rule->kind == "rule");
    CHECK(rule->parent == "window");
    CHECK(pack.places().place(rule->where.begin).line == 18);
    CHECK(pack.places().place(rule->where.end).line == 23);
    const auto window = std::ranges::find(outline, "window", &OutlineItem::name);
    CHECK(window->parent == "opening");
    CHECK(window->section == "classes");
    for (const OutlineItem& item : outline) {
      CHECK(item.where.begin <= item.name_span.begin);
      CHECK(item.name_span.end <= item.where.end);
    }
  }

  TEST_CASE("a pack is formatted as rules fmt does and a broken one is not") {
    const EditedPack pack(kTown, "town.yaml");
    const auto formatted = pack.format();
    REQUIRE(formatted.value);
    CHECK(EditedPack(*formatted.value, "town.yaml").format().value == formatted.value);
    const EditedPack broken(kTown + "rules: {", "town.yaml");
    CHECK_FALSE(broken.format().value);
    CHECK_FALSE(broken.format().issues.empty());
  }

  TEST_CASE("findings have the piece of text that they are about and a fix where one is known") {
    std::string text = kTown;
    text.replace(text.find("width > $wide"), 13, "widht > $wide");
    const EditedPack pack(text, "town.yaml");
    REQUIRE(pack.findings().size() == 1);
    const TextFinding& finding = pack.findings().front();
    CHECK(text.substr(finding.where.begin, finding.where.end - finding.where.begin) == "widht");
    CHECK(finding.code == Code::R204);
    CHECK_FALSE(pack.rules());
    REQUIRE(finding.fixes.size() == 1);
    CHECK(finding.fixes[0].title == "replace 'widht' by 'width'");
    CHECK(with_edits(text, finding.fixes[0].edits) == kTown);
  }

  TEST_CASE("a fault in a pack beneath is shown at extends") {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / "oriel_edited_pack_beneath";
    std::filesystem::create_directories(folder);
    write_text(folder / "base.yaml", "schema: oriel/1\npack: {name: a, version: 1}\nrules: []\n");
    const std::string text =
        "schema: oriel/1\npack: {name: b, version: 1.0.0}\nextends: base.yaml\nrules: []\n"
        "params: {x: {value: }}\n";
    write_text(folder / "top.yaml", text);
    std::string base =
        "schema: oriel/1\npack: {name: base, version: 1.0.0}\nrules:\n"
        "  - {id: a, label: nothing, require: [a > 1 m]}\n";
    const EditedPack pack(text, (folder / "top.yaml").string(),
                          [&](const std::string& path) -> std::optional<std::string> {
                            if (!path.ends_with("base.yaml")) return std::nullopt;
                            return base;
                          });
    const auto at_extends = std::ranges::find_if(pack.findings(), [&](const TextFinding& finding) {
      return text.substr(finding.where.begin, finding.where.end - finding.where.begin) ==
             "base.yaml";
    });
    REQUIRE(at_extends != pack.findings().end());
    CAPTURE(at_extends->sentence);
    CHECK(at_extends->sentence.find("base.yaml:4:20: ") != std::string::npos);
    std::filesystem::remove_all(folder);
  }

  TEST_CASE("every fix that is offered takes its finding away") {
    std::size_t fixes = 0;
    const auto check = [&](const std::string& text) {
      const EditedPack pack(text, "pack.yaml");
      for (const TextFinding& finding : pack.findings())
        for (const QuickFix& fix : finding.fixes) {
          ++fixes;
          CAPTURE(finding.sentence);
          CAPTURE(fix.title);
          const EditedPack mended(with_edits(text, fix.edits), "pack.yaml");
          CHECK(std::ranges::none_of(mended.findings(), [&](const TextFinding& other) {
            return other.sentence == finding.sentence && other.where.begin == finding.where.begin;
          }));
        }
    };
    const std::filesystem::path sources(ORIEL_SOURCE_DIR);
    for (const auto& entry : std::filesystem::directory_iterator(sources / "tests/data/rules"))
      if (entry.path().extension() == ".yaml") check(file_text(entry.path()));
    for (const char* line :
         {"heigth > 1 m", "self is windw", "width > $silll", "exists(closs)", "a == 1 m",
          "a > 1 m && b > 1 m", "self is wall", "sense = hol", "sill > 1 m", "$width > 1 m",
          "window", "slope > 3 deg", "a > 3 metres", "exits(close)"}) {
      std::string text = kTown;
      text.replace(text.find("width > $wide"), 13, line);
      const std::size_t before = fixes;
      check(text);
      CHECK_MESSAGE(fixes > before, std::string(line));
    }
    std::string decimals = kTown;
    decimals.replace(decimals.find("base_height >= $sill"), 20, "base_height >= 1,5 m");
    const std::size_t before = fixes;
    check(decimals);
    CHECK(fixes == before + 1);
    CHECK(fixes > 20);
  }

  TEST_CASE("files of tests have the findings of rules test and profiles theirs") {
    const EditedPack tests("tests_for: residential\ntests: [{name: a, givn: front}]\n",
                           "residential.test.yaml");
    CHECK(tests.kind() == EditedPack::Kind::tests);
    CHECK(std::ranges::any_of(tests.findings(), [](const TextFinding& finding) {
      return finding.sentence == "unknown key 'givn' in a test; did you mean 'given'?" &&
             finding.fixes.size() == 1;
    }));
    const EditedPack profile("schema: oriel-profile/1\nprofile: {name: a}\n", "a.yaml");
    CHECK(profile.kind() == EditedPack::Kind::profile);
    CHECK_FALSE(profile.findings().empty());
    const EditedPack experiment("schema: oriel-experiment/1\nname: a\n", "E.yaml");
    CHECK(experiment.findings().empty());
  }

  TEST_CASE("texts with any damage are answered") {
    std::mt19937 random(7);
    const std::string letters = "{}[]:\"'-#$ \n\txa,|&*\xC3";
    for (int round = 0; round < 150; ++round) {
      std::string text = kTown;
      for (int i = 0; i < 4; ++i) {
        const std::size_t at = random() % text.size();
        if (random() % 2 == 0)
          text[at] = letters[random() % letters.size()];
        else
          text.erase(at, random() % 30);
      }
      const EditedPack pack(text, "town.yaml");
      const std::size_t offset = random() % (text.size() + 1);
      (void)pack.complete(offset);
      (void)pack.hover(offset);
      (void)pack.definition(offset);
      (void)pack.rename(offset, "other_name");
      (void)pack.outline();
      for (const TextFinding& finding : pack.findings()) {
        REQUIRE(finding.where.begin <= finding.where.end);
        REQUIRE(finding.where.end <= text.size());
      }
    }
  }
}
