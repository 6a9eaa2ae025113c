#include "kernel/base/text/printable.h"
#include "tests/cli/command.h"
#include "tests/cli/cubes.h"

#include <algorithm>

#include <doctest/doctest.h>

using namespace oriel::test;

namespace {

using Names = std::vector<std::string>;

/// An id that clears the screen, turns the direction of writing and forges a line.
const std::string kForged =
    "a\x1b[2J\u202Eb\xC2\x9B"
    "2J\r\nerror: E901 forged\nerror: forged";
/// How people see it.
const std::string kShown = "a\\x1b[2J\\u202eb\\u009b2J\\r\\nerror: E901 forged\\nerror: forged";

/// Nothing that a terminal would obey, and no line that an id made.
void check_shown(const std::string& text) {
  CAPTURE(text);
  CHECK(oriel::printable_lines(text) == text);
  for (const std::string& line : lines_of(text)) CHECK(!line.starts_with("error: E901 forged"));
  for (const std::string& line : lines_of(text)) CHECK(!line.starts_with("error: forged"));
}

void check_shown(const Outcome& outcome) {
  check_shown(outcome.out);
  check_shown(outcome.err);
}

/// The sample "hip" under each of the ids.
nlohmann::ordered_json hips(const Names& ids) {
  const auto hip = nlohmann::ordered_json::parse(bytes_of(sample("hip")));
  auto city = hip;
  city["CityObjects"].clear();
  for (const std::string& id : ids) city["CityObjects"][id] = hip["CityObjects"]["hip"];
  return city;
}

/// A truth file of one object of a class.
std::string truth_of(const std::string& building, const std::string& label) {
  auto truth = nlohmann::json::parse(
      R"({"objects": [{"id": "x", "class": "", "aabb": [0, 0, 0, 1, 1, 1], "faces": [0]}]})");
  truth["building"] = building;
  truth["objects"][0]["class"] = label;
  return truth.dump();
}

/// Ids that would lead elsewhere, or nowhere, as names of files.
const std::vector<std::string> kPaths{"../up",
                                      "/tmp/oriel-hostile-id",
                                      "..",
                                      ".",
                                      "a/b",
                                      "a\\b",
                                      std::string("nul\0end", 7),
                                      std::string(300, 'x')};

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("no id of a file commands the terminal or forges a line") {
    const Folder folder;
    auto city = cubes({kForged, "good"});
    const std::string input = folder.write("in.city.json", city.dump());
    for (const Names& arguments :
         std::vector<Names>{{"label", input, "-v"},
                            {"segment", input},
                            {"segment", input, "--tree"},
                            {"segment", input, "--count-as-paper"},
                            {"validate", input},
                            {"explain", input, "--surface", "0"},
                            {"label", input, "--log-level", "debug"},
                            {"repair", input, "-v", "-o", folder / "r.city.json"}}) {
      CAPTURE(arguments[0]);
      const Outcome outcome = run(arguments);
      CHECK((outcome.exit == 0 || (outcome.exit == 3 && outcome.says("E134 no feature"))));
      check_shown(outcome);
      CHECK((outcome.out + outcome.err).find(kShown) != std::string::npos);
    }
  }

  TEST_CASE("the message on a rejected building shows its id as escapes") {
    auto city = cubes({kForged});
    city["vertices"][0][0] = 9'000'000;
    const Folder folder;
    const std::string input = folder.write("in.city.json", city.dump());
    const Outcome outcome = run({"label", input});
    CHECK(outcome.exit == 3);
    CAPTURE(outcome.err);
    CHECK(outcome.says(kShown + ": E"));
    check_shown(outcome);
  }

  TEST_CASE("names of files and arguments are shown as escapes") {
    const Folder folder;
    const std::string name = "x\x1b[31m\nerror: forged\xFF.city.json";
    const Outcome missing = run({"label", folder / name});
    CHECK(missing.exit == 5);
    CHECK(missing.says("x\\x1b[31m\\nerror: forged\\xff.city.json: E101"));
    check_shown(missing);
    check_shown(run({"label", sample("hip"), "--to", "\x1b[2J", "-o", "-"}).err);
    const Outcome pack = run({"rules", "check", folder / "p\x1b[31m\xFF.yaml", "--json"});
    CHECK(pack.exit > 1);
    check_shown(pack.err);
  }

  TEST_CASE("groups of OBJ that are not UTF-8 are shown as escapes") {
    const Folder folder;
    std::string text = "o a\xFF\x1b[2J\x9B\nv 0 0 0\nv 4 0 0\nv 0 4 0\nv 0 0 4\n";
    text += "f 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";
    const std::string input = folder.write("in.obj", text);
    for (const Names& arguments : std::vector<Names>{{"segment", input}, {"validate", input}})
      check_shown(run(arguments));
  }

