#pragma once

#include "interpret/learn/proposal_yaml.h"
#include "interpret/pack/rule_base.h"

#include <string>

namespace oriel {

/// A pack with a proposal in it.
struct ProposalText {
  /// The rule as it is then, or `remove: true`.
  std::string yaml;
  /// The whole text; empty if the proposal cannot be made in it.
  std::string text;
  /// Why it cannot.
  std::string why_not;
};

/// The text of a pack's own file, `text`, with the change of a proposal that was made for `rules`.
/// A rule that the text states is changed where it stands, and keeps its comments; one of a pack
/// beneath is stated anew under `rules:`. All else stays byte for byte. The text can be loaded, and
/// labels as was measured. The text may have been edited since `rules` was loaded from it, but not
/// in this rule. `file` is the path that the text has or will have.
ProposalText text_with_proposal(const RuleBase& rules, const std::string& text,
                                const std::string& file, const Proposal& proposal);

}  // namespace oriel
