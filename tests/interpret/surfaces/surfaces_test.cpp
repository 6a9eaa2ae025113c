#include "interpret/surfaces/surfaces.h"

#include "tests/interpret/support.h"

#include <array>
#include <span>
#include <vector>

using namespace oriel;
using namespace oriel::test;

namespace {

/// One surface with these attributes.
SurfaceTable surface(double inclination, double height, const std::string& part = "") {
  SurfaceTable table(1);
  table.set(0, SurfaceAttribute::inclination, inclination);
  table.set(0, SurfaceAttribute::base_height, height);
  table.set(0, SurfaceAttribute::b, 2.0);
  if (!part.empty()) table.set(0, SurfaceAttribute::part, part);
  return table;
}

std::string surface_fault(const std::string& entry) {
  return findings(
      pack_with("rules: []\nsurfaces:\n  - {id: s, type: RoofSurface, when: \"" + entry + "\"}\n"));
}

SurfaceVerdict verdict(const std::string& pack, const SurfaceTable& table) {
  const RuleBase base = load(pack);
  return interpret_surfaces(base, table).at(0);
}

SurfaceTable many_surfaces() {
  SurfaceTable many(1500);
  for (std::size_t row = 0; row < many.rows(); ++row) {
    many.set(row, SurfaceAttribute::inclination, static_cast<double>(row % 181));
    many.set(row, SurfaceAttribute::base_height, static_cast<double>(row % 7) / 4);
    if (row % 3 == 0) many.set(row, SurfaceAttribute::gap_above, static_cast<double>(row % 11));
    if (row % 5 > 0) many.set(row, SurfaceAttribute::b, static_cast<double>(row % 13) / 6);
    if (row % 2 == 0) many.set(row, SurfaceAttribute::wall_up, static_cast<double>(row % 17) / 16);
  }
  return many;
}

/// Gives out the numbers of a table one column after the other, where they are asked for.
class LateNumbers : public MoreAttributes {
 public:
  LateNumbers(const SurfaceTable& known, SurfaceTable& table) : known_(known), table_(table) {}

  [[nodiscard]] bool is_pending(SurfaceAttribute attribute) const override {
    for (std::size_t i = asked_.size(); i < kColumns.size(); ++i)
      if (kColumns[i] == attribute) return true;
    return false;
  }
  void measure(std::span<const int> rows) override {
    const SurfaceAttribute attribute = kColumns.at(asked_.size());
    for (const int r : rows) {
      const auto row = static_cast<std::size_t>(r);
      if (const auto value = known_.number(row, attribute)) table_.set(row, attribute, *value);
    }
    asked_.emplace_back(rows.begin(), rows.end());
  }
  /// The rows of each call of measure().
  [[nodiscard]] const std::vector<std::vector<int>>& asked() const { return asked_; }

 private:
  static constexpr std::array kColumns = {SurfaceAttribute::b, SurfaceAttribute::gap_above,
                                          SurfaceAttribute::wall_up};
  const SurfaceTable& known_;
  SurfaceTable& table_;
  std::vector<std::vector<int>> asked_;
};

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("without surface rules the hosts of the pack decide") {
    const std::string pack = pack_with("rules: []\n");
    CHECK(verdict(pack, surface(90, 0)).type == "WallSurface");
    CHECK(verdict(pack, surface(30, 5)).type == "RoofSurface");
    CHECK(verdict(pack, surface(180, 0.4)).type == "GroundSurface");
    CHECK(verdict(pack, surface(180, 0.6)).type == "OuterCeilingSurface");
    CHECK(verdict(pack, surface(30, 5)).rule.empty());
    CHECK(interpret_surfaces(load(pack), SurfaceTable(1)).at(0).type == "WallSurface");
  }

