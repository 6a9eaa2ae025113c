#include "oriel/energy.h"

#include "oriel/label.h"
#include "oriel/neighbours.h"
#include "oriel/rules.h"
#include "tests/support/shapes.h"

#include <cmath>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel;
using doctest::Approx;
using nlohmann::json;
using oriel::test::BoxBody;
using oriel::test::building_of;

namespace {

const RuleBase& pack() {
  static const RuleBase rules = load_pack_file("residential").value.value();
  return rules;
}

/// The row of a building in the table of buildings.
json row_of(const Building& building, const LabelOptions& options = {}) {
  const PipelineResult result = label(building, pack(), options);
  return json::parse(energy_rows(EnergyTable::buildings, TableFormat::jsonl,
                                 energy_of(building, result, pack(), options)));
}

/// 10 × 8 × 6 m with a flat roof: three windows of 1.2 × 1.5 m in the south, in two storeys, a door
/// of 1 × 2.1 m in the east, a chimney on the roof.
BoxBody house() {
  BoxBody body;
  body.add({0, 0, 0}, {10, 8, 6});
  body.remove({2, 0, 1}, {3.2, 0.2, 2.5}).remove({6, 0, 1}, {7.2, 0.2, 2.5});
  body.remove({2, 0, 4}, {3.2, 0.2, 5.5});
  body.remove({9.8, 3, 0}, {10, 4, 2.1});
  body.add({4, 4, 6}, {4.6, 4.6, 7.2});
  return body;
}

/// The same turned by a quarter about the z-axis: the south comes to face east.
Building turned(Building building) {
  for (Vec3& p : building.vertices) p = {-p.y, p.x, p.z};
  return building;
}

/// A house whose walls and roof are the same at each x from 0 to 10: its outline at x = 0, from the
/// south's foot over the roof to the north's.
Building extruded(const std::vector<std::pair<double, double>>& outline) {
  std::vector<std::vector<Vec3>> polygons(2);
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const auto [y, z] = outline[i];
    const auto [v, w] = outline[(i + 1) % outline.size()];
    polygons.push_back({{0, y, z}, {10, y, z}, {10, v, w}, {0, v, w}});
    polygons[0].insert(polygons[0].begin(), {10, y, z});
    polygons[1].push_back({0, y, z});
  }
  return building_of(polygons);
}

/// A roof over a rectangle of 12 × 8 m with its eaves at 3 m and its ridge from `from` to `to`.
Building hipped(double from, double to) {
  const Vec3 a{0, 0, 3}, b{12, 0, 3}, c{12, 8, 3}, d{0, 8, 3}, p{from, 4, 6}, q{to, 4, 6};
  const Vec3 e{0, 0, 0}, f{12, 0, 0}, g{12, 8, 0}, h{0, 8, 0};
  std::vector<std::vector<Vec3>> polygons{{h, g, f, e}, {e, f, b, a}, {f, g, c, b}, {g, h, d, c},
                                          {h, e, a, d}, {b, c, q},    {d, a, p}};
  if (from == to) {
    polygons.push_back({a, b, p});
    polygons.push_back({c, d, p});
  } else {
    polygons.push_back({a, b, q, p});
    polygons.push_back({c, d, p, q});
  }
  return building_of(polygons);
}

}  // namespace

