#include "tests/cli/command.h"
#include "tests/cli/cubes.h"
#include "tests/cli/json_lines.h"

#include <cmath>
#include <filesystem>
#include <set>
#include <sstream>
#include <string>
#include <utility>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

/// The facets of a building in a CityJSON, as the points of their rings in micrometres.
std::multiset<std::string> facets_of(const json& file, const std::string& building,
                                     const json& header) {
  std::multiset<std::string> facets;
  const json &scale = header["transform"]["scale"], &from = header["transform"]["translate"];
  const json& shells = file["CityObjects"][building]["geometry"][0]["boundaries"];
  for (const json& shell : shells)
    for (const json& polygon : shell) {
      json points;
      for (const json& ring : polygon)
        for (const json& v : ring)
          for (std::size_t i = 0; i < 3; ++i)
            points.push_back(
                std::llround(1e6 * (from[i].get<double>() +
                                    scale[i].get<double>() *
                                        file["vertices"][v.get<std::size_t>()][i].get<double>())));
      facets.insert(points.dump());
    }
  return facets;
}

std::multiset<std::string> facets_in(const std::string& path, const std::string& building) {
  const json file = json::parse(bytes_of(path));
  return facets_of(file, building, file);
}

/// The sample moved, under another id, in millimetres or on a grid of its own.
std::string moved_sample(const std::string& name, const std::string& id, const json& translate) {
  json city = json::parse(bytes_of(sample(name)));
  city["CityObjects"] = {{id, city["CityObjects"][name]}};
  city["transform"]["translate"] = translate;
  return city.dump();
}

std::string header_line(const std::string& out) { return out.substr(0, out.find('\n')); }

}  // namespace

using Words = std::vector<std::string>;

/// A log as it was before its lines had checks.
std::string without_checks(const std::string& log) {
  std::string out;
  for (const std::string& line : lines_of(log))
    if (!line.starts_with("{\"end\":")) out += line.substr(0, line.rfind(",\"check\":")) + "}\n";
  return out;
}