  TEST_CASE("the first entry that holds decides and a missing value holds nothing") {
    const std::string pack = pack_with(
        "params: {low: {value: 1 m}}\n"
        "macros: {flat: inclination < 10 deg}\n"
        "rules: []\n"
        "surfaces:\n"
        "  - {id: covered, type: OuterFloorSurface, when: [flat, gap_above < 4 m]}\n"
        "  - {id: low, type: ClosureSurface, when: flat and base_height < $low}\n"
        "  - {id: door, type: GroundSurface, when: part = door}\n"
        "  - {id: flat, type: RoofSurface, when: flat}\n");
    CHECK(verdict(pack, surface(0, 5)).rule == "flat");
    CHECK(verdict(pack, surface(0, 0.5)).rule == "low");
    CHECK(verdict(pack, surface(0, 5, "door")).rule == "door");
    CHECK(verdict(pack, surface(0, 5, "window")).rule == "flat");
    CHECK(verdict(pack, surface(90, 5)).rule.empty());
    SurfaceTable covered = surface(0, 0.5);
    covered.set(0, SurfaceAttribute::gap_above, 3.0);
    CHECK(verdict(pack, covered).type == "OuterFloorSurface");
  }

  TEST_CASE("slow: each of many surfaces is named as if it stood alone") {
    const RuleBase base = *load_pack_file("residential").value;
    const SurfaceTable many = many_surfaces();
    const auto verdicts = interpret_surfaces(base, many);
    for (std::size_t row = 0; row < many.rows(); ++row) {
      SurfaceTable one(1);
      for (const SurfaceAttribute attribute : kSurfaceAttributes)
        if (info_of(attribute).unit != Unit::text)
          if (const auto value = many.number(row, attribute)) one.set(0, attribute, *value);
      CHECK(interpret_surfaces(base, one).at(0).type == verdicts[row].type);
      CHECK(explain_surface(base, many, row).starts_with(verdicts[row].type + " by "));
    }
  }

  TEST_CASE(
      "surfaces of which numbers are measured when asked for are named as if all were known") {
    const RuleBase base = *load_pack_file("residential").value;
    const SurfaceTable known = many_surfaces();
    const auto expected = interpret_surfaces(base, known);
    std::vector<int> rows;
    for (int row = 0; row < static_cast<int>(known.rows()); row += 2) rows.push_back(row);
    SurfaceTable table(known.rows());
    for (std::size_t row = 0; row < known.rows(); ++row)
      for (const auto attribute : {SurfaceAttribute::inclination, SurfaceAttribute::base_height})
        table.set(row, attribute, *known.number(row, attribute));
    LateNumbers late(known, table);
    const auto verdicts = interpret_surfaces(base, table, rows, late);
    REQUIRE(verdicts.size() == known.rows());
    for (std::size_t row = 0; row < known.rows(); ++row) {
      CHECK(verdicts[row].type == (row % 2 == 0 ? expected[row].type : ""));
      CHECK(verdicts[row].rule == (row % 2 == 0 ? expected[row].rule : ""));
    }
    // Walls are told by their inclination alone.
    REQUIRE(late.asked().size() == 3);
    for (const auto& asked : late.asked()) {
      CHECK_FALSE(asked.empty());
      for (const int row : asked) {
        const double inclination =
            *known.number(static_cast<std::size_t>(row), SurfaceAttribute::inclination);
        CHECK((inclination < 75 || inclination > 105));
        CHECK(row % 2 == 0);
      }
    }
    // What lies right above is asked of what is narrow or level, what is around it of the latter.
    CHECK(late.asked()[0].size() > late.asked()[1].size());
    CHECK(late.asked()[1].size() > late.asked()[2].size());
  }

  TEST_CASE("a number that turns out to be missing is not asked for again") {
    const RuleBase base = load(pack_with(
        "rules: []\n"
        "surfaces:\n"
        "  - {id: covered, type: OuterFloorSurface, when: gap_above < 4 m and wall_up > 20 %}\n"
        "  - {id: any, type: RoofSurface, when: inclination < 10 deg}\n"));
    SurfaceTable known(1);
    known.set(0, SurfaceAttribute::inclination, 0.0);
    SurfaceTable table = known;
    LateNumbers late(known, table);
    const std::vector<int> rows = {0};
    CHECK(interpret_surfaces(base, table, rows, late).at(0).rule == "any");
    // The sides and what is above, but not what is around it.
    CHECK(late.asked().size() == 2);
  }

