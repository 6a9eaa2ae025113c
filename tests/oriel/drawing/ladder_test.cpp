#include "oriel/oriel.h"
#include "tests/support/shared.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <utility>

#include <doctest/doctest.h>

using namespace oriel;

TEST_SUITE("oriel") {
  TEST_CASE("a building that is drawn from a repaired solid is cut into no more pieces by that") {
    ORIEL_NEEDS_SHARED(shared);
    const RuleBase rules = *load_pack_file("residential").value;
    std::size_t repaired = 0;
    for (const char* id : {"4018206", "4018208", "4018211"}) {
      CAPTURE(id);
      Reader reader((shared / "data" / "ingolstadt" /
                     ("ingolstadt__" + std::string(id) + ".stripped.city.json"))
                        .string());
      const Document document = std::move(*reader.next()->value);
      const Building& building = document.buildings.at(0);
      const PipelineResult result = label(building, rules);
      const auto drawn = generalise(document, building, result, rules, at_scale(5000));
      CHECK(drawn.levels.size() == 1);
      for (const Issue& issue : drawn.issues) CHECK(issue.code != Code::E502);
      if (!drawn.repaired) continue;
      ++repaired;
      CHECK(drawn.repaired->segmentation->features.size() <
            1.2 * static_cast<double>(result.segmentation->features.size()));
    }
    CHECK(repaired > 0);
  }
}
