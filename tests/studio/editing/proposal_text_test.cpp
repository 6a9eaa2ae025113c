#include "studio/editing/proposal_text.h"

#include "interpret/learn/count_variants.h"
#include "interpret/learn/learn_params.h"
#include "interpret/learn/propose.h"
#include "tests/interpret/learn/random_samples.h"

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
  return propose(load(pack), samples, folds_of(samples.size(), 4, 1), {}).value();
}

}  // namespace

TEST_SUITE("interpret/learn") {
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

  TEST_CASE("an accepted proposal stands where the rule does and labels as was measured") {
    const auto samples = true_samples(load(widths("height > 1 m, width <= 2 m")));
    const auto value_of = [&](const RuleBase& rules) {
      const Variant as_it_is{"as it is", {}, {}, {}};
      const auto counted = count_variants(rules, {&as_it_is, 1}, samples, {}).value.value();
      return macro_f1(counted.total(0));
    };
    const std::string pack =
        "schema: oriel/1\n"
        "pack: {name: widths, version: 1.0.0}   # mine\n"
        "classes: {window: {}, door: {}}\n"
        "rules:\n"
        "# of windows\n"
        "- id: window.w        # the only one\n"
        "  label: window\n"
        "  require:\n"
        "  - height > 1 m      # more than a hatch\n"
        "  - depth >= 0 m\n"
        "\n"
        "# of doors\n"
        "- {id: door.d, label: door, require: [base_height > 6 m, depth > 1 m], priority: 5}\n"
        "decide: {min_score: 0.1}\n";
    const RuleBase base = load(pack);
    const auto proposals = propose(base, samples, folds_of(samples.size(), 4, 1), {}).value();
    REQUIRE_FALSE(proposals.empty());
    for (const Proposal& proposal : proposals) {
      CAPTURE(proposal.what);
      const ProposalText made = text_with_proposal(base, pack, "", proposal);
      REQUIRE(made.why_not == "");
      CHECK(made.yaml.find(proposal.rule) != std::string::npos);
      const RuleBase accepted = load(made.text);
      CHECK(value_of(accepted) - value_of(base) == doctest::Approx(proposal.gain));
      for (const char* kept :
           {"1.0.0}   # mine\n", "# of windows\n", "\n# of doors\n", "decide: {min_score: 0.1}\n"})
        CHECK(made.text.find(kept) != std::string::npos);
      if (proposal.rule == "window.w" && !proposal.drops_rule) {
        CHECK(made.text.find("# more than a hatch\n") != std::string::npos);
        CHECK(made.text.find("\n- {id: door.d, label: door") != std::string::npos);
        CHECK(text_with_proposal(base, made.text, "", proposal).why_not.find("learn again") !=
              std::string::npos);
      }
      // The text may be edited elsewhere.
      const ProposalText later = text_with_proposal(base, pack + "# later\n", "", proposal);
      CHECK(later.text == made.text + "# later\n");
    }
  }

  TEST_CASE("a proposal for a rule of a pack beneath states it anew") {
    const std::string text =
        "schema: oriel/1\nextends: residential\npack: {name: t, version: 1.0.0}\n";
    const RuleBase base = load(text);
    Proposal proposal;
    proposal.rule = "sill.under_opening";
    proposal.require = {"sticks_out and host is wall and height <= 0.25 m and depth <= $foothold",
                        "width <= 2.4 m"};
    const ProposalText added = text_with_proposal(base, text, "", proposal);
    REQUIRE(added.why_not == "");
    CHECK(added.text == text + added.yaml);
    proposal.require.clear();
    proposal.drops_rule = true;
    const std::string removed = "  - id: sill.under_opening\n    remove: true\n";
    const ProposalText dropped = text_with_proposal(base, text, "", proposal);
    CHECK(dropped.text == text + "rules:\n" + removed);
    // What states it anew does not bring it back either, and others stay.
    const std::string other =
        "  - {id: hatch.x, label: window, require: [self is opening and a > 1 m]}   # mine\n";
    const std::string more = added.text + other;
    const ProposalText gone = text_with_proposal(load(more), more, "", proposal);
    CHECK(gone.why_not == "");
    CHECK(gone.text == text + "rules:\n" + removed + other);
    const RuleBase with_other = load(text + "rules:\n" + other);
    const ProposalText after =
        text_with_proposal(with_other, text + "rules:\n" + other, "", proposal);
    CHECK(after.text == text + "rules:\n" + other + removed);
    CHECK(text_with_proposal(base, "schema: oops\n", "", proposal).text == "");
  }

  TEST_CASE("nothing is proposed for rules that are right") {
    const std::string pack = widths("height > 1 m, width <= 2 m");
    CHECK(proposals_for(pack, true_samples(load(pack))).empty());
  }
}
