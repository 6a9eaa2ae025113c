#include "interpret/yaml/section.h"

#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

constexpr const char* kExpression = "an expression";

std::string describe(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::null:
      return "nothing";
    case YamlNode::Kind::scalar:
      return "the text '" + node.text + "'";
    case YamlNode::Kind::sequence:
      return "a list";
    case YamlNode::Kind::map:
      return "a map";
  }
  return "";
}

bool is_all_plain(const std::vector<YamlNode>& items) {
  return !items.empty() && std::ranges::all_of(items, [](const YamlNode& item) {
    return item.kind == YamlNode::Kind::scalar && item.text.find('\n') == std::string::npos;
  });
}

/// How a map is written in place of `node`; `first_key` is the key that a lone value stands for.
std::string write_as_map(const YamlNode& node, const std::string& first_key) {
  if (node.kind == YamlNode::Kind::scalar && !node.of_key.empty() && !first_key.empty())
    return fmt::format("; write '{}: {{{}: {}}}'", node.of_key, first_key, node.text);
  if (node.kind != YamlNode::Kind::sequence) return "";
  if (is_all_plain(node.items) && !node.of_key.empty()) {
    std::string entries;
    for (const YamlNode& item : node.items)
      entries += (entries.empty() ? "" : ", ") + item.text + ": {}";
    return fmt::format("; write '{}: {{{}}}'", node.of_key, entries);
  }
  if (!node.items.empty() && !node.items[0].entries.empty()) {
    const YamlEntry& first = node.items[0].entries[0];
    const bool is_named = first.value.kind == YamlNode::Kind::scalar;
    const std::string& name = is_named ? first.value.text : first.key.text;
    return fmt::format("; an entry begins with its name and has no '-': write '{}:'", name);
  }
  return "";
}

/// How a list is written in place of `node`.
std::string write_as_list(const YamlNode& node) {
  if (node.kind == YamlNode::Kind::scalar)
    return fmt::format("; write '{}: [{}]'", node.of_key, node.text);
  if (node.entries.empty()) return "";
  const YamlEntry& first = node.entries[0];
  if (first.value.kind == YamlNode::Kind::map)
    return fmt::format("; an entry of it begins with '- ': write '- id: {}'", first.key.text);
  return fmt::format("; an entry of it begins with '- ': write '- {}: {}'", first.key.text,
                     first.value.text);
}

/// How one value is written in place of `node`; `sense: hole` for a condition is a map to YAML.
std::string write_as_scalar(const YamlNode& node, const std::string& wanted) {
  const bool is_equation = wanted == kExpression && node.entries.size() == 1 &&
                           node.entries[0].value.kind == YamlNode::Kind::scalar;
  if (is_equation)
    return fmt::format("; write '{} = {}'", node.entries[0].key.text, node.entries[0].value.text);
  if (node.kind == YamlNode::Kind::null && !node.of_key.empty())
    return fmt::format("; write it after '{}:', or take the key out", node.of_key);
  if (node.kind != YamlNode::Kind::sequence || !is_all_plain(node.items)) return "";
  const bool is_range =
      node.items.size() == 2 && std::ranges::all_of(node.items, [](const auto& i) {
        return i.text[0] >= '0' && i.text[0] <= '9';
      });
  if (is_range && !node.of_key.empty())
    return fmt::format("; a range is written '{}: {} .. {}'", node.of_key, node.items[0].text,
                       node.items[1].text);
  return fmt::format("; write one value, as in '{}: {}'", node.of_key, node.items[0].text);
}

bool expect(const YamlNode& node, YamlNode::Kind kind, const std::string& what,
            const std::string& wanted, Findings& findings, const std::string& first_key = "") {
  if (node.kind == kind) return true;
  std::string remedy;
  if (kind == YamlNode::Kind::map) remedy = write_as_map(node, first_key);
  if (kind == YamlNode::Kind::sequence) remedy = write_as_list(node);
  if (kind == YamlNode::Kind::scalar) remedy = write_as_scalar(node, wanted);
  findings.error(Code::R211, node.span,
                 fmt::format("{} is {}, but here is {}{}", what, wanted, describe(node), remedy));
  return false;
}

std::nullopt_t refuse(const YamlNode& node, const std::string& what, const std::string& wanted,
                      Findings& findings) {
  findings.error(Code::R211, node.span, what + " is " + wanted + ", not '" + node.text + "'");
  return std::nullopt;
}

/// The whole of `text` as a number.
template <class Number>
std::optional<Number> parse_number(std::string_view text) {
  Number value{};
  const auto result = std::from_chars(text.data(), text.data() + text.size(), value);
  if (result.ec != std::errc() || result.ptr != text.data() + text.size()) return std::nullopt;
  return value;
}