TEST_SUITE("oriel") {
  TEST_CASE("the envelope of a house with a flat roof has the areas that it was built with") {
    const json row = row_of(house().build());
    CHECK(row["closed"] == 1);
    CHECK(row["not_separated"] == 0);
    CHECK(row["volume_m3"].get<double>() == Approx(480).epsilon(1e-5));
    CHECK(row["height_m"].get<double>() == Approx(6).epsilon(1e-5));
    const std::map<std::string, double> expected{
        {"envelope_m2", 376}, {"wall_m2", 216},     {"roof_m2", 80},    {"ground_m2", 80},
        {"ceiling_m2", 0},    {"floor_m2", 0},      {"window_m2", 5.4}, {"door_m2", 2.1},
        {"wall_n_m2", 60},    {"wall_e_m2", 48},    {"wall_s_m2", 60},  {"wall_w_m2", 48},
        {"wall_se_m2", 0},    {"window_s_m2", 5.4}, {"window_n_m2", 0}, {"roof_0_10deg_m2", 80}};
    for (const auto& [name, value] : expected) {
      CAPTURE(name);
      CHECK(row[name].get<double>() == Approx(value).epsilon(1e-5));
    }
    CHECK(row["windows"] == 3);
    CHECK(row["windows_s"] == 3);
    CHECK(row["windows_e"] == 0);
    CHECK(row["doors"] == 1);
    CHECK(row["window_to_wall_s"].get<double>() == Approx(0.09).epsilon(1e-5));
    CHECK(row["window_to_wall"].get<double>() == Approx(5.4 / 216).epsilon(1e-5));
    CHECK(row["window_to_wall_se"].is_null());
    CHECK(row["envelope_to_volume_per_m"].get<double>() == Approx(376.0 / 480).epsilon(1e-5));
    CHECK(row["party_wall_m2"].is_null());
    CHECK(row["storeys"] == 2);
    CHECK(row["storeys_source"] == "openings");
    CHECK(row["roof_form"] == "flat");
  }

  TEST_CASE("a house turned by a quarter has its windows in the east") {
    const json row = row_of(turned(house().build()));
    CHECK(row["windows_e"] == 3);
    CHECK(row["window_e_m2"].get<double>() == Approx(5.4).epsilon(1e-5));
    CHECK(row["wall_e_m2"].get<double>() == Approx(60).epsilon(1e-5));
    CHECK(row["windows_s"] == 0);
    CHECK(row["wall_s_m2"].get<double>() == Approx(48).epsilon(1e-5));
  }

  TEST_CASE("roofs have their form and their area by slope and direction") {
    // 3 m up over 4 m: 36.87 degrees, 5 m long.
    const json gabled = row_of(extruded({{0, 0}, {0, 5}, {4, 8}, {8, 5}, {8, 0}}));
    CHECK(gabled["roof_form"] == "gabled");
    CHECK(gabled["roof_30_45deg_s_m2"].get<double>() == Approx(50).epsilon(1e-5));
    CHECK(gabled["roof_30_45deg_n_m2"].get<double>() == Approx(50).epsilon(1e-5));
    CHECK(gabled["roof_m2"].get<double>() == Approx(100).epsilon(1e-5));
    CHECK(gabled["wall_e_m2"].get<double>() == Approx(52).epsilon(1e-5));
    CHECK(gabled["volume_m3"].get<double>() == Approx(520).epsilon(1e-5));
    const json shed = row_of(extruded({{0, 0}, {0, 3}, {8, 5}, {8, 0}}));
    CHECK(shed["roof_form"] == "shed");
    CHECK(shed["roof_10_30deg_s_m2"].get<double>() == Approx(10 * std::sqrt(68.0)).epsilon(1e-5));
    CHECK(row_of(extruded(
              {{0, 0}, {0, 3}, {1, 5.5}, {4, 7}, {7, 5.5}, {8, 3}, {8, 0}}))["roof_form"] ==
          "mansard");
    CHECK(row_of(hipped(4, 8))["roof_form"] == "hipped");
    CHECK(row_of(hipped(6, 6))["roof_form"] == "pyramidal");
    // Two roofs side by side, with a valley between them.
    CHECK(row_of(extruded({{0, 0}, {0, 5}, {2, 7}, {4, 5}, {6, 7}, {8, 5}, {8, 0}}))["roof_form"] ==
          "other");
  }

  TEST_CASE("windows of one storey need not be level") {
    BoxBody body;
    body.add({0, 0, 0}, {12, 8, 9});
    // Two storeys, each with a higher window, and a third one.
    for (const auto& [x, sill] : std::vector<std::pair<double, double>>{
             {1, 1}, {4, 1.75}, {7, 1}, {1, 4}, {4, 4.75}, {1, 7}})
      body.remove({x, 0, sill}, {x + 1.25, 0.25, sill + 1.25});
    const json row = row_of(body.build());
    CHECK(row["windows"] == 6);
    CHECK(row["storeys"] == 3);
  }

  TEST_CASE("a party wall is no part of the envelope where neighbours are known") {
    const Building own = BoxBody().add({0, 0, 0}, {10, 8, 6}).build("own"),
                   other = BoxBody().add({10, 0, 0}, {15, 8, 3}).build("other");
    auto search = std::make_shared<NeighbourSearch>();
    search->add(own);
    search->add(other);
    search->finish();
    LabelOptions options;
    options.neighbours = search;
    const json row = row_of(own, options);
    CHECK(row["party_wall_m2"].get<double>() == Approx(24).epsilon(1e-5));
    CHECK(row["wall_e_m2"].get<double>() == Approx(24).epsilon(1e-5));
    CHECK(row["wall_m2"].get<double>() == Approx(192).epsilon(1e-5));
    CHECK(row["envelope_m2"].get<double>() == Approx(352).epsilon(1e-5));
    CHECK(row["volume_m3"].get<double>() == Approx(480).epsilon(1e-5));
  }

  TEST_CASE("the rows of the envelope add up to the row of the building") {
    const Building building = house().build();
    const BuildingEnergy of =
        energy_of(building, label(building, pack()), pack(), PipelineOptions());
    const json rows =
        json::parse("[" + energy_rows(EnergyTable::envelope, TableFormat::json, of) + "]");
    CHECK(rows.size() == 6);
    double area = 0, window = 0;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      CHECK(rows[i]["face"] == i + 1);
      area += rows[i]["area_m2"].get<double>();
      window += rows[i]["window_m2"].get<double>();
      if (rows[i]["direction"] == "s") CHECK(rows[i]["window_share"].get<double>() == Approx(0.09));
    }
    CHECK(area == Approx(376).epsilon(1e-5));
    CHECK(window == Approx(5.4).epsilon(1e-5));
    for (const EnergyTable table : {EnergyTable::buildings, EnergyTable::envelope})
      CHECK(energy_columns(table).size() ==
            json::parse(energy_rows(table, TableFormat::jsonl, of)
                            .substr(0, energy_rows(table, TableFormat::jsonl, of).find('\n')))
                .size());
  }

  TEST_CASE("unheated parts are those that are asked for") {
    const Building building = house().build();
    const PipelineResult result = label(building, pack());
    EnergyOptions heated;
    heated.unheated.clear();
    const BuildingEnergy of = energy_of(building, result, pack(), {}, heated);
    CHECK(of.volume_m3 == Approx(480 + 0.36 * 1.2).epsilon(1e-5));
    CHECK(of.height_m == Approx(7.2).epsilon(1e-5));
  }

  TEST_CASE("nothing is known of a building without a body") {
    Building nothing;
    nothing.id = "nothing";
    const json row = row_of(nothing);
    CHECK(row["building"] == "nothing");
    CHECK(row["volume_m3"].is_null());
    CHECK(row["windows"].is_null());
    CHECK(row["roof_form"].is_null());
  }

  TEST_CASE("a class that the pack does not have is no unheated part") {
    EnergyOptions energy;
    CHECK(unknown_class(pack(), energy).empty());
    energy.unheated = {""};
    CHECK(unknown_class(pack(), energy).empty());
    energy.unheated = {"dormer", "balkony"};
    CHECK(unknown_class(pack(), energy) ==
          "the pack has no class 'balkony'; did you mean 'balcony'?");
  }

  TEST_CASE("the extension is taken from a building of which nothing is known any more") {
    const std::string text =
        R"({"type":"CityJSON","CityObjects":{"a":{"type":"Building","attributes":{"x":1}}}})";
    BuildingEnergy of;
    of.building = "a";
    of.is_known = true;
    of.faces.push_back({EnvelopeKind::roof, {0, 0, 1}, 4, 0, {}, 16});
    const json known = json::parse(with_energy_extension(text, {of}));
    CHECK(known["CityObjects"].size() == 3);
    CHECK(known["CityObjects"]["a"]["children"].size() == 1);
    of.is_known = false;
    const json unknown = json::parse(with_energy_extension(known.dump(), {of}));
    CHECK(unknown["CityObjects"] == json::parse(text)["CityObjects"]);
  }

  TEST_CASE("eight directions divide the circle") {
    CHECK(direction_of(0) == Direction::n);
    CHECK(direction_of(22.4) == Direction::n);
    CHECK(direction_of(22.5) == Direction::ne);
    CHECK(direction_of(180) == Direction::s);
    CHECK(direction_of(337.4) == Direction::nw);
    CHECK(direction_of(337.5) == Direction::n);
    CHECK(direction_of(359.9) == Direction::n);
  }
}