TEST_SUITE("cli") {
  TEST_CASE("a series of several files is one file for each scale and one log") {
    const Folder folder;
    const std::string a = folder.write("a.city.json", moved_sample("block", "a", {0, 0, 0})),
                      b = folder.write("b.city.json", moved_sample("row", "b", {40.0000003, 0, 2}));
    REQUIRE(run({"generalise", a, b, "--series", "1:500,1:10000", "-o", folder / "both"}).exit ==
            0);
    CHECK(folder.names() == std::vector<std::string>{"a.city.json", "b.city.json",
                                                     "both.1-10000.city.json",
                                                     "both.1-500.city.json", "both.oplog.jsonl"});
    REQUIRE(run({"generalise", a, "--series", "1:500,1:10000", "-o", folder / "one"}).exit == 0);
    for (const std::string scale : {"500", "10000"}) {
      const std::string file = ".1-" + scale + ".city.json";
      CHECK(run({"validate", folder / ("both" + file)}).exit == 0);
      CHECK(facets_in(folder / ("both" + file), "a") == facets_in(folder / ("one" + file), "a"));
    }
    CHECK(facets_in(folder / "both.1-500.city.json", "b").size() >
          facets_in(folder / "both.1-10000.city.json", "b").size());
    const std::string log = bytes_of(folder / "both.oplog.jsonl");
    const std::string one = bytes_of(folder / "one.oplog.jsonl");
    CHECK(log.starts_with(one.substr(0, one.find("{\"end\":"))));
    CHECK(log.find("\"building\":\"b\"") != std::string::npos);
    for (const std::string id : {"a", "b"}) {
      const Outcome at = run({"generalise", "--at", "1:500", "--from", folder / "both", "-o",
                              folder / "at.city.json"});
      REQUIRE(at.exit == 0);
      CHECK(facets_in(folder / "at.city.json", id) ==
            facets_in(folder / "both.1-500.city.json", id));
    }
    std::remove((folder / "both.1-500.city.json").c_str());
    REQUIRE(run({"generalise", "--at", "1:2500", "--from", folder / "both", "-o",
                 folder / "between.city.json"})
                .exit == 0);
    CHECK(run({"validate", folder / "between.city.json"}).exit == 0);
  }

  TEST_CASE("files of a series that share an id or a reference system less are told") {
    const Folder folder;
    json other = json::parse(moved_sample("block", "b", {0, 0, 0}));
    other["metadata"] = {{"referenceSystem", "https://www.opengis.net/def/crs/EPSG/0/7415"}};
    const std::string a = folder.write("a.city.json", moved_sample("block", "a", {0, 0, 0})),
                      twin = folder.write("t.city.json", moved_sample("block", "a", {9, 0, 0})),
                      crs = folder.write("c.city.json", other.dump());
    const Outcome twice =
        run({"generalise", a, twin, "--series", "1:5000", "-o", folder / "twice"});
    CHECK(twice.exit == 3);
    CHECK(twice.says("a: E207 an earlier input has a CityObject 'a'"));
    CHECK(facets_in(folder / "twice.1-5000.city.json", "a").size() > 3);
    const Outcome apart = run({"generalise", a, crs, "--series", "1:5000", "-o", folder / "x"});
    CHECK(apart.exit == 5);
    CHECK(apart.says("E116"));
    CHECK(apart.says("they cannot share a file"));
    for (const std::string& name : folder.names()) CHECK(!name.starts_with("x"));
  }

  TEST_CASE("a series of streams is a stream for each scale from which any level is made") {
    const Folder folder;
    const Outcome lines = run({"cat", sample("block"), sample("row")});
    REQUIRE(lines.exit == 0);
    const std::string block = folder.write("block.city.jsonl", run({"cat", sample("block")}).out),
                      row = folder.write("row.city.jsonl", run({"cat", sample("row")}).out);
    REQUIRE(
        run({"generalise", "-", "--series", "1:500,1:5000", "-o", folder / "in"}, {.in = lines.out})
            .exit == 0);
    REQUIRE(run({"generalise", block, row, "--series", "1:500,1:5000", "-o", folder / "two", "-j",
                 "2", "--features", folder / "parts.csv"})
                .exit == 0);
    CHECK(bytes_of(folder / "parts.csv").size() > 1000);
    for (const std::string name : {".1-500.city.jsonl", ".1-5000.city.jsonl", ".oplog.jsonl"}) {
      CHECK(bytes_of(folder / ("two" + name)) == bytes_of(folder / ("in" + name)));
      CHECK(bytes_of(folder / ("two" + name)).size() > 1000);
    }
    const std::string coarse = bytes_of(folder / "in.1-5000.city.jsonl");
    CHECK(header_line(coarse) == header_line(lines.out));
    const auto at = [&](const std::string& scale) {
      const Outcome made = run({"generalise", "--at", scale, "--from", folder / "in", "-o", "-"});
      REQUIRE(made.exit == 0);
      return made.out;
    };
    CHECK(at("1:5000") == coarse);
    const std::string between = at("1:2500");
    CHECK(run({"validate", "-"}, {.in = between}).exit == 0);
    std::remove((folder / "in.1-500.city.jsonl").c_str());
    const auto facets = [](const std::string& text) {
      const auto parsed = json_lines(text);
      REQUIRE(parsed.size() == 3);
      return std::pair(facets_of(parsed[1], "block", parsed[0]),
                       facets_of(parsed[2], "row", parsed[0]));
    };
    CHECK(facets(at("1:2500")) == facets(between));
    CHECK(facets(between) != facets(coarse));
    folder.write("in.1-500.city.json", "{}");
    const Outcome mixed = run({"generalise", "--at", "1:600", "--from", folder / "in", "-o", "-"});
    CHECK(mixed.exit == 5);
    CHECK(mixed.says("G409 has the levels of two series"));
  }

  TEST_CASE("a series of another level of detail than the highest goes both ways") {
    const Folder folder;
    json city = json::parse(bytes_of(sample("house")));
    json& geometries = city["CityObjects"]["house"]["geometry"];
    json finest = geometries[0];
    finest["lod"] = "3.3";
    geometries[0]["lod"] = "2.2";
    geometries.push_back(finest);
    const std::string two = folder.write("two.city.json", city.dump());
    REQUIRE(run({"generalise", two, "--lod", "2.2", "--series", "1:500,1:2500,1:10000", "-o",
                 folder / "s"})
                .exit == 0);
    const auto facets = [&](const std::string& file) { return facets_in(folder / file, "house"); };
    const auto lods = [&](const std::string& file) {
      std::string text;
      const json level = json::parse(bytes_of(folder / file));
      for (const json& geometry : level["CityObjects"]["house"]["geometry"])
        text += geometry["lod"].get<std::string>() + " ";
      return text;
    };
    const auto levels = std::vector{facets("s.1-500.city.json"), facets("s.1-2500.city.json"),
                                    facets("s.1-10000.city.json")};
    CHECK(levels[0].size() > levels[1].size());
    CHECK(levels[1].size() > levels[2].size());
    for (const std::string end : {"500", "10000"}) {
      CAPTURE(end);
      const std::string only = folder / ("only-" + end);
      folder.write("only-" + end + ".oplog.jsonl", bytes_of(folder / "s.oplog.jsonl"));
      folder.write("only-" + end + ".1-" + end + ".city.json",
                   bytes_of(folder / ("s.1-" + end + ".city.json")));
      std::size_t i = 0;
      for (const std::string scale : {"1:500", "1:2500", "1:10000"}) {
        const Outcome at =
            run({"generalise", "--at", scale, "--from", only, "-o", folder / "at.city.json"});
        REQUIRE(at.exit == 0);
        CHECK(facets("at.city.json") == levels[i++]);
        CHECK(lods("at.city.json") == "2.2 3.3 ");
      }
    }
  }

  TEST_CASE("a line of a stream that cannot be drawn stays and the others go on") {
    const Folder folder;
    std::string lines = run({"cat", sample("block")}).out;
    json open = json::parse(lines.substr(lines.find('\n') + 1));
    open["CityObjects"] = {{"open", open["CityObjects"]["block"]}};
    open["id"] = "open";
    open["CityObjects"]["open"]["geometry"][0]["boundaries"][0].erase(0);
    lines += open.dump() + "\n";
    const Outcome made =
        run({"generalise", "-", "--series", "1:500,1:5000", "-o", folder / "s", "--close", "none"},
            {.in = lines});
    CHECK(made.exit == 3);
    CHECK(made.says("open: G404"));
    const auto level = json_lines(bytes_of(folder / "s.1-5000.city.jsonl"));
    REQUIRE(level.size() == 3);
    CHECK((level[2] == open));
    CHECK(run({"generalise", "--at", "1:5000", "--from", folder / "s", "-o", "-"}).out ==
          bytes_of(folder / "s.1-5000.city.jsonl"));
  }

  TEST_CASE("what makes no series is refused with a code") {
    const Folder folder;
    const std::string block = sample("block"), out = folder / "x",
                      stream = folder.write("in.city.jsonl", cube_lines({"a"}));
    using Words = std::vector<std::string>;
    for (const Words& more :
         {Words{stream, "-o", out}, Words{"-o", "-"}, Words{"-o", folder / "f/"},
          Words{"-o", out, "--to", "obj"}, Words{"-o", out, "--explain", folder / "why"},
          Words{"-o", out, "--metrics", folder / "m"},
          Words{"-o", out, "--status", out, "--resume"}, Words{"-o", out, "--isolate"}}) {
      Words words{"generalise", block};
      words.insert(words.end(), more.begin(), more.end());
      words.insert(words.end(), {"--series", "1:500"});
      const Outcome refused = run(words);
      CAPTURE(more.back());
      CHECK(refused.exit == 2);
      CHECK(refused.says("G414 "));
    }
    CHECK(folder.names() == Words{"in.city.jsonl"});
  }

  TEST_CASE("a series is a file for each scale and a log") {
    const Folder folder;
    const Outcome made = run({"generalise", sample("house"), "--series", "1:500,1:10000,1:2500",
                              "-o", folder / "house"});
    REQUIRE(made.exit == 0);
    std::size_t objects = 100;
    for (const char* scale : {"500", "2500", "10000"}) {
      const json city =
          json::parse(bytes_of(folder / (std::string("house.1-") + scale + ".city.json")));
      CHECK(city["CityObjects"].size() <= objects);
      objects = city["CityObjects"].size();
    }
    CHECK(objects == 1);
    std::istringstream lines(bytes_of(folder / "house.oplog.jsonl"));
    double scale = 0;
    int operations = 0;
    for (std::string line; std::getline(lines, line); ++operations) {
      const json operation = json::parse(line);
      CHECK(operation["check"].get<std::string>().size() == 16);
      if (operation.contains("end")) {
        CHECK(operation["end"] == operations);
        CHECK(operation["levels"].size() == 3);
        break;
      }
      for (const char* key : {"building", "oriel_id", "label", "operation", "rule", "scale", "aabb",
                              "forward", "inverse"})
        CHECK(operation.contains(key));
      CHECK(operation["scale"] >= scale);
      scale = operation["scale"];
    }
    CHECK(operations > 30);
    const Outcome at = run({"generalise", "--at", "1:10000", "--from", folder / "house", "-o",
                            folder / "at.city.json"});
    REQUIRE(at.exit == 0);
    CHECK(bytes_of(folder / "at.city.json") == bytes_of(folder / "house.1-10000.city.json"));
  }

  TEST_CASE("a level between is the same from the finer and from the coarser file") {
    const Folder folder;
    REQUIRE(
        run({"generalise", sample("house"), "--series", "1:500,1:10000", "-o", folder / "house"})
            .exit == 0);
    const auto boundaries = [&] {
      const Outcome at =
          run({"generalise", "--at", "1:2500", "--from", folder / "house", "-o", "-"});
      REQUIRE(at.exit == 0);
      const json city = json::parse(at.out);
      std::multiset<std::string> polygons;
      for (const json& polygon : city["CityObjects"]["house"]["geometry"][0]["boundaries"][0]) {
        json points;
        for (const json& ring : polygon)
          for (const json& v : ring) points.push_back(city["vertices"][v.get<std::size_t>()]);
        polygons.insert(points.dump());
      }
      return polygons;
    };
    const auto both = boundaries();
    CHECK(both.size() > 20);
    std::remove((folder / "house.1-500.city.json").c_str());
    CHECK(boundaries() == both);
  }

  TEST_CASE("what is no scale is wrong usage with a code and nothing is written") {
    const Folder folder;
    const std::string out = folder / "x.city.json";
    for (const std::string scale : {"1:0", "0", "1:-5", "0.5", "1:", "1:two", "2:500", "nan"}) {
      CAPTURE(scale);
      for (const Outcome& outcome :
           {run({"generalise", sample("block"), "--scale", scale, "-o", out}),
            run({"generalise", sample("block"), "--series", "1:500," + scale, "-o", out}),
            run({"generalise", "--at", scale, "--from", folder / "x", "-o", out})}) {
        CHECK(outcome.exit == 2);
        CHECK(outcome.says("E125 '" + scale + "' is not a scale"));
      }
    }
    const Outcome twice = run({"generalise", sample("block"), "--series", "1:500,500", "-o", out});
    CHECK(twice.exit == 2);
    CHECK(twice.says("--series: E125 the scale 1:500 is given twice"));
    CHECK(folder.names().empty());
  }

  TEST_CASE("a series that is not there or does not fit is refused") {
    const Folder folder;
    CHECK(run({"generalise", "--at", "1:10", "--from", folder / "none", "-o", "-"}).says("E101"));
    CHECK(run({"generalise", "--at", "1:10", "-o", "-"}).exit == 2);
    CHECK(run({"generalise", "--series", "1:500", "-o", "-"}).exit == 2);
    CHECK(run({"generalise", sample("block"), "--from", "word", "--scale", "1:500", "-o", "-"})
              .exit == 2);
    REQUIRE(run({"generalise", sample("house"), "--series", "1:10000", "-o", folder / "a"}).exit ==
            0);
    REQUIRE(run({"generalise", sample("house"), "--series", "1:500", "-o", folder / "b"}).exit ==
            0);
    std::rename((folder / "b.1-500.city.json").c_str(), (folder / "a.1-10000.city.json").c_str());
    const Outcome wrong = run(
        {"generalise", "--at", "1:500", "--from", folder / "a", "-o", folder / "out.city.json"});
    CHECK(wrong.exit == 5);
    CHECK(wrong.says("E132"));
    CHECK(wrong.says("a.1-10000.city.json"));
    // Of a log without checks the operations themselves show it, as a rule.
    folder.write("a.oplog.jsonl", without_checks(bytes_of(folder / "a.oplog.jsonl")));
    const Outcome unsealed = run(
        {"generalise", "--at", "1:500", "--from", folder / "a", "-o", folder / "out.city.json"});
    CHECK(unsealed.exit == 5);
    CHECK(unsealed.says("G409"));
    CHECK(unsealed.says("E133"));
  }

  TEST_CASE("a series of which a log line or a level was damaged makes no other building") {
    const Folder folder;
    REQUIRE(run({"generalise", sample("house"), "--series", "1:500,1:10000", "-o", folder / "s"})
                .exit == 0);
    const std::string log = bytes_of(folder / "s.oplog.jsonl");
    const std::string level = bytes_of(folder / "s.1-500.city.json");
    const auto at = [&] {
      return run(
          {"generalise", "--at", "1:900", "--from", folder / "s", "-o", folder / "at.city.json"});
    };
    const auto check_refused = [&](const std::string& place) {
      const Outcome outcome = at();
      CAPTURE(outcome.err);
      CHECK(outcome.exit == 5);
      CHECK(outcome.says("E132"));
      CHECK(outcome.says(place));
      CHECK(bytes_of(folder / "at.city.json").empty());
    };
    // Digits all over the log: coordinates, scales, checks.
    for (std::size_t i = 0, n = 0; i < log.size(); ++i) {
      if (log[i] < '0' || log[i] > '8' || n++ % 400 != 0) continue;
      std::string damaged = log;
      ++damaged[i];
      folder.write("s.oplog.jsonl", damaged);
      check_refused("s.oplog.jsonl:");
    }
    const std::size_t second = log.find('\n') + 1, third = log.find('\n', second) + 1;
    for (const std::string& damaged :
         {log.substr(second), log.substr(0, second) + log.substr(third), log.substr(0, third),
          log.substr(0, log.find("{\"end\":")), std::string(), log + log})
      folder.write("s.oplog.jsonl", damaged), check_refused("s.oplog.jsonl");
    folder.write("s.oplog.jsonl", log);
    const std::size_t vertices = level.find_first_of("12345678", level.find("\"vertices\""));
    std::string moved = level;
    ++moved[vertices];
    folder.write("s.1-500.city.json", moved);
    check_refused("s.1-500.city.json");
    folder.write("s.1-500.city.json", level);
    CHECK(at().exit == 0);
  }

  TEST_CASE("a stored series is proved by its log and its levels") {
    const Folder folder;
    REQUIRE(
        run({"generalise", sample("house"), "--series", "1:500,1:2500,1:10000", "-o", folder / "s"})
            .exit == 0);
    const Words check{"generalise", "--check", "--from", folder / "s"};
    const Outcome whole = run(check);
    CHECK(whole.exit == 0);
    CHECK(whole.out.find("3 levels and the log are one series") != std::string::npos);
    CHECK(run({"generalise", "--check", "--from", folder / "s", "-o", "-"}).exit == 2);
    CHECK(run({"generalise", "--check"}).exit == 2);
    CHECK(run({"generalise", sample("house"), "--check", "--from", folder / "s"}).exit == 2);
    const std::string level = bytes_of(folder / "s.1-2500.city.json");
    std::filesystem::remove(folder / "s.1-2500.city.json");
    const Outcome gone = run(check);
    CHECK(gone.exit == 5);
    CHECK(gone.says("E132 was written with a level 1:2500, whose file is gone"));
    // Without checks the operations alone tell that a level is of another building.
    folder.write("s.1-2500.city.json", level);
    folder.write("s.oplog.jsonl", without_checks(bytes_of(folder / "s.oplog.jsonl")));
    CHECK(run(check).exit == 0);
    std::string moved = level;
    ++moved[moved.find_first_of("12345678", moved.find("\"vertices\""))];
    folder.write("s.1-2500.city.json", moved);
    const Outcome other = run(check);
    CHECK(other.exit == 5);
    CHECK(other.says("G409 the log does not lead from the level 1:500 to 1:2500 and back"));
  }

  TEST_CASE("streams are proved record by record") {
    const Folder folder;
    const std::string lines = run({"cat", sample("block"), sample("row")}).out;
    REQUIRE(run({"generalise", "-", "--series", "1:500,1:5000", "-o", folder / "s"}, {.in = lines})
                .exit == 0);
    CHECK(run({"generalise", "--check", "--from", folder / "s"}).exit == 0);
  }

  TEST_CASE("a log of a version without checks is read with a warning") {
    const Folder folder;
    REQUIRE(run({"generalise", sample("house"), "--series", "1:500,1:10000", "-o", folder / "s"})
                .exit == 0);
    const Words at{"generalise", "--at", "1:900", "--from", folder / "s", "-o", "-"};
    const Outcome sealed = run(at);
    CHECK_FALSE(sealed.says("E133"));
    folder.write("s.oplog.jsonl", without_checks(bytes_of(folder / "s.oplog.jsonl")));
    const Outcome old = run(at);
    CHECK(old.exit == 0);
    CHECK(old.says("E133"));
    CHECK(old.out == sealed.out);
  }
}
