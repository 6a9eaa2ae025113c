#include "interpret/operators.h"

namespace oriel {

const std::vector<OperatorKind>& operator_table() {
  static const std::vector<OperatorKind> table = {
      {"omit", "takes the feature out; its host is closed again", {}, true},
      {"aggregate",
       "makes one strip of the recesses of a row",
       {{"gap", "length", "the least distance to what is beside"}},
       true},
      {"collapse", "leaves an outline without depth", {}, true},
      {"displace", "moves the feature along its wall until gaps are wide enough", {}},
      {"enlarge",
       "makes the feature large enough to be seen",
       {{"to", "length", "the least width and height"},
        {"anchor", "word", "what stays in place", {"centre", "sill"}},
        {"gap", "length", "the least distance to what is beside"}},
       true},
      {"flatten", "leaves an outline of what sticks out", {}, true},
      {"merge", "makes the feature part of its host", {}},
      {"symbolise",
       "puts a template in its place",
       {{"with", "word", "the template", {"chimney_block", "dormer_box", "balcony_box"}},
        {"to", "length", "the least length of its sides"},
        {"gap", "length", "the least distance to what is beside"}},
       true},
      {"typify",
       "replaces the recesses of a row by fewer",
       {{"ratio", "ratio", "how many stay"},
        {"gap", "length", "the least distance to what is beside"}},
       true},
  };
  return table;
}

}  // namespace oriel
