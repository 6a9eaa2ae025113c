#include "interpret/experiment/learn/propose.h"

#include "interpret/experiment/learn/learn_params.h"
#include "tests/interpret/experiment/random_samples.h"

#include <algorithm>

using namespace oriel;
using namespace oriel::test;

namespace {

std::string widths(const std::string& require) {
  return "schema: oriel/1\n"
         "pack: {name: widths, version: 1.0.0}\n"
         "classes: {window: {}, door: {}}\n"
         "rules:\n"
         "  - {id: window.w, label: window, require: [" +
         require +
         "]}\n"
         "  - {id: door.d, label: door, require: [base_height > 6 m, depth > 1 m], priority: 5}\n";
}

/// Buildings of which is true what a pack says.
std::vector<Sample> true_samples(const RuleBase& truth) {
  return samples_labelled_by(truth, 8, 25);
}

std::vector<Proposal> proposals_for(const std::string& pack, const std::vector<Sample>& samples) {
  return propose(load(pack), samples, folds_of(samples.size(), 4, 1), {});
}

}  // namespace

TEST_SUITE("interpret/experiment/learn") {
  TEST_CASE("a condition that a rule lacks is proposed as YAML that loads") {
    const auto samples = true_samples(load(widths("height > 1 m, width <= 2 m")));
    const std::string pack = widths("height > 1 m");
    const auto proposals = proposals_for(pack, samples);
    REQUIRE(!proposals.empty());
    CHECK(proposals[0].what.starts_with("add 'width <= "));
    CHECK(proposals[0].what.ends_with("to window.w"));
    CHECK(proposals[0].held_out_gain > 0.1);
    CHECK(proposals[0].folds == 4);
    const std::string yaml = to_yaml({proposals[0]}, pack);
    const std::string header = pack.substr(0, pack.find("rules:"));
    const auto loaded = load_pack(header + yaml, "proposal.yaml");
    for (const Issue& issue : loaded.issues) CHECK(issue.severity != Severity::error);
    CHECK(loaded.value.has_value());
  }

  TEST_CASE("a condition that a rule does not need is proposed to be dropped") {
    const auto samples = true_samples(load(widths("height > 1 m")));
    const auto proposals = proposals_for(widths("height > 1 m, width <= 2 m"), samples);
    const auto drop =
        std::ranges::find(proposals, "drop 'width <= 2 m' of window.w", &Proposal::what);
    REQUIRE(drop != proposals.end());
    CHECK(drop->require == std::vector<std::string>{"height > 1 m"});
    CHECK(drop->held_out_gain > 0.1);
  }

  TEST_CASE("nothing is proposed for rules that are right") {
    const std::string pack = widths("height > 1 m, width <= 2 m");
    CHECK(proposals_for(pack, true_samples(load(pack))).empty());
  }
}
