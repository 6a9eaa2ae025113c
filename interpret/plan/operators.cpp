#include "interpret/plan/operators.h"

namespace oriel {

const std::vector<OperatorKind>& operator_table() {
  static const std::vector<OperatorKind> table = {
      {"omit", "takes the feature out; its host is closed again", {}},
      {"aggregate",
       "makes one strip of the recesses of a row, or one block of a feature and what sits on it",
       {{"into", "word", "what they become", {"strip", "block"}},
        {"gap", "length", "the least distance to neighbours"}}},
      {"collapse", "leaves an outline without depth", {}},
      {"displace",
       "moves the recesses of a row along their wall until gaps are wide enough",
       {{"to", "length", "the least width"},
        {"gap", "length", "the least distance to neighbours"}}},
      {"enlarge",
       "makes the feature large enough to be seen",
       {{"to", "length", "the least width and height"},
        {"anchor", "word", "what stays in place", {"centre", "sill"}},
        {"gap", "length", "the least distance to neighbours"}}},
      {"flatten",
       "lets what is thin go into its wall or roof, which moves if most of it is covered",
       {}},
      {"merge", "makes the feature part of its host", {}},
      {"symbolise",
       "puts a template in its place",
       {{"with", "word", "the template", {"chimney_block", "dormer_box", "balcony_box"}},
        {"to", "length", "the least length of its sides"},
        {"gap", "length", "the least distance to neighbours"}}},
      {"typify",
       "replaces the recesses of a row by fewer",
       {{"ratio", "ratio", "how many stay"},
        {"gap", "length", "the least distance to neighbours"}}},
  };
  return table;
}

}  // namespace oriel
