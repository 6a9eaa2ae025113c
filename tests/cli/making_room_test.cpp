#include "model/building.h"
#include "tests/cli/command.h"
#include "tests/cli/json_lines.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel::test;
using nlohmann::json;

namespace {

/// The file of a building made in code, in millimetres.
std::string crowded_file(const oriel::Building& building) {
  json shell = json::array();
  for (const auto& polygon : building.polygons) shell.push_back(polygon.rings);
  json solid = {{"type", "Solid"}, {"lod", "3"}, {"boundaries", json::array({shell})}};
  json city = {
      {"type", "CityJSON"},
      {"version", "2.0"},
      {"transform", {{"scale", {0.001, 0.001, 0.001}}, {"translate", {0, 0, 0}}}},
      {"CityObjects", {{building.id, {{"type", "Building"}, {"geometry", json::array({solid})}}}}},
      {"vertices", json::array()}};
  for (const oriel::Vec3 p : building.vertices)
    city["vertices"].push_back(
        {std::lround(1000 * p.x), std::lround(1000 * p.y), std::lround(1000 * p.z)});
  return city.dump();
}

/// A door below a ledge with a window to either side, and upstairs a row that fills its wall.
std::string crowded_house() {
  BoxBody body;
  body.add({0, 0, 0}, {10, 8, 6}).remove({4.5, 0, 0}, {5.5, 0.2, 2.2});
  body.add({4.4, -0.1, 2.3}, {5.6, 0, 2.4});
  for (const double x : {3.2, 5.8}) body.remove({x, 0, 1}, {x + 1, 0.2, 2});
  for (int i = 0; i < 6; ++i) body.remove({0.3 + 1.6 * i, 0, 4}, {1.7 + 1.6 * i, 0.2, 5});
  return crowded_file(body.build("house"));
}

constexpr const char* kRoomPack = R"(schema: oriel/1
pack: {name: room, version: 1.0.0}
classes: {opening: {abstract: true}, window: {is: opening}, upper: {is: opening}, door: {is: opening}, ledge: {abstract: true}}
relations:
  near: {within: same_facade, where: abs(along - other.along) <= 0.5 * (width + other.width) and abs(top - other.base_height) <= 0.2 m}
rules:
  - {id: door.any, label: door, require: sense = hole and base_height <= 0.5 m}
  - {id: window.any, label: window, require: sense = hole and base_height > 0.5 m and base_height <= 3 m}
  - {id: upper.any, label: upper, require: sense = hole and base_height > 3 m}
  - {id: ledge.any, label: ledge, require: sense = protrusion and height <= 0.2 m}
generalise:
  - {id: doors.enlarge, scale: "1:1000 ..", for: door, do: {enlarge: {to: 2 m, anchor: sill, gap: 0.3 m}}, with: {by: near, of: ledge}}
  - {id: upper.displace, scale: "1:1000 ..", for: upper, do: {displace: {gap: 0.3 m}}}
)";

}  // namespace

TEST_SUITE("cli") {
  TEST_CASE("what a refusal needs, what was pushed and what went along is explained") {
    const Folder folder;
    const std::string house = folder.write("house.city.json", crowded_house());
    const std::string pack = folder.write("room.yaml", kRoomPack);
    const Outcome made = run({"generalise", house, "--scale", "1:1000", "--rules", pack, "-o",
                              folder / "out.city.json", "--explain", folder / "why.jsonl"});
    CAPTURE(made.err);
    REQUIRE(made.exit == 0);
    CHECK(made.says("G403"));
    std::string door;
    std::map<std::string, int> told;
    const auto lines = lines_of(bytes_of(folder / "why.jsonl"));
    for (const std::string& text : lines)
      if (const json line = json::parse(text); line["label"] == "door") door = line["id"];
    REQUIRE(!door.empty());
    for (const std::string& text : lines) {
      const json line = json::parse(text);
      CHECK(line.contains("needs") == (line["outcome"] == "refused"));
      if (line["outcome"] == "refused") {
        CHECK(line["label"] == "upper");
        REQUIRE(line["needs"].size() == 2);
        CHECK(line["needs"][0]["what"] == "gap");
        CHECK(line["needs"][1] == json({{"what", "count"}, {"less", 1}, {"then", 5}}));
      }
      if (line["label"] != "upper" && line["label"] != "door")
        CHECK(line["rule"] == "doors.enlarge");
      ++told[line["reason"].get<std::string>().substr(0,
                                                      line["reason"].get<std::string>().find(':'))];
    }
    CHECK(told["pushed by " + door] == 2);
    CHECK(told["went along with " + door] == 1);
    CHECK(told["its wall has no room for the row"] == 6);
  }

  TEST_CASE("decor that grows with a door is explained, and its series proves itself") {
    const Folder folder;
    const std::string house = folder.write("house.city.json", crowded_house());
    std::string text = kRoomPack;
    const std::string goes = "of: ledge}";
    text.replace(text.find(goes), goes.size(), "of: ledge, as: grows}");
    const std::string pack = folder.write("room.yaml", text);
    REQUIRE(run({"generalise", house, "--series", "1:500,1:1000,1:5000", "--rules", pack, "-o",
                 folder / "house"})
                .exit == 0);
    REQUIRE(run({"generalise", house, "--scale", "1:1000", "--rules", pack, "-o",
                 folder / "out.city.json", "--explain", folder / "why.jsonl"})
                .exit == 0);
    const json first = json::parse(lines_of(bytes_of(folder / "house.oplog.jsonl")).at(0));
    const std::string door = first["oriel_id"];
    CHECK(first["with"].size() == 3);
    CHECK_FALSE(first.contains("could_not_follow"));
    int grown = 0;
    for (const std::string& line : lines_of(bytes_of(folder / "why.jsonl")))
      if (json::parse(line)["reason"] == "grew with " + door) ++grown;
    CHECK(grown == 1);
    const Outcome check = run({"generalise", "--check", "--from", folder / "house"});
    CAPTURE(check.err);
    CHECK(check.exit == 0);
  }

  TEST_CASE("a series with openings that are pushed and decor that goes along proves itself") {
    const Folder folder;
    const std::string house = folder.write("house.city.json", crowded_house());
    const std::string pack = folder.write("room.yaml", kRoomPack);
    REQUIRE(run({"generalise", house, "--series", "1:500,1:1000,1:5000", "--rules", pack, "-o",
                 folder / "house"})
                .exit == 0);
    const json first = json::parse(lines_of(bytes_of(folder / "house.oplog.jsonl")).at(0));
    CHECK(first["operation"] == "enlarge");
    CHECK(first["with"].size() == 3);
    const Outcome check = run({"generalise", "--check", "--from", folder / "house"});
    CAPTURE(check.err);
    CHECK(check.exit == 0);
  }
}
