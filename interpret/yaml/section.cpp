#include "interpret/yaml/section.h"

#include "interpret/language/suggest.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <utility>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

std::string describe(const YamlNode& node) {
  switch (node.kind) {
    case YamlNode::Kind::null:
      return "nothing";
    case YamlNode::Kind::scalar:
      return "a text";
    case YamlNode::Kind::sequence:
      return "a list";
    case YamlNode::Kind::map:
      return "a map";
  }
  return "";
}

bool expect(const YamlNode& node, YamlNode::Kind kind, const std::string& what,
            const std::string& wanted, Findings& findings) {
  if (node.kind == kind) return true;
  findings.error(Code::R211, node.span, what + " is " + wanted + "; here stands " + describe(node));
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

void check_scalar(const YamlNode& node, Findings& findings) {
  if (is_switch_word(node)) {
    findings.error(Code::R214, node.span,
                   "bare '" + node.text +
                       "' is a yes or no to some YAML readers and a text to others; write true, "
                       "false or \"" +
                       node.text + "\"");
    return;
  }
  if (const auto number = node.is_plain ? base_60(node.text) : std::nullopt)
    findings.error(Code::R214, node.span,
                   "bare '" + node.text + "' is the number " + std::to_string(*number) +
                       " in base 60 to some YAML readers; write \"" + node.text + "\"");
}

void report_unknown_key(const YamlEntry& entry, const std::string& what,
                        const std::vector<std::string>& keys, Findings& findings) {
  const std::string& key = entry.key.text;
  // `{why: one thing, and another}` is a key `and another` without a value.
  const bool is_rest_of_text =
      entry.value.kind == YamlNode::Kind::null && key.find(' ') != std::string::npos;
  const std::string advice =
      is_rest_of_text ? "; inside { } a text with a comma must be quoted" : did_you_mean(key, keys);
  findings.error(Code::R209, entry.key.span,
                 fmt::format("unknown key '{}' in {}{} (keys: {})", key, what, advice, join(keys)));
}

}  // namespace

YamlSection::YamlSection(const YamlNode& node, std::string what,
                         const std::vector<std::string>& keys, Findings& findings)
    : node_(&node), what_(std::move(what)), findings_(&findings) {
  if (!expect(node, YamlNode::Kind::map, what_, "a map", findings)) return;
  for (const YamlEntry& entry : node.entries) {
    const std::string& key = entry.key.text;
    if (entry.key.kind == YamlNode::Kind::scalar && !contains(keys, key))
      report_unknown_key(entry, what_, keys, findings);
  }
}

const YamlNode* YamlSection::find(std::string_view key) const {
  for (const YamlEntry& entry : node_->entries)
    if (entry.key.text == key) return &entry.value;
  return nullptr;
}

const YamlNode* YamlSection::require(std::string_view key) {
  const YamlNode* value = find(key);
  if (value == nullptr && is_map())
    findings_->error(Code::R210, node_->span, what_ + " needs the key '" + std::string(key) + "'");
  return value;
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
  if (!expect(node, YamlNode::Kind::scalar, "an expression", "a text", findings))
    return std::nullopt;
  if (node.is_verbatim) return node.span;
  findings.error(Code::R221, node.span,
                 "an expression stands on one line without escapes, so that messages can point "
                 "into it");
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
