#include "tests/cli/command.h"
#include "tests/cli/cubes.h"
#include "tests/cli/json_lines.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <utility>

#include <doctest/doctest.h>

using namespace oriel::test;
using nlohmann::json;

namespace {

using Names = std::vector<std::string>;

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("stdin goes to stdout as a file goes to a file") {
    const Folder folder;
    const Outcome piped =
        run({"label", "-", "--from", "cityjson", "-o", "-"}, {.in = bytes_of(sample("house"))});
    CHECK(piped.exit == 0);
    CHECK(run({"label", sample("house"), "-o", folder / "out.city.json"}).exit == 0);
    CHECK(piped.out == bytes_of(folder / "out.city.json"));
    CHECK(json::accept(piped.out));
    CHECK(piped.err.starts_with("1 of 1 building labelled: "));
  }

  TEST_CASE("a stream goes from stdin to stdout line by line") {
    const Outcome outcome =
        run({"label", "-", "--from", "cityjsonseq", "-o", "-"}, {.in = cube_lines({"a", "b"})});
    CHECK(outcome.exit == 0);
    const auto lines = json_lines(outcome.out);
    REQUIRE(lines.size() == 3);
    CHECK(lines[0]["type"] == "CityJSON");
    CHECK(lines[2]["CityObjects"]["b"]["attributes"].contains("oriel_pack"));
  }

  TEST_CASE("messages stand on stderr only and data on stdout only") {
    auto city = cubes({"a", "b"});
    city["vertices"][8][0] = 9'000'000;
    const Folder folder;
    const std::string input = folder.write("in.city.json", city.dump());
    const Outcome listed = run({"label", input});
    CHECK(listed.exit == 3);
    CHECK(listed.out.starts_with("a: 0 of "));
    CHECK(listed.out.find("E501") == std::string::npos);
    CHECK(listed.err.starts_with("error: "));
    CHECK(listed.says("b: E501 "));
    const Outcome written = run({"label", input, "-o", folder / "out.city.json"});
    CHECK(written.out.empty());
    CHECK(written.err == listed.err);
  }

  TEST_CASE("there are no colours and no progress in a file") {
    auto city = cubes({"a", "b"});
    city["vertices"][8][0] = 9'000'000;
    const Surroundings piped{.in = city.dump()};
    CHECK(run({"label", "-", "--from", "cityjson"}, piped).err.find('\033') == std::string::npos);
  }

  TEST_CASE("a terminal gets colours unless NO_COLOR is set") {
    auto city = cubes({"a", "b"});
    city["vertices"][8][0] = 9'000'000;
    Surroundings terminal{.in = city.dump(), .has_terminal = true};
    terminal.environment = {"NO_COLOR="};
    CHECK(run({"label", "-", "--from", "cityjson"}, terminal).says("\033[31merror\033[0m: "));
    terminal.environment = {"NO_COLOR=1"};
    CHECK(run({"label", "-", "--from", "cityjson"}, terminal).says("b: E501"));
  }

  TEST_CASE("a terminal gets a table with rates and other places one line") {
    const Surroundings piped{.in = cube_lines({"a", "b", "c"})},
        terminal{.in = piped.in, .has_terminal = true};
    const Names label{"label", "-", "-o", "-"};
    CHECK(run(label, piped).err.ends_with("\n3 of 3 buildings labelled\n"));
    const Outcome shown = run(label, terminal);
    CHECK(shown.out == run(label, piped).out);
    CHECK(shown.says("buildings      3"));
    CHECK(shown.says("rejected       0"));
    CHECK(shown.says("buildings/s"));
    CHECK(shown.says("MB/s"));
    Names none = label;
    none.insert(none.end(), {"--progress", "none"});
    CHECK(run(none, terminal).says("3 of 3 buildings labelled"));
    CHECK(!run(none, terminal).says("MB/s"));
  }

  TEST_CASE("progress for machines is a JSON object a line on stderr") {
    const Folder folder;
    const std::string broken = cube_lines({"a", "b"}) + "{\n",
                      input = folder.write("in.city.jsonl", broken);
    const Outcome outcome = run({"label", input, "-o", "-", "--progress", "json"});
    CHECK(outcome.exit == 3);
    const std::size_t at = outcome.err.find("{\"buildings\"");
    REQUIRE(at != std::string::npos);
    const auto last =
        nlohmann::json::parse(outcome.err.substr(at, outcome.err.find('\n', at) - at));
    CHECK(last["buildings"] == 3);
    CHECK(last["set_aside"] == 1);
    CHECK(last["bytes"] == broken.size());
    CHECK(last["all_bytes"] == broken.size());
    CHECK(last["seconds_left"] == 0);
    CHECK(last["is_done"] == true);
    CHECK(run({"label", input, "--progress", "loud"}).exit == 2);
  }

  TEST_CASE("the cells of segment --json sum up to the volume of the solid") {
    for (const std::string name : {"house", "block", "hip", "l-house", "row"}) {
      CAPTURE(name);
      const Outcome outcome = run({"segment", sample(name), "--json"});
      CHECK(outcome.exit == 0);
      const json found = json::parse(outcome.out);
      double sum = 0;
      for (const json& cell : found["cells"])
        sum += cell["sign"].get<int>() * cell["volume_m3"].get<double>();
      std::string truth_file = sample(name);
      truth_file.replace(truth_file.find(".stripped"), std::string::npos, ".truth.json");
      const json truth = json::parse(bytes_of(truth_file));
      // The truth is written to 1e-4 m3.
      CHECK(std::abs(sum - truth["shell"]["volume"].get<double>()) <= 1e-4);
      CHECK(found["order"] == "natural");
      CHECK(found["nodes"][found["root"].get<std::size_t>()].contains("kind"));
    }
  }