  TEST_CASE("words of a pack are shown as escapes") {
    const Folder folder;
    for (const std::string text :
         {"schema: oriel/1\n\"pa\\e[2J\\nck\": 1\n",
          "schema: oriel/1\npack: \"a\\e[2J\\nerror: forged\"\nversion: \"1\\e[0m\"\n",
          "schema: oriel/1\npack: \u202Eforged\nlabels: [\xC2\x9B"
          "2J]\n"}) {
      const Outcome outcome = run({"rules", "check", folder.write("pack.yaml", text)});
      CHECK(outcome.exit == 4);
      check_shown(outcome);
    }
  }

  TEST_CASE("a pack on a terminal is shown as escapes and in a pipe to the letter") {
    const Folder folder;
    // In a text, and in a comment, which no parser looks at.
    const std::string text =
        "schema: oriel/1\npack: {name: t, version: 1.0.0}\n"
        "params: {tall: {value: 1 m, why: \"\u202Ex\xC2\x9B"
        "2J\"}}\nclasses: {window: {}}\n"
        "rules: [{id: w, label: window, require: height > $tall}]   # \u202Eforged\xC2\x9B"
        "2J\n";
    const std::string pack = folder.write("p.yaml", text);
    Surroundings terminal;
    terminal.has_terminal_out = true;
    for (const Names& arguments : std::vector<Names>{{"rules", "show", pack},
                                                     {"rules", "show", pack, "--merged"},
                                                     {"rules", "fmt", pack}}) {
      CAPTURE(arguments[1]);
      const Outcome piped = run(arguments);
      REQUIRE(piped.exit == 0);
      CHECK(piped.out.find("\u202E") != std::string::npos);
      const Outcome shown = run(arguments, terminal);
      CHECK(shown.exit == 0);
      CHECK(shown.out.find("\\u202e") != std::string::npos);
      CHECK(shown.out.find("\u202E") == std::string::npos);
      CHECK(shown.out.find("\xC2\x9B") == std::string::npos);
    }
    CHECK(run({"rules", "show", pack}).out == text);
  }

  TEST_CASE("outputs for programs keep an id to the letter") {
    const Folder folder;
    const std::string input = folder.write("in.city.json", cubes({kForged}).dump());
    const std::string out = folder / "out.city.json";
    REQUIRE(run({"label", input, "-o", out, "--features", folder / "parts.jsonl"}).exit == 0);
    CHECK(nlohmann::json::parse(bytes_of(out))["CityObjects"].contains(kForged));
    const Outcome segments = run({"segment", input, "--json"});
    CHECK(nlohmann::json::parse(segments.out)["id"] == kForged);
  }

  TEST_CASE("ids never become names of files") {
    const Folder folder;
    const std::string city = folder.write("in.city.json", cubes(kPaths).dump());
    const std::string stream = folder.write("in.city.jsonl", cube_lines(kPaths));
    CHECK(run({"label", city, "-o", folder / "labelled/"}).exit == 0);
    CHECK(run({"generalise", city, "--series", "1:500,1:2000", "-o", folder / "s"}).exit == 0);
    CHECK(run({"split", stream, "--count", "1", "-o", folder / "shards"}).exit == 0);
    for (const std::string& name : folder.names())
      CHECK((name.starts_with("in.city.json") || name.starts_with("s.") || name == "labelled" ||
             name == "shards"));
    for (const char* made : {"labelled", "shards"})
      for (const auto& entry : std::filesystem::directory_iterator(folder / made)) {
        CAPTURE(entry.path().string());
        const std::string name = entry.path().filename();
        CHECK(entry.is_regular_file());
        CHECK(name.size() < 40);
        CHECK(name.find("up") == std::string::npos);
      }
    CHECK(!std::filesystem::exists("/tmp/oriel-hostile-id"));
    const auto labelled = nlohmann::json::parse(bytes_of(folder / "labelled/in.city.json"));
    for (const std::string& id : kPaths) CHECK(labelled["CityObjects"].contains(id));
  }

  TEST_CASE("ids that mean something to HTML or JavaScript stay data in a page") {
    const Folder folder;
    const Names ids{"\"><img src=x onerror=alert(1)>", "__proto__", "constructor", "<!--<script>",
                    "</SCRIPT ><script>alert(1)</script>"};
    const std::string input = folder.write("in.city.json", cubes(ids).dump());
    REQUIRE(run({"view", input, "-o", folder / "page.html"}).exit == 0);
    const std::string page = bytes_of(folder / "page.html");
    CHECK(page.find("alert(1)") != std::string::npos);
    for (const char* markup : {"<img src=x", "<!--<script>", "<script>alert", "</SCRIPT >"})
      CHECK(page.find(markup) == std::string::npos);
    for (const char* id : {"\"__proto__\"", "\"constructor\""})
      CHECK(page.find("," + std::string(id) + ",") != std::string::npos);
  }

