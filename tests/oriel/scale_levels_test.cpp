#include "examples/generator/generate.h"
#include "examples/generator/output/cityjson.h"
#include "oriel/oriel.h"
#include "tests/cli/command.h"
#include "tests/support/shared.h"
#include "tests/support/solidified.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>

using namespace oriel;
using oriel::test::Folder;

namespace {

const std::vector<double> kDrawnScales{500, 2500, 10'000, 25'000};

/// The corners of a facet's loops in micrometres of the input, each loop from its least one.
using FacetCorners = std::vector<std::vector<std::array<std::int64_t, 3>>>;

FacetCorners corners_of(const Solid& solid, const Facet& facet, Vec3 origin_m) {
  FacetCorners corners;
  for (const Loop& loop : facet.loops) {
    auto& ring = corners.emplace_back();
    for (const int v : loop) {
      const Vec3 p = solid.vertices[static_cast<std::size_t>(v)].point + origin_m;
      ring.push_back({std::llround(1e6 * p.x), std::llround(1e6 * p.y), std::llround(1e6 * p.z)});
    }
    std::ranges::rotate(ring, std::ranges::min_element(ring));
  }
  std::ranges::sort(corners);
  return corners;
}

/// The facets of the solid that is written of a record with one building, coplanar neighbours
/// united, so that it does not matter how the file divides a face.
std::vector<FacetCorners> written_facets(const Folder& folder, const Document& document,
                                         const OutputRecord& output) {
  const auto read_back = read(folder.write("written.city.json", write(document, output)));
  REQUIRE(read_back.value.has_value());
  REQUIRE(read_back.value->at(0).buildings.size() == 1);
  const Building& building = read_back.value->at(0).buildings[0];
  const Solid solid = test::solid_of(building);
  std::vector<FacetCorners> facets;
  for (const Facet& facet : solid.facets)
    facets.push_back(corners_of(solid, facet, building.frame.origin_m));
  std::ranges::sort(facets);
  return facets;
}

/// How many facets are in one of the two only.
std::size_t differing(const std::vector<FacetCorners>& some,
                      const std::vector<FacetCorners>& others) {
  std::vector<FacetCorners> only;
  std::ranges::set_symmetric_difference(some, others, std::back_inserter(only));
  return only.size();
}

/// Compares what is drawn of a file with one building for each scale with the levels of series.
class ScaleComparison {
 public:
  ScaleComparison(const std::string& file, const RuleBase& rules)
      : document_(read(file).value.value().at(0)), rules_(rules) {
    const Building& building = document_.buildings.at(0);
    results_.push_back(label(building, rules));
    for (const double scale : kDrawnScales) {
      OutputRecord drawn;
      add(generalise(document_, building, results_[0], rules, at_scale(scale)), drawn);
      // Where nothing changes the file keeps the polygons that it has; they are this solid.
      if (!drawn.buildings.at(0).geometry) {
        drawn.buildings = {LabelledBuilding{}};
        drawn.buildings[0].building = building.id;
        drawn.buildings[0].geometry = results_[0].solid;
      }
      drawn_.push_back(facets_of(drawn));
    }
  }

  /// All scales at once, as the files of series have the levels, and as tilesets have them.
  void check_together() {
    for (const bool has_only_levels : {false, true}) {
      SeriesOptions options;
      options.has_only_levels = has_only_levels;
      const Series made = series(document_, results_, rules_, kDrawnScales, options);
      const std::vector<OutputRecord> at_scales = levels(made, kDrawnScales);
      for (std::size_t i = 0; i < kDrawnScales.size(); ++i) {
        CAPTURE(has_only_levels);
        CAPTURE(kDrawnScales[i]);
        CHECK(differing(facets_of(at_scales[i]), drawn_[i]) == 0);
      }
    }
  }

  void check_alone() {
    SeriesOptions options;
    options.has_only_levels = true;
    for (std::size_t i = 0; i < kDrawnScales.size(); ++i) {
      const double scale = kDrawnScales[i];
      CAPTURE(scale);
      const Series made = series(document_, results_, rules_, {scale}, options);
      CHECK(differing(facets_of(at(made, scale)), drawn_[i]) == 0);
    }
  }

 private:
  [[nodiscard]] std::vector<FacetCorners> facets_of(const OutputRecord& output) const {
    return written_facets(folder_, document_, output);
  }

  Folder folder_;
  Document document_;
  const RuleBase& rules_;
  std::vector<PipelineResult> results_;
  std::vector<std::vector<FacetCorners>> drawn_;  ///< by scale
};

}  // namespace

TEST_SUITE("oriel") {
  TEST_CASE("levels of series from shared houses are the solids that are drawn for their scales") {
    ORIEL_NEEDS_SHARED(shared);
    const RuleBase rules = load_pack_file("residential").value.value();
    // Doors of it go as cells only.
    ScaleComparison comparison(shared / "data/houses/clean/houses__3001_00015.stripped.city.json",
                               rules);
    comparison.check_together();
    comparison.check_alone();
  }

  TEST_CASE("levels of series and tilesets are the solids that are drawn for their scales") {
    const Folder folder;
    std::vector<std::string> inputs;
    for (const char* name : {"block", "hip", "house", "house-noisy", "l-house", "row"})
      inputs.push_back(test::sample(name));
    for (int i = 0; i < 3; ++i) {
      const std::string id = fmt::format("house-{}", i);
      inputs.push_back(folder.write(
          id + ".city.json",
          generator::cityjson({id, generator::generate({}, i), {}}, generator::Content::stripped)));
    }
    for (const std::string pack : {"residential", "cartographic"}) {
      const RuleBase rules = load_pack_file(pack).value.value();
      for (const std::string& input : inputs) {
        CAPTURE(pack);
        CAPTURE(input);
        ScaleComparison comparison(input, rules);
        comparison.check_together();
        comparison.check_alone();
      }
    }
  }
}
