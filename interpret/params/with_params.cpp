#include "interpret/params/with_params.h"

#include "interpret/compile/checker.h"
#include "interpret/evaluate/arithmetic.h"
#include "interpret/language/findings.h"
#include "interpret/language/parser.h"
#include "interpret/language/quantity.h"
#include "interpret/pack/names.h"
#include "interpret/pack/pack.h"
#include "interpret/params/find_fault.h"
#include "kernel/base/index.h"
#include "kernel/base/sha256.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <set>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

using rules::Pack;
using rules::Param;
using rules::SourceSpan;

Issue refusal(Code code, const std::string& assignment, std::string sentence) {
  Issue issue;
  issue.code = code;
  issue.sentence = std::move(sentence);
  issue.place.file = assignment;
  return issue;
}

double number_in(const std::string& text) {
  double number = 0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return number;
}

/// The fewest decimals that read the same number, without an exponent.
std::string exact_text(double value) {
  constexpr int kMostDecimals = 30;
  std::string text = fmt::format("{}", value);
  for (int decimals = 0; text.find('e') != std::string::npos && decimals <= kMostDecimals;
       ++decimals)
    if (std::string plain = fmt::format("{:.{}f}", value, decimals); number_in(plain) == value)
      text = std::move(plain);
  return text;
}

std::string number_text(double value, const std::string& unit) {
  return unit.empty() ? exact_text(value) : exact_text(value) + " " + unit;
}

std::string number_text(double value, const Param& param) {
  return number_text(value, rules::unit_of(param.dimension));
}

constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";

/// Where the line that begins with `key` begins, or npos.
std::size_t find_key(const std::string& text, const std::string& key) {
  if (text.starts_with(key)) return 0;
  const std::size_t found = text.find("\n" + key);
  return found == std::string::npos ? found : found + 1;
}

/// `added` are lines of `params:` with two blanks before them. As deep as the first line that
/// stands there; in a map on one line before its first entry.
std::string with_added_params(std::string text, const std::string& added) {
  if (added.empty()) return text;
  const std::string key = "params:";
  const std::size_t begin = find_key(text, key);
  if (begin == std::string::npos) {
    if (!text.empty() && !text.ends_with('\n')) text += '\n';
    return text + key + "\n" + added;
  }
  const std::size_t end = std::min(text.find('\n', begin), text.size());
  const std::size_t brace = text.find('{', begin);
  std::string lines = added;
  if (brace < end) {
    for (char& c : lines)
      if (c == '\n') c = ',';
    return text.insert(brace + 1, lines.substr(2) + " ");
  }
  const std::size_t first = text.find_first_not_of(" \n", end);
  const std::size_t line = first == std::string::npos ? end : text.rfind('\n', first) + 1;
  const std::size_t depth = first == std::string::npos || first == line ? 2 : first - line;
  lines.clear();
  for (std::size_t at = 0; at < added.size();) {
    const std::size_t next = added.find('\n', at) + 1;
    lines += std::string(depth, ' ') + added.substr(at + 2, next - at - 2);
    at = next;
  }
  return text.insert(end, "\n" + lines.substr(0, lines.size() - 1));
}

/// Where the text without blanks around it stands.
SourceSpan trimmed(std::string_view text, SourceSpan span) {
  while (span.begin < span.end && text[span.begin] == ' ') ++span.begin;
  while (span.begin < span.end && text[span.end - 1] == ' ') --span.end;
  return span;
}

/// Reads assignments one after the other; what is wrong with them is collected.
class AssignmentReader {
 public:
  explicit AssignmentReader(const RuleBase& base) : base_(base), pack_(base.pack()) {}

  void read(const std::string& assignment) {
    const std::size_t sign = assignment.find('=');
    const SourceSpan name = trimmed(assignment, {0, std::min(sign, assignment.size())});
    if (sign == std::string::npos || name.begin == name.end) {
      issues_.push_back(
          refusal(Code::R211, assignment,
                  "this sets no param; expected its name, '=' and a value, such as " + example()));
      return;
    }
    const int param = find_param(assignment, assignment.substr(name.begin, name.end - name.begin));
    if (param < 0) return;
    const SourceSpan value = trimmed(assignment, {sign + 1, assignment.size()});
    if (const auto number = read_value(assignment, value, at(param)))
      values_.push_back({pack_.params[at(param)].name, *number});
  }

