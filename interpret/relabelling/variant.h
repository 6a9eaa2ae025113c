#pragma once

#include "interpret/pack/pack.h"
#include "interpret/pack/rule_base.h"
#include "interpret/params/with_params.h"

#include <string>
#include <vector>

namespace oriel {

/// A piece of a pack that a variant does without.
struct DroppedPart {
  enum class Kind {
    rule,       ///< never holds
    condition,  ///< of `require`
    veto,       ///< of `unless`
    score_term,
    evidence,  ///< `decide: evidence`: company and typical counts
    company,   ///< one relation of `decide: company`
    typical    ///< one count of a class
  };
  Kind kind = Kind::rule;
  /// The rule, or of `typical` the class, by its number; -1: none.
  int owner = -1;
  /// Which of the owner's (of `company`: of all) conditions, vetoes, terms, relations or counts.
  int item = -1;
  /// Which part of a condition that joins several by `and`; -1: all of it.
  int part = -1;
  friend bool operator==(const DroppedPart&, const DroppedPart&) = default;
};

/// A pack that says something else than one that was loaded: params at other values, pieces left
/// out. Everything else is as it was, also the order in which rules are run: what came after a
/// dropped rule or condition still does.
struct Variant {
  /// "parapet = 0.6 m", "without rule window.in_wall", "without 'height <= 3 m' of ledge.overhead".
  std::string name;
  std::vector<ParamValue> params;
  std::vector<DroppedPart> without;
  /// Where the piece that is dropped stands in the pack.
  Place place;
};

/// The pack with params at these values, called "parapet = 0.6 m, step = 0.3 m".
Variant variant_with(const RuleBase& base, std::vector<ParamValue> params);

/// The pack without one piece of it, for each that can be left out: every rule, each condition of
/// its `require` (those joined by `and` one by one; a macro among them is one) where another one is
/// left, each of its `unless`, each term of its score; joint evidence as a whole, each relation of
/// company and each count of `typical`. In the order of the pack.
std::vector<Variant> ablations(const RuleBase& base);

namespace rules {

/// A copy of a pack that leaves parts out, some after others. The pack must outlive it.
class Ablation {
 public:
  explicit Ablation(const Pack& base) : base_(base), pack_(base) {}

  /// The pack without these parts and with all others. Valid until the next call.
  const Pack& without(std::vector<DroppedPart> parts);

 private:
  void put_back(const DroppedPart& part);

  const Pack& base_;
  Pack pack_;
  std::vector<DroppedPart> dropped_;
};

}  // namespace rules

}  // namespace oriel