bool is_switch_word(const YamlNode& node) {
  static constexpr std::array<std::string_view, 12> kWords = {
      "yes", "Yes", "YES", "no", "No", "NO", "on", "On", "ON", "off", "Off", "OFF"};
  return node.is_plain && std::ranges::find(kWords, node.text) != kWords.end();
}

/// The number that YAML 1.1 makes of digits with colons: 1:50 is 1 · 60 + 50.
std::optional<long> base_60(std::string_view text) {
  long value = 0;
  std::size_t parts = 0;
  while (true) {
    const std::size_t colon = text.find(':');
    const auto part = parse_number<long>(text.substr(0, colon));
    const bool is_part = part && *part >= 0 && (parts == 0 ? *part < 1'000'000 : *part < 60);
    if (!is_part || ++parts > 6) return std::nullopt;
    value = value * 60 + *part;
    if (colon == std::string_view::npos) break;
    text.remove_prefix(colon + 1);
  }
  return parts > 1 ? std::optional(value) : std::nullopt;
}

/// Reports it; nothing else is said of the scalar.
void report_trap(const YamlNode& node, std::string sentence, Findings& findings) {
  findings.error(Code::R214, node.span, std::move(sentence));
  findings.silence(node.span);
}

void check_scalar(const YamlNode& node, Findings& findings) {
  if (is_switch_word(node))
    return report_trap(node,
                       "bare '" + node.text +
                           "' is a yes or no to some YAML readers and a text to others; write "
                           "true, false or \"" +
                           node.text + "\"",
                       findings);
  if (node.is_plain && node.text.ends_with(',') && node.text.size() > 1)
    return report_trap(node,
                       fmt::format("a comma ends no line outside {{ }} and [ ]; write '{}{}'",
                                   node.of_key.empty() ? "" : node.of_key + ": ",
                                   node.text.substr(0, node.text.size() - 1)),
                       findings);
  if (const auto number = node.is_plain ? base_60(node.text) : std::nullopt)
    report_trap(node,
                "bare '" + node.text + "' is the number " + std::to_string(*number) +
                    " in base 60 to some YAML readers; write \"" + node.text + "\"",
                findings);
}

/// Keys that people write who know other systems, or guess; the first that a map can have is meant.
struct KeySynonym {
  std::string_view theirs;
  std::string_view ours;
  /// How ours is written where its value is of another form; then theirs is not read as ours.
  std::string_view form{};
};
constexpr KeySynonym kKeySynonyms[] = {{"class", "label"},
                                       {"label", "type"},
                                       {"then", "label"},
                                       {"assign", "label"},
                                       {"result", "label"},
                                       {"name", "id"},
                                       {"rule", "id"},
                                       {"if", "require"},
                                       {"when", "require"},
                                       {"if", "when"},
                                       {"where", "require"},
                                       {"condition", "require"},
                                       {"conditions", "require"},
                                       {"condition", "when"},
                                       {"conditions", "when"},
                                       {"require", "when"},
                                       {"condition", "where"},
                                       {"conditions", "where"},
                                       {"requires", "require"},
                                       {"must", "require"},
                                       {"except", "unless"},
                                       {"exclude", "unless"},
                                       {"not", "unless"},
                                       {"forbid", "unless"},
                                       {"default", "value"},
                                       {"min", "range", "range: lo .. hi"},
                                       {"max", "range", "range: lo .. hi"},
                                       {"limits", "range"},
                                       {"reason", "why"},
                                       {"comment", "why"},
                                       {"description", "why"},
                                       {"source", "why"},
                                       {"parent", "is"},
                                       {"extends", "is"},
                                       {"subclass_of", "is"},
                                       {"superclass", "is"},
                                       {"is_a", "is"},
                                       {"isa", "is"},
                                       {"kind_of", "is"},
                                       {"class", "of"},
                                       {"relation", "by"},
                                       {"relation", "within"},
                                       {"of", "within"},
                                       {"min_size", "at_least"},
                                       {"scales", "scale"},
                                       {"class", "for"},
                                       {"target", "for"},
                                       {"of", "for"},
                                       {"action", "do"},
                                       {"operator", "do"},
                                       {"operation", "do"},
                                       {"then", "do"},
                                       {"parameters", "params"},
                                       {"constants", "params"},
                                       {"variables", "params"},
                                       {"labels", "classes"},
                                       {"types", "classes"},
                                       {"generalize", "generalise"},
                                       {"generalization", "generalise"},
                                       {"generalisation", "generalise"},
                                       {"functions", "macros"},
                                       {"definitions", "macros"},
                                       {"include", "extends"},
                                       {"import", "extends"},
                                       {"inherits", "extends"},
                                       {"base", "extends"},
                                       {"output", "emit"},
                                       {"inherit", "extends"},
                                       {"increasing", "rise"},
                                       {"decreasing", "fall"}};

