#pragma once

#include "interpret/pack/rule_base.h"
#include "kernel/base/issue.h"

#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace oriel {

/// A param of a pack, as the pack states it.
struct PackParam {
  std::string name;
  /// In metres to a power, degrees, or plain.
  double value = 0;
  /// "m", "m2", "m3", "deg", or empty.
  std::string unit;
  /// The values that it may have, ends included; nothing: any.
  std::optional<std::pair<double, double>> range;
  std::string why;
};

/// The params of the pack, in its order.
std::vector<PackParam> params_of(const RuleBase& base);

/// A param set to another value, in the unit of params_of().
struct ParamValue {
  std::string name;
  double value = 0;
  friend bool operator==(const ParamValue&, const ParamValue&) = default;
};

/// "parapet = 0.8 m", with as many decimals as it takes to read the same value again.
std::string to_string(const ParamValue& assigned, const RuleBase& base);

/// What texts such as "parapet=0.8 m" say: a name, `=`, and a number with its unit as in a pack, or
/// an expression of numbers. Errors are as of with_params().
Checked<std::vector<ParamValue>> read_assignments(const RuleBase& base,
                                                  std::span<const std::string> assignments);

/// The pack with params at other values. Labels, surfaces and plans are those of a pack that
/// extends this one and states these values; so are files() and all places, which lead into the
/// text as it is. With s the digest of this pack, sha256() is that of `s` followed by
/// "\nNAME=VALUE" for every param whose value is another one than before, in the pack's order,
/// VALUE with the fewest digits that read the same number; without any it stays `s`.
///
/// Errors have the assignment in Place::file, and there is no value: R211 no assignment, R206 no
/// such param, R202 a param twice, R212 a value beyond the param's range or one with which the pack
/// could not be loaded (an empty range, hosts that overlap), R230 and R231 a wrong or missing unit,
/// and what else a number can have in a pack.
Checked<RuleBase> with_params(const RuleBase& base, std::span<const std::string> assignments);
/// The same with numbers.
Checked<RuleBase> with_params(const RuleBase& base, std::span<const ParamValue> values);

/// The text of a pack's own file, `text`, of which `base` was loaded, with params at other values:
/// those that it states are changed where they stand, those of packs that it extends are added
/// under `params:`; all else stays byte for byte. Loaded in its place it labels as with_params().
/// Values of params that the pack does not have are left out.
std::string text_with_params(const RuleBase& base, std::string text,
                             std::span<const ParamValue> values);

}  // namespace oriel
