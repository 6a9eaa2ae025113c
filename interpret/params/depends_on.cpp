#include "interpret/params/depends_on.h"

#include <algorithm>

namespace oriel::rules {

bool depends_on(const Pack& pack, ExprId id, std::size_t param, bool is_thorough) {
  if (id == kNoExpr) return false;
  const Expr& expr = pack.code[static_cast<std::size_t>(id)];
  if (expr.op == Op::parameter) return expr.index == static_cast<int>(param);
  const auto does = [&](ExprId part) { return depends_on(pack, part, param, is_thorough); };
  if (std::ranges::any_of(expr.args, does) || does(expr.value)) return true;
  return is_thorough && (does(expr.filter) || does(expr.join));
}

}  // namespace oriel::rules
