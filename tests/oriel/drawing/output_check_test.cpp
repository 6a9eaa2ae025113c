#include "oriel/drawing/output_check.h"

#include "oriel/oriel.h"
#include "tests/support/flush.h"

#include <algorithm>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <rapidcheck.h>

using namespace oriel;

namespace {

std::vector<std::string> sentences(const std::vector<Finding>& findings) {
  std::vector<std::string> all;
  for (const Finding& finding : findings) all.push_back(finding.sentence);
  return all;
}

/// The solid with a vertex half a metre higher or lower: its faces bend, or it stays as it is.
Solid bent(Solid solid) {
  const int vertex = *rc::gen::inRange(0, 3);
  solid.vertices[static_cast<std::size_t>(vertex)].point.z += *rc::gen::element(0.0, 0.5, -0.5);
  return solid;
}

}  // namespace

TEST_SUITE("oriel") {
  TEST_CASE("a solid is judged alike whatever was judged before it") {
    Document document;
    document.buildings.push_back(test::plain_block());
    document.buildings[0].is_solid = true;
    const Building& building = document.buildings[0];
    const PipelineResult result = segment(building);
    REQUIRE(result.is_done());
    CHECK(rc::check([&] {
      OutputCheck all(document, building);
      Solid solid = *result.solid;
      for (int i = 0; i < 4; ++i) {
        const auto found = sentences(all.findings(solid));
        RC_ASSERT(found == sentences(OutputCheck(document, building).findings(solid)));
        RC_ASSERT(all.fault(solid).has_value() == !found.empty());
        RC_ASSERT(all.made_valid(solid).has_value() ==
                  OutputCheck(document, building).made_valid(solid).has_value());
        solid = bent(*rc::gen::element(solid, *result.solid));
      }
    }));
  }
}
