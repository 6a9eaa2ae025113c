#include "interpret/plan/operators.h"

#include <algorithm>

namespace oriel {

bool OperatorKind::takes(std::string_view argument) const {
  return std::ranges::find(arguments, argument, &OperatorArgument::name) != arguments.end();
}

const std::vector<OperatorKind>& operator_table() {
#define ORIEL_ROW(name, scope, turn, meaning, ...) {#name, meaning, {__VA_ARGS__}},
  static const std::vector<OperatorKind> table = {
      {"omit", "removes the feature and closes its host again", {}}, ORIEL_OPERATORS(ORIEL_ROW)};
#undef ORIEL_ROW
  return table;
}

}  // namespace oriel