bool has_key(const YamlNode& map, std::string_view key) {
  return std::ranges::any_of(map.entries,
                             [&](const YamlEntry& entry) { return entry.key.text == key; });
}

struct MeantKey {
  std::string name;
  std::string form;  ///< as in KeySynonym
};

/// The one of `keys` that `key` of `map` is probably meant for, or nothing. Another word for a key
/// is not meant for it where the map has that key, too.
MeantKey meant_key(const YamlNode& map, std::string_view key,
                   const std::vector<std::string>& keys) {
  for (const KeySynonym& synonym : kKeySynonyms)
    if (synonym.theirs == key && contains(keys, synonym.ours) && !has_key(map, synonym.ours))
      return {std::string(synonym.ours), std::string(synonym.form)};
  return {nearest(key, keys), ""};
}

std::size_t column_of(SourceSpan span, const Findings& findings) {
  return static_cast<std::size_t>(findings.source().place(span.begin).column);
}

/// What an entry without a value is, if it is no key: the rest of the value before it, whose comma
/// has ended it; a key without its colon; a value that is not indented. Nothing if it is none.
std::string explain_lone_text(const YamlEntry* before, const YamlEntry& entry,
                              const std::vector<std::string>& keys, Findings& findings) {
  const std::string& key = entry.key.text;
  const std::string word = key.substr(0, key.find(' '));
  if (contains(keys, word))
    return fmt::format("a colon is missing after '{}'; write '{}:{}'", word, word,
                       key.substr(word.size()));
  if (before == nullptr) return "";
  const Place at = findings.source().place(entry.key.span.begin);
  const Place above = findings.source().place(before->key.span.begin);
  if (before->value.kind == YamlNode::Kind::null && above.line < at.line)
    return fmt::format("'{}' is what '{}' asks for, and begins in the same column; write '{}{}'",
                       key, before->key.text,
                       std::string(static_cast<std::size_t>(at.column) + 1, ' '), key);
  if (before->value.kind != YamlNode::Kind::scalar || above.column == at.column) return "";
  const auto is_digit = [](char c) { return c >= '0' && c <= '9'; };
  const std::string& value = before->value.text;
  findings.silence(before->value.span);
  if (!value.empty() && is_digit(value.back()) && is_digit(key.front()))
    return fmt::format("decimals have a point; write '{}: {}.{}'", before->key.text, value, key);
  return fmt::format(
      "inside {{ }} a comma ends a text; a text with a comma needs quotes: write '{}: \"{}, {}\"'",
      before->key.text, value, key);
}

}  // namespace

void YamlSection::check_keys(const std::vector<std::string>& keys) {
  const YamlEntry* before = nullptr;
  for (const YamlEntry& entry : node_->entries) {
    const std::string& key = entry.key.text;
    if (entry.key.kind == YamlNode::Kind::scalar && !contains(keys, key))
      report_unknown_key(before, entry, keys);
    before = &entry;
  }
}

void YamlSection::report_unknown_key(const YamlEntry* before, const YamlEntry& entry,
                                     const std::vector<std::string>& keys) {
  const std::string& key = entry.key.text;
  const bool is_alone = entry.value.kind == YamlNode::Kind::null;
  const bool has_blank = key.find(' ') != std::string::npos;
  if (const std::string lone =
          is_alone && has_blank ? explain_lone_text(before, entry, keys, *findings_) : "";
      !lone.empty()) {
    findings_->error(Code::R209, entry.key.span, lone);
    if (before != nullptr && before->value.kind == YamlNode::Kind::null)
      findings_->silence(before->value.span);
    meant_.emplace_back(key.substr(0, key.find(' ')), nullptr);
    return;
  }
  const bool is_below =
      before != nullptr && before->value.kind == YamlNode::Kind::null && node_->of_key.empty() &&
      column_of(before->key.span, *findings_) == column_of(entry.key.span, *findings_);
  const auto [meant, form] = meant_key(*node_, key, keys);
  if (is_below && meant.empty()) {
    findings_->error(
        Code::R209, entry.key.span,
        fmt::format("unknown key '{}' in {}; if it belongs to '{}' above it, indent it: "
                    "write '  {}:'",
                    key, what_, before->key.text, key));
    return;
  }
  const std::string advice = meant.empty()
                                 ? fmt::format(" (keys: {})", join(keys))
                                 : fmt::format("; did you mean '{}'?", form.empty() ? meant : form);
  findings_->error(Code::R209, entry.key.span,
                   fmt::format("unknown key '{}' in {}{}", key, what_, advice));
  if (!meant.empty()) meant_.emplace_back(meant, form.empty() ? &entry.value : nullptr);
}