  TEST_CASE("the faces of segment --faces have a cell on either side and close around the solid") {
    const Outcome outcome = run({"segment", sample("house"), "--json", "--faces"});
    CHECK(outcome.exit == 0);
    const json found = json::parse(outcome.out);
    const auto is_solid = [&](const json& cell) {
      return !cell.is_null() && found["cells"][cell.get<std::size_t>()]["sign"] == 1;
    };
    double volume = 0, solid_volume = 0;
    std::map<std::pair<json, json>, double> areas;
    for (const json& face : found["faces"]) {
      CHECK(face["front"] != face["behind"]);
      for (const json& loop : face["loops"])
        for (const json& v : loop) CHECK(v < found["vertices"].size());
      const double area = face["area_m2"];
      const double offset = found["planes"][face["plane"].get<std::size_t>()]["offset_m"];
      if (is_solid(face["behind"])) volume += area * offset / 3;
      if (is_solid(face["front"])) volume -= area * offset / 3;
      for (const auto& [p, q] :
           {std::pair{face["front"], face["behind"]}, std::pair{face["behind"], face["front"]}})
        areas[{p, q}] += area;
    }
    for (const json& cell : found["cells"])
      solid_volume += cell["sign"].get<double>() * cell["volume_m3"].get<double>();
    CHECK(std::abs(volume / solid_volume - 1) < 1e-9);
    CHECK(2 * found["contacts"].size() == areas.size());
    for (const json& contact : found["contacts"])
      CHECK(std::abs(areas.at({contact["cell"], contact["neighbour"]}) -
                     contact["area_m2"].get<double>()) < 1e-9);
    CHECK(found["open_edges"] == 0);
  }

  TEST_CASE("segment --faces needs --json") {
    CHECK(run({"segment", sample("hip"), "--faces"}).exit == 2);
  }

  TEST_CASE("segment --json has one building on each line") {
    const Folder folder;
    const std::string input = folder.write("in.city.json", cubes({"a", "b", "c"}).dump());
    const auto lines = json_lines(run({"segment", input, sample("hip"), "--json"}).out);
    REQUIRE(lines.size() == 4);
    CHECK(lines[0]["id"] == "a");
    CHECK(lines[2]["id"] == "c");
    CHECK(lines[3]["id"] == "hip");
    // Cubes are one cell of 64 m3.
    CHECK(lines[1]["cells"].size() == 1);
    CHECK(std::abs(lines[1]["cells"][0]["volume_m3"].get<double>() / 64 - 1) <= 1e-9);
  }

  TEST_CASE("the same input gives the same bytes") {
    for (const Names& arguments :
         {Names{"segment", sample("house"), "--json"}, Names{"label", sample("house"), "-o", "-"},
          Names{"generalise", sample("house"), "--scale", "1:5000", "-o", "-"}}) {
      const Outcome first = run(arguments), second = run(arguments);
      CHECK(first.exit == 0);
      CHECK(first.out == second.out);
      CHECK(first.err == second.err);
    }
  }

  TEST_CASE("ids do not depend on the order of polygons") {
    json city = json::parse(bytes_of(sample("house")));
    json& shell = city["CityObjects"]["house"]["geometry"][0]["boundaries"][0];
    const auto ids_of = [](const json& of) {
      const Outcome outcome =
          run({"segment", "-", "--from", "cityjson", "--json"}, {.in = of.dump()});
      CHECK(outcome.exit == 0);
      std::vector<std::string> ids;
      const json found = json::parse(outcome.out);
      for (const json& feature : found["features"]) ids.push_back(feature["id"]);
      std::ranges::sort(ids);
      return ids;
    };
    const auto ids = ids_of(city);
    CHECK(ids.size() == 53);
    json reversed = json::array();
    for (auto it = shell.rbegin(); it != shell.rend(); ++it) reversed.push_back(*it);
    shell = reversed;
    CHECK(ids_of(city) == ids);
  }

  TEST_CASE("--repeat writes the output once and the timings as JSON") {
    const Folder folder;
    for (const Names& command :
         {Names{"label", sample("hip")}, Names{"label", sample("hip"), "-o", "-"},
          Names{"segment", sample("hip"), "--json"}, Names{"segment", sample("hip")},
          Names{"explain", sample("hip"), "f", "--json"},
          Names{"generalise", sample("hip"), "--scale", "1:5000", "-o", "-"}}) {
      CAPTURE(command[0]);
      const Outcome once = run(command);
      Names repeated = command;
      repeated.insert(repeated.end(), {"--repeat", "3", "--timings", folder / "t.json"});
      const Outcome outcome = run(repeated);
      CHECK(outcome.exit == once.exit);
      CHECK(outcome.out == once.out);
      CHECK(outcome.err == once.err);
      const json timings = json::parse(bytes_of(folder / "t.json"));
      CHECK(timings["runs"] == 3);
      CHECK(timings["segment_ms"].get<double>() >= 0);
    }
    CHECK(run({"segment", sample("hip"), "--features", folder / "a.csv"}).exit == 0);
    CHECK(run({"segment", sample("hip"), "--features", folder / "b.csv", "--repeat", "3"}).exit ==
          0);
    CHECK(bytes_of(folder / "a.csv") == bytes_of(folder / "b.csv"));
  }
}
