#include "interpret/plan/operators.h"

namespace oriel {

const std::vector<OperatorKind>& operator_table() {
  static const std::vector<OperatorKind> table = {
      {"omit", "removes the feature and closes its host again", {}},
      {"aggregate",
       "merges the recesses of a row into one strip, or a feature and the features on it into one "
       "block",
       {{"into", "word", "the result", {"strip", "block"}},
        {"gap", "length", "the least distance to neighbours"}}},
      {"collapse", "leaves an outline without depth", {}},
      {"displace",
       "moves the openings of a wall apart until gaps are wide enough",
       {{"to", "length", "the least width"},
        {"gap", "length", "the least distance to neighbours"}}},
      {"enlarge",
       "makes the feature large enough to be seen",
       {{"to", "length", "the least width and height"},
        {"anchor", "word", "what stays in place", {"centre", "sill"}},
        {"gap", "length", "the least distance to neighbours"}}},
      {"flatten",
       "absorbs a thin feature into its facet, which moves if the feature covers most of it",
       {}},
      {"merge", "makes the feature part of its host", {}},
      {"symbolise",
       "replaces the feature with a template",
       {{"with", "word", "the template", {"chimney_block", "dormer_box", "balcony_box"}},
        {"to", "length", "the least length of its sides"},
        {"gap", "length", "the least distance to neighbours"}}},
      {"typify",
       "replaces the recesses of a row with fewer ones",
       {{"ratio", "ratio", "the share that stays"},
        {"gap", "length", "the least distance to neighbours"}}},
  };
  return table;
}

}  // namespace oriel