  TEST_CASE("surface rules are checked before any building is read") {
    CHECK(surface_fault("base_hight > 1 m")
              .find("R204 unknown attribute 'base_hight'; did you mean 'base_height'?") !=
          std::string::npos);
    CHECK(surface_fault("volume > 1 m3").find("R204") != std::string::npos);
    CHECK(surface_fault("height > 1 m").find("did you mean 'base_height'?") != std::string::npos);
    CHECK(surface_fault("base_height > 1").find("R231") != std::string::npos);
    CHECK(surface_fault("base_height > 1 m2").find("R230") != std::string::npos);
    CHECK(surface_fault("part = wndow").find("R234") != std::string::npos);
    CHECK(surface_fault("facing = inside").find("R234") != std::string::npos);
    CHECK(surface_fault("self is window").find("R232 'self is window' speaks of features") !=
          std::string::npos);
    CHECK(surface_fault("exists(contains)").find("R232") != std::string::npos);
    CHECK(findings(pack_with("rules: []\nsurfaces: [{id: s, type: Roof, when: synthetic}]\n"))
              .find("R212 a type of surface is one of") != std::string::npos);
    CHECK(findings(pack_with("rules: []\nsurfaces: [{id: s, when: synthetic}]\n")).find("R210") !=
          std::string::npos);
    CHECK(findings(pack_with("rules: []\nsurfaces:\n"
                             "  - {id: s, type: RoofSurface, when: synthetic}\n"
                             "  - {id: s, type: RoofSurface, when: synthetic}\n"))
              .find("R240") != std::string::npos);
  }

  TEST_CASE("identical sills are walls under the eaves and under the open sky") {
    for (const char* pack : {"residential", "surfaces-only"}) {
      const RuleBase base = *load_pack_file(pack).value;
      SurfaceTable sill(1);
      sill.set(0, SurfaceAttribute::inclination, 2.0);
      sill.set(0, SurfaceAttribute::base_height, 7.0);
      sill.set(0, SurfaceAttribute::b, 0.15);
      SurfaceTable parapet = sill;  // narrow, too, but nothing goes on above it
      parapet.set(0, SurfaceAttribute::wall_up, 0.0);
      CHECK(interpret_surfaces(base, parapet).at(0).type == "RoofSurface");
      sill.set(0, SurfaceAttribute::wall_up, 0.45);
      CHECK(interpret_surfaces(base, sill).at(0).type == "WallSurface");
      sill.set(0, SurfaceAttribute::gap_above, 1.2);
      CHECK(interpret_surfaces(base, sill).at(0).type == "WallSurface");
    }
  }

  TEST_CASE("a canopy has a roof where a ledge of the same shape has a floor") {
    const RuleBase base = *load_pack_file("residential").value;
    SurfaceTable ledge(1);
    ledge.set(0, SurfaceAttribute::inclination, 1.0);
    ledge.set(0, SurfaceAttribute::base_height, 2.6);
    ledge.set(0, SurfaceAttribute::b, 1.0);
    ledge.set(0, SurfaceAttribute::wall_up, 0.4);
    CHECK(interpret_surfaces(base, ledge).at(0).type == "OuterFloorSurface");
    ledge.set(0, SurfaceAttribute::part, "canopy");
    CHECK(interpret_surfaces(base, ledge).at(0).type == "RoofSurface");
  }

  TEST_CASE("both built-in packs name surfaces alike where no feature is named") {
    const RuleBase whole = *load_pack_file("residential").value;
    const RuleBase alone = *load_pack_file("surfaces-only").value;
    CHECK(alone.rule_count() == 0);
    for (double inclination = 0; inclination <= 180; inclination += 3)
      for (const double height : {0.0, 1.0, 6.0})
        CHECK(interpret_surfaces(whole, surface(inclination, height)).at(0).type ==
              interpret_surfaces(alone, surface(inclination, height)).at(0).type);
  }
}