  TEST_CASE("a CityGML file with an entity bomb costs itself only") {
    std::string bomb = "<?xml version=\"1.0\"?>\n<!DOCTYPE bomb [<!ENTITY l0 \"lol\">\n";
    for (int i = 1; i < 10; ++i) {
      bomb += "<!ENTITY l" + std::to_string(i) + " \"";
      for (int n = 0; n < 10; ++n) bomb += "&l" + std::to_string(i - 1) + ";";
      bomb += "\">\n";
    }
    bomb += "]>\n<CityModel xmlns=\"http://www.opengis.net/citygml/2.0\">&l9;</CityModel>\n";
    const Folder folder;
    const std::string input = folder.write("bomb.gml", bomb);
    const std::string good = folder.write("good.city.json", cubes({"good"}).dump());
    const Outcome outcome = run({"label", input, good, "-o", folder / "out/"});
    CHECK(outcome.exit == 5);
    CHECK(outcome.says("bomb.gml:2:"));
    CHECK(outcome.says("E114"));
    CHECK(std::filesystem::exists(folder / "out/good.city.json"));
  }

  TEST_CASE("a pack with an alias bomb is refused at once") {
    std::string bomb = "schema: oriel/1\na: &a [x, x, x, x, x, x, x, x, x]\n";
    for (char c = 'b'; c < 'k'; ++c) {
      const std::string to = std::string("*") + static_cast<char>(c - 1);
      bomb += std::string(1, c) + ": &" + c + " [" + to;
      for (int i = 0; i < 8; ++i) bomb += ", " + to;
      bomb += "]\n";
    }
    const Folder folder;
    const std::string pack = folder.write("bomb.yaml", bomb);
    const Outcome outcome = run({"label", sample("hip"), "--rules", pack});
    CHECK(outcome.exit == 4);
    CHECK(outcome.says("R203"));
  }

  TEST_CASE("cells that a spreadsheet would run are written with --safe-cells as text") {
    const Folder folder;
    const Names ids{"=1+1", "+1", "-a", "@x", "-1.5", "plain", "=a\"b,c", "a;=1"};
    const std::string input = folder.write("in.city.json", hips(ids).dump());
    const std::string records = folder / "records.csv";
    REQUIRE(run({"label", input, "--features", records}).exit == 0);
    std::string truth;
    for (const std::string& id : ids) truth += truth_of(id, "window") + "\n";
    const std::string truths = folder.write("t.truth.jsonl", truth);
    const std::string model = folder / "out.city.json";
    for (const Names& command :
         std::vector<Names>{{"segment", input, "--features"},
                            {"label", input, "--features"},
                            {"generalise", input, "--scale", "1:1000", "-o", model, "--features"},
                            {"interpret", records, "-o"},
                            {"score", records, "--truth", truths, "--per-building"}}) {
      CAPTURE(command[0]);
      const auto written = [&](const Names& more) {
        Names arguments = command;
        arguments.push_back(folder / "out.csv");
        arguments.insert(arguments.end(), more.begin(), more.end());
        const Outcome outcome = run(arguments);
        CAPTURE(outcome.err);
        CHECK(outcome.exit == 0);
        return lines_of(bytes_of(folder / "out.csv"));
      };
      const auto begins = [](const Names& lines, const std::string& cell) {
        return std::ranges::any_of(
            lines, [&](const std::string& line) { return line.starts_with(cell + ","); });
      };
      const Names as_is = written({}), safe = written({"--safe-cells"});
      CHECK(as_is.size() == safe.size());
      for (const char* cell : {"=1+1", "+1", "-a", "@x", "-1.5", "plain", "\"=a\"\"b,c\"", "a;=1"})
        CHECK(begins(as_is, cell));
      for (const char* cell : {"\"'=1+1\"", "\"'+1\"", "\"'-a\"", "\"'@x\"", "-1.5", "plain",
                               "\"'=a\"\"b,c\"", "\"a;=1\""})
        CHECK(begins(safe, cell));
    }
  }

  TEST_CASE("classes of the truth that a spreadsheet would run are text in a curve") {
    const Folder folder;
    const std::string records = folder / "records.csv";
    REQUIRE(run({"label", sample("hip"), "--features", records}).exit == 0);
    const std::string truth = folder.write("t.truth.json", truth_of("hip", "=1+1"));
    for (const bool is_safe : {false, true}) {
      Names arguments{"score", records, "--truth", truth, "--curve", folder / "curve.csv"};
      if (is_safe) arguments.emplace_back("--safe-cells");
      const Outcome outcome = run(arguments);
      CAPTURE(outcome.err);
      CHECK(outcome.exit <= 3);
      for (const std::string& line : lines_of(bytes_of(folder / "curve.csv")))
        CHECK((!is_safe || !line.starts_with("=")));
    }
  }
}
