#include "interpret/evaluate/arithmetic.h"

#include <vector>

namespace oriel::rules {

std::optional<double> fold(const Pack& pack, ExprId id, std::span<const double> params,
                           std::optional<double> scale) {
  const Expr& expr = pack.code[static_cast<std::size_t>(id)];
  if (!is_constant(expr) || expr.type == Type::yes_no) return std::nullopt;
  if (expr.op == Op::constant) return expr.number;
  if (expr.op == Op::parameter) {
    const auto param = static_cast<std::size_t>(expr.index);
    return params.empty() ? pack.params[param].value : params[param];
  }
  if (expr.op == Op::scale) return scale;
  std::vector<double> values;
  for (const ExprId arg : expr.args) {
    const auto value = fold(pack, arg, params, scale);
    if (!value) return std::nullopt;
    values.push_back(*value);
  }
  if (expr.op == Op::map_length) {
    if (!scale) return std::nullopt;
    return values[0] * *scale / 1000;
  }
  double result = values[0];
  if (values.size() == 1) return apply(expr.op, result);
  for (std::size_t i = 1; i < values.size(); ++i) result = apply(expr.op, result, values[i]);
  return result;
}

}  // namespace oriel::rules
