#include "model/interpretation.h"

#include <doctest/doctest.h>

namespace oriel {
namespace {

/// Verdicts with these labels.
Interpretation labelled(const std::vector<std::string>& labels) {
  Interpretation interpretation;
  for (const std::string& label : labels) {
    Verdict verdict;
    verdict.feature = FeatureId{static_cast<int>(interpretation.verdicts.size())};
    verdict.label = label;
    interpretation.verdicts.push_back(verdict);
  }
  return interpretation;
}

const FeatureId kBody;

TEST_SUITE("model") {
  TEST_CASE("a part belongs to the next labelled feature up its hosts") {
    const Interpretation run = labelled({"window", "", "", "door", ""});
    const std::vector<FeatureId> hosts{kBody, FeatureId{0}, FeatureId{1}, FeatureId{0},
                                       FeatureId{3}};
    const std::vector<FeatureId> wholes = wholes_by_feature(run, hosts);
    CHECK(wholes == std::vector<FeatureId>{kBody, FeatureId{0}, FeatureId{0}, kBody, FeatureId{3}});
  }

  TEST_CASE("what stands on nothing that has a label is a part of nothing") {
    const std::vector<FeatureId> hosts{kBody, FeatureId{0}};
    CHECK(wholes_by_feature(labelled({"", ""}), hosts) == std::vector<FeatureId>{kBody, kBody});
  }

  TEST_CASE("hosts of stored features that stand in a circle end") {
    const std::vector<FeatureId> hosts{FeatureId{1}, FeatureId{0}};
    CHECK(wholes_by_feature(labelled({"", ""}), hosts) == std::vector<FeatureId>{kBody, kBody});
  }
}

}  // namespace
}  // namespace oriel
