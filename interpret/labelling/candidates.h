#pragma once

#include "interpret/evaluate/pack_values.h"
#include "interpret/pack/pack.h"

#include <vector>

namespace oriel::rules {

/// A rule for a label that holds for a feature.
struct Candidate {
  /// An index into Pack::rules.
  int rule = -1;
  /// 0…1, the rule's own.
  double score = 0;
  /// What the others of the feature add to it or take from it.
  double evidence = 0;

  [[nodiscard]] double total() const { return score + evidence; }
};

/// What was decided for one feature.
struct Choice {
  /// The rule that won, or -1.
  int rule = -1;
  /// 0…1, with evidence.
  double score = 0;
  double margin = 0;
  /// The best rule for another label, or -1.
  int runner_up = -1;
  bool is_ambiguous = false;
};

/// Sorts candidates by what wins: enough score, then priority, then score, then the rule's id.
void sort_candidates(const Pack& pack, const PackValues& values,
                     std::vector<Candidate>& candidates);

/// What is decided among sorted candidates.
Choice choose(const Pack& pack, const PackValues& values, const std::vector<Candidate>& candidates);

}  // namespace oriel::rules
