#include "interpret/evaluate/arithmetic.h"
#include "interpret/language/parser.h"
#include "interpret/language/suggest.h"
#include "interpret/pack/loader.h"
#include "interpret/yaml/section.h"

#include <cmath>

namespace oriel::rules {

namespace {

/// The value of a constant that was checked; an error where it has none.
std::optional<double> fold_here(ExprId id, SourceSpan where, Loader& loader) {
  const auto value = id == kNoExpr ? std::nullopt : fold(loader.pack, id);
  if (!value || std::isfinite(*value)) return value;
  loader.findings.error(Code::R212, where, "this has no value");
  return std::nullopt;
}

}  // namespace

std::optional<FixedValue> read_quantity(const YamlNode& node, std::optional<Dimension> dimension,
                                        Loader& loader) {
  const auto where = expression_span(node, loader.findings);
  const auto syntax = where ? parse_expression(*where, loader.findings) : std::nullopt;
  if (!syntax) return std::nullopt;
  const ExprId id = loader.checker.constant(*syntax, dimension);
  const auto value = fold_here(id, *where, loader);
  if (!value) return std::nullopt;
  return FixedValue{*value, loader.pack.code[static_cast<std::size_t>(id)].dimension, id};
}

std::optional<FixedRange> read_range(const YamlNode& node, std::optional<Dimension> dimension,
                                     Loader& loader) {
  const auto where = expression_span(node, loader.findings);
  const auto syntax = where ? parse_range(*where, loader.findings) : std::nullopt;
  if (!syntax) return std::nullopt;
  FixedRange range;
  range.low_expr = loader.checker.constant(syntax->low, dimension);
  if (range.low_expr != kNoExpr && !dimension)
    dimension = loader.pack.code[static_cast<std::size_t>(range.low_expr)].dimension;
  range.high_expr = loader.checker.constant(syntax->high, dimension);
  const auto low = fold_here(range.low_expr, syntax->low.span, loader);
  const auto high = fold_here(range.high_expr, syntax->high.span, loader);
  if (!low || !high) return std::nullopt;
  range.low = *low;
  range.high = *high;
  range.dimension = *dimension;
  if (range.low <= range.high) return range;
  loader.findings.error(Code::R212, *where, "an empty range: its low end is above its high end");
  return std::nullopt;
}

ExprId read_constant(const YamlNode& node, std::optional<Dimension> dimension, Loader& loader) {
  const auto where = expression_span(node, loader.findings);
  const auto syntax = where ? parse_expression(*where, loader.findings) : std::nullopt;
  return syntax ? loader.checker.constant(*syntax, dimension) : kNoExpr;
}

ExprId read_condition(const YamlNode& node, Loader& loader) {
  const auto where = expression_span(node, loader.findings);
  const auto syntax = where ? parse_expression(*where, loader.findings) : std::nullopt;
  return syntax ? loader.checker.condition(*syntax) : kNoExpr;
}

ClassId read_class(const YamlNode& node, const std::string& what, Loader& loader) {
  const auto name = read_text(node, what, loader.findings);
  if (!name) return kNoClass;
  const ClassId id = index_of(loader.pack.classes, *name);
  if (id < 0)
    loader.findings.error(
        Code::R205, node.span,
        "unknown class '" + *name + "'" + did_you_mean(*name, names_of(loader.pack.classes)));
  return id;
}

}  // namespace oriel::rules