  Checked<std::vector<ParamValue>> result() {
    if (has_errors(issues_)) return {std::nullopt, std::move(issues_)};
    return {std::move(values_), std::move(issues_)};
  }

 private:
  [[nodiscard]] std::string example() const {
    if (pack_.params.empty()) return "parapet=0.9 m";
    const Param& first = pack_.params.front();
    return fmt::format("'{}={}'", first.name, number_text(base_.values().params.front(), first));
  }

  int find_param(const std::string& assignment, const std::string& name) {
    const int param = rules::index_of(pack_.params, name);
    if (param < 0) {
      issues_.push_back(refusal(Code::R206, assignment, unknown(name)));
    } else if (!seen_.insert(param).second) {
      issues_.push_back(
          refusal(Code::R202, assignment, fmt::format("the param '{}' is set twice", name)));
      return -1;
    }
    return param;
  }

  [[nodiscard]] std::string unknown(const std::string& name) const {
    const auto names = rules::names_of(pack_.params);
    std::string advice = did_you_mean(name, names);
    if (advice.empty())
      advice = names.empty() ? "; the pack has no params" : "; the params are: " + join(names);
    return fmt::format("unknown param '{}'{}", name, advice);
  }

  /// The number that stands there, as one in a pack is read.
  std::optional<double> read_value(const std::string& assignment, SourceSpan where,
                                   std::size_t number) {
    const Param& param = pack_.params[number];
    Pack scratch(rules::Source(assignment, assignment));
    rules::Findings findings(scratch.source);
    rules::Names names;
    if (where.begin == where.end) {
      issues_.push_back(refusal(Code::R211, assignment,
                                fmt::format("'{}' needs a value, such as {}", param.name,
                                            number_text(base_.values().params[number], param))));
      return std::nullopt;
    }
    const auto syntax = rules::parse_expression(where, findings);
    const auto id =
        syntax ? rules::Checker(scratch, names, findings).constant(*syntax, param.dimension)
               : rules::kNoExpr;
    for (Issue& issue : findings.issues()) issues_.push_back(at_assignment(std::move(issue)));
    if (id == rules::kNoExpr) return std::nullopt;
    const double value = rules::fold(scratch, id).value_or(rules::kUnknown);
    if (std::isfinite(value)) return value;
    issues_.push_back(refusal(Code::R212, assignment, "this has no value"));
    return std::nullopt;
  }

  /// An argument is one line, which the place says already.
  static Issue at_assignment(Issue issue) {
    issue.place.line = issue.place.column = 0;
    issue.excerpt.clear();
    return issue;
  }

  const RuleBase& base_;
  const Pack& pack_;
  std::set<int> seen_;
  std::vector<ParamValue> values_;
  std::vector<Issue> issues_;
};

bool is_in_range(const Param& param, double value) {
  return !param.range || (value >= param.range->first && value <= param.range->second);
}

Issue beyond_range(const std::string& assignment, double value, const Param& param) {
  return refusal(Code::R212, assignment,
                 fmt::format("{} is outside the range of '{}', {} .. {}", number_text(value, param),
                             param.name, number_text(param.range->first, param),
                             number_text(param.range->second, param)));
}

/// Of a pack that would be refused: at the first assignment that has to do with it.
Issue refused(const rules::RefusedValue& fault, const Pack& pack,
              std::span<const std::string> assignments, std::span<const ParamValue> values) {
  std::size_t cause = 0;
  const auto is_cause = [&](std::size_t param) {
    return pack.params[param].name == values[cause].name;
  };
  while (cause + 1 < values.size() && std::ranges::none_of(fault.params, is_cause)) ++cause;
  const Place place = pack.source.place(fault.span.begin);
  return refusal(Code::R212, assignments[cause],
                 fmt::format("with this value the pack would be refused at {}:{}:{}: {}",
                             place.file, place.line, place.column, fault.sentence));
}

