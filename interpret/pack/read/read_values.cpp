#include "interpret/compile/name_lookup.h"
#include "interpret/compile/typed_code.h"
#include "interpret/evaluate/arithmetic.h"
#include "interpret/language/parser.h"
#include "interpret/language/quantity.h"
#include "interpret/pack/loader.h"
#include "interpret/yaml/section.h"

#include <cmath>
#include <string_view>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

/// The value of a constant that was checked; an error where it has none.
std::optional<double> fold_here(ExprId id, SourceSpan where, Loader& loader) {
  const auto value = id == kNoExpr ? std::nullopt : fold(loader.pack, id);
  if (!value || std::isfinite(*value)) return value;
  loader.findings.error(Code::R212, where, "this has no value");
  return std::nullopt;
}

/// True, and an error R231, if a bound is a bare number where a unit is needed: both get it in one
/// message. `dimension` as of read_range.
bool is_unit_missing(const RangeSyntax& range, std::optional<Dimension> dimension, Loader& loader) {
  const bool is_low_bare = is_bare_number(range.low);
  const bool is_high_bare = is_bare_number(range.high);
  if (!is_low_bare && !is_high_bare) return false;
  if (!dimension && is_low_bare != is_high_bare) {
    const ExprId other = loader.checker.constant(is_low_bare ? range.high : range.low, {});
    if (other != kNoExpr) dimension = loader.pack.code[static_cast<std::size_t>(other)].dimension;
  }
  if (!dimension || dimension->is_plain()) return false;
  const auto with_unit = [&](const Syntax& bound, bool is_bare) {
    const std::string_view text = loader.findings.source().text_of(bound.span);
    return is_bare ? fmt::format("{} {}", text, unit_of(*dimension)) : std::string(text);
  };
  loader.findings.error(
      Code::R231, {range.low.span.begin, range.high.span.end},
      fmt::format("{} is needed here: write {} .. {}", describe(*dimension),
                  with_unit(range.low, is_low_bare), with_unit(range.high, is_high_bare)));
  return true;
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
  if (!syntax || is_unit_missing(*syntax, dimension, loader)) return std::nullopt;
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
  return NameLookup(loader.pack, loader.names, loader.findings).class_of(*name, node.span);
}

}  // namespace oriel::rules
