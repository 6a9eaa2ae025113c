#pragma once

#include "interpret/compile/name_lookup.h"
#include "interpret/compile/typed_code.h"
#include "interpret/language/findings.h"
#include "interpret/language/parser.h"
#include "interpret/pack/names.h"
#include "interpret/pack/pack.h"
#include "model/description/feature_table.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::rules {

/// How many operands and operators one expression, and all of a pack, may come to after macros are
/// put in.
inline constexpr std::size_t kMostInExpression = 10'000;
inline constexpr std::size_t kMostInPack = 200'000;

/// Looks up every name of an expression and gives every part its type and dimension. Typed
/// expressions go into `pack.code`; what is wrong goes into `findings`:
/// R204 … R208 unknown names, R222 too large, R230 dimensions differ, R231 a unit is missing,
/// R232 the wrong type, R234 unknown word, R235 mm@map or scale outside generalise, R236 self or
/// other out of reach, R247 a macro that needs itself, R249 what a relation cannot ask, R271
/// gap(members) where there are none.
class Checker {
 public:
  Checker(Pack& pack, Names& names, Findings& findings)
      : pack_(&pack),
        names_(&names),
        findings_(&findings),
        lookup_(pack, names, findings),
        code_(pack, findings) {}

  /// Inside `generalise:` lengths may be stated in mm@map, and `scale` is the target scale's N.
  void allow_map_units(bool is_allowed) { is_map_allowed_ = is_allowed; }
  /// Inside `when` of an entry for a group gap(members) is known.
  void speak_of_group(bool is_of_group) { is_of_group_ = is_of_group; }

  /// Inside `surfaces:` names are those of surface_schema(), and there is nothing to relate.
  void speak_of_surfaces() { is_of_surfaces_ = true; }
  /// Inside scores of a pack that iterates classes are those of the round before.
  void read_previous_round(bool is_previous) { is_previous_ = is_previous; }

  /// A condition, or kNoExpr and an error.
  ExprId condition(const Syntax& syntax);
  /// A number or a condition, or kNoExpr and an error.
  ExprId term(const Syntax& syntax);
  /// A condition on two features, self (level 0, also without a name) and other (level 1), of which
  /// nothing but attributes is known; or kNoExpr and an error.
  ExprId pair_condition(const Syntax& syntax);
  /// A number of no feature, with the dimension if one is given; or kNoExpr and an error.
  ExprId constant(const Syntax& syntax, std::optional<Dimension> dimension = {});

 private:
  ExprId check(const Syntax& syntax);
  ExprId check_by_kind(const Syntax& syntax);
  bool is_too_much(SourceSpan where);

  [[nodiscard]] const std::vector<AttributeInfo>& schema() const;
  [[nodiscard]] std::vector<std::string> words_for(std::size_t column) const;

  // Names.
  ExprId check_number(const Syntax& syntax);
  ExprId check_parameter(const Syntax& syntax);
  ExprId check_name(const Syntax& syntax);
  ExprId check_attribute(const Syntax& syntax, int column);
  ExprId check_macro(const Syntax& syntax, Macro& macro);
  ExprId check_scale(const Syntax& syntax);
  ExprId check_distance(const Syntax& syntax);
  ExprId check_group_gap(const Syntax& syntax);
  ExprId check_is(const Syntax& syntax);
  ExprId check_class(const Syntax& syntax, int level);
  ExprId check_host(const Syntax& syntax, int level);
  ExprId check_quantifier(const Syntax& syntax);
  ExprId check_aggregate(const Syntax& syntax);
  std::optional<int> relation_of(const Syntax& syntax);
  std::optional<int> level_of(const Syntax& syntax);

  // Operators.
  std::vector<ExprId> check_numbers(const Syntax& syntax);
  std::vector<ExprId> check_conditions(const Syntax& syntax);
  ExprId check_comparison(const Syntax& syntax);
  ExprId check_list(const Syntax& syntax);
  ExprId report_list_of_measures(const Syntax& syntax, Dimension dimension);
  ExprId check_as_number(const Syntax& syntax);
  ExprId check_as_condition(const Syntax& syntax);
  ExprId check_word(const Syntax& syntax, ExprId text);

  Pack* pack_;
  Names* names_;
  Findings* findings_;
  NameLookup lookup_;
  TypedCode code_;
  bool is_map_allowed_ = false;
  bool is_of_surfaces_ = false;
  bool is_of_group_ = false;
  bool is_in_relation_ = false;
  bool is_previous_ = false;
  int macro_depth_ = 0;
  int level_ = 0;
  /// Operands and operators looked at: of the expression at hand, and of the pack.
  std::size_t in_expression_ = 0;
  std::size_t in_pack_ = 0;
};

}  // namespace oriel::rules