YamlSection::YamlSection(const YamlNode& node, std::string what,
                         const std::vector<std::string>& keys, Findings& findings)
    : node_(&node), what_(std::move(what)), findings_(&findings) {
  if (expect(node, YamlNode::Kind::map, what_, "a map", findings, keys.empty() ? "" : keys[0]))
    check_keys(keys);
}

const YamlNode* YamlSection::find(std::string_view key) const {
  if (const YamlNode* value = find_value(*node_, key)) return value;
  const auto meant = std::ranges::find(meant_, key, &Meant::first);
  return meant == meant_.end() ? nullptr : meant->second;
}

const YamlNode* YamlSection::require(std::string_view key) {
  const YamlNode* value = find(key);
  if (value == nullptr && is_map() && std::ranges::find(meant_, key, &Meant::first) == meant_.end())
    findings_->error(Code::R210, node_->span, what_ + " needs the key '" + std::string(key) + "'");
  return value;
}

std::string name_with_id(const YamlNode& node, std::string_view kind, std::string_view without_id) {
  for (const YamlEntry& entry : node.entries)
    if (entry.key.text == "id" && entry.value.kind == YamlNode::Kind::scalar)
      return fmt::format("the {} '{}'", kind, entry.value.text);
  return std::string(without_id);
}

bool expect_map(const YamlNode& node, const std::string& what, Findings& findings) {
  return node.kind == YamlNode::Kind::null ||
         expect(node, YamlNode::Kind::map, what, "a map", findings);
}

bool expect_list(const YamlNode& node, const std::string& what, Findings& findings) {
  return node.kind == YamlNode::Kind::null ||
         expect(node, YamlNode::Kind::sequence, what, "a list", findings);
}

std::optional<std::string> read_text(const YamlNode& node, const std::string& what,
                                     Findings& findings) {
  if (!expect(node, YamlNode::Kind::scalar, what, "a text", findings)) return std::nullopt;
  return node.text;
}

std::optional<int> read_integer(const YamlNode& node, const std::string& what, Findings& findings) {
  if (!expect(node, YamlNode::Kind::scalar, what, "a whole number", findings)) return std::nullopt;
  const auto value = node.is_plain ? parse_number<int>(node.text) : std::nullopt;
  if (!value) return refuse(node, what, "a whole number", findings);
  return value;
}

std::optional<double> read_number(const YamlNode& node, const std::string& what,
                                  Findings& findings) {
  if (!expect(node, YamlNode::Kind::scalar, what, "a number", findings)) return std::nullopt;
  const auto value = node.is_plain ? parse_number<double>(node.text) : std::nullopt;
  if (!value || !std::isfinite(*value)) return refuse(node, what, "a number", findings);
  return value;
}

std::optional<bool> read_flag(const YamlNode& node, const std::string& what, Findings& findings) {
  if (!expect(node, YamlNode::Kind::scalar, what, "true or false", findings)) return std::nullopt;
  if (node.is_plain && (node.text == "true" || node.text == "false")) return node.text == "true";
  if (is_switch_word(node)) return std::nullopt;  // reported by check_traps
  return refuse(node, what, "true or false", findings);
}

std::optional<SourceSpan> expression_span(const YamlNode& node, Findings& findings) {
  const std::string what = node.of_key.empty() ? kExpression : "'" + node.of_key + "'";
  if (!expect(node, YamlNode::Kind::scalar, what, kExpression, findings)) return std::nullopt;
  if (node.is_verbatim) return node.span;
  const bool is_glued = node.is_plain && node.text.size() > 1 && node.text[0] == '-' &&
                        node.text.find(" -") != std::string::npos;
  if (is_glued) {
    findings.error(
        Code::R221, node.span,
        fmt::format("a space is missing after '-', which begins a list item; write '- {}'",
                    node.text.substr(1, node.text.find(" -") - 1)));
    return std::nullopt;
  }
  const bool goes_on = node.is_plain;
  findings.error(Code::R221, node.span,
                 goes_on ? "this continues on the next line: an expression is written on one line, "
                           "and several conditions are a list, each on a line after '- '"
                         : "an expression is written on one line without escapes, so that messages "
                           "can point into it");
  return std::nullopt;
}

void check_traps(const YamlNode& node, Findings& findings) {
  if (node.kind == YamlNode::Kind::scalar) check_scalar(node, findings);
  for (const YamlNode& item : node.items) check_traps(item, findings);
  for (const YamlEntry& entry : node.entries) {
    check_traps(entry.key, findings);
    check_traps(entry.value, findings);
  }
}

}  // namespace oriel::rules
