#include "interpret/operators.h"

namespace oriel {

const std::vector<OperatorKind>& operator_table() {
  static const std::vector<OperatorKind> table = {
      {"omit", "takes the feature out; its host is closed again", {}, true},
      {"aggregate",
       "makes one feature of the members of a group",
       {{"into", "word", "what they become"}}},
      {"collapse", "leaves an outline without depth", {}},
      {"displace", "moves the feature along its wall until gaps are wide enough", {}},
      {"enlarge",
       "makes the feature large enough to be seen",
       {{"to", "length", "the least width and height"}, {"anchor", "word", "what stays in place"}}},
      {"flatten", "takes the depth away", {}},
      {"merge", "makes the feature part of its host", {}},
      {"symbolise", "puts a template in its place", {{"with", "word", "the template"}}},
      {"typify",
       "replaces many members of a group by fewer",
       {{"ratio", "ratio", "how many stay"}}},
  };
  return table;
}

}  // namespace oriel