/// As the header says.
std::string digest_of(const RuleBase& before, const rules::PackValues& after) {
  std::string text;
  for (std::size_t i = 0; i < after.params.size(); ++i)
    if (before.values().params[i] != after.params[i])
      text += fmt::format("\n{}={}", before.pack().params[i].name, exact_text(after.params[i]));
  return text.empty() ? before.sha256() : sha256(before.sha256() + text);
}

}  // namespace

std::vector<PackParam> params_of(const RuleBase& base) {
  std::vector<PackParam> params;
  for (std::size_t i = 0; i < base.values().params.size(); ++i) {
    const Param& param = base.pack().params[i];
    params.push_back({param.name, base.values().params[i], rules::unit_of(param.dimension),
                      param.range, param.why});
  }
  return params;
}

std::string to_string(const ParamValue& assigned, const RuleBase& base) {
  const int param = rules::index_of(base.pack().params, assigned.name);
  const std::string unit = param < 0 ? "" : rules::unit_of(base.pack().params[at(param)].dimension);
  return fmt::format("{} = {}", assigned.name, number_text(assigned.value, unit));
}

Checked<std::vector<ParamValue>> read_assignments(const RuleBase& base,
                                                  std::span<const std::string> assignments) {
  AssignmentReader reader(base);
  for (const std::string& assignment : assignments) reader.read(assignment);
  return reader.result();
}

Checked<RuleBase> with_params(const RuleBase& base, std::span<const std::string> assignments) {
  const Pack& pack = base.pack();
  auto read = read_assignments(base, assignments);
  if (!read.value) return {std::nullopt, std::move(read.issues)};
  Checked<RuleBase> result;
  std::vector<double> params = base.values().params;
  for (std::size_t i = 0; i < assignments.size(); ++i) {
    const auto& [name, value] = (*read.value)[i];
    const std::size_t param = at(rules::index_of(pack.params, name));
    if (!is_in_range(pack.params[param], value))
      result.issues.push_back(beyond_range(assignments[i], value, pack.params[param]));
    params[param] = value;
  }
  if (!result.issues.empty()) return result;
  const rules::PackValues values(pack, std::move(params));
  if (const auto fault = rules::find_fault(pack, values))
    result.issues.push_back(refused(*fault, pack, assignments, *read.value));
  else
    result.value.emplace(base.shared_pack(), values, digest_of(base, values));
  return result;
}

Checked<RuleBase> with_params(const RuleBase& base, std::span<const ParamValue> values) {
  std::vector<std::string> texts;
  for (const ParamValue& value : values) {
    const int param = rules::index_of(base.pack().params, value.name);
    texts.push_back(fmt::format("{}={}", value.name,
                                param < 0
                                    ? exact_text(value.value)
                                    : number_text(value.value, base.pack().params[at(param)])));
  }
  return with_params(base, texts);
}

std::string text_with_params(const RuleBase& base, std::string text,
                             std::span<const ParamValue> values) {
  const Pack& pack = base.pack();
  std::map<SourceSpan, std::string> changes;
  std::string added;
  for (const ParamValue& value : values) {
    const int number = rules::index_of(pack.params, value.name);
    if (number < 0) continue;
    const Param& param = pack.params[at(number)];
    const std::string stated = number_text(value.value, param);
    if (pack.source.is_in_first(param.value_span.begin))
      changes[param.value_span] = stated;
    else
      added += fmt::format("  {}: {{value: {}}}\n", param.name, stated);
  }
  const std::size_t mark = text.starts_with(kByteOrderMark) ? kByteOrderMark.size() : 0;
  for (auto change = changes.rbegin(); change != changes.rend(); ++change)
    text.replace(mark + change->first.begin, change->first.end - change->first.begin,
                 change->second);
  return with_added_params(std::move(text), added);
}

}  // namespace oriel
