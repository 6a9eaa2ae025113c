#include "studio/lsp/protocol_json.h"

#include "oriel/rules.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

/// A word of ours with its number in the protocol.
struct ProtocolKind {
  std::string_view word{};
  int number;
};

/// CompletionItemKind.
constexpr std::array kItemKinds = {
    ProtocolKind{"attribute", 5}, ProtocolKind{"attribute of surfaces", 5},
    ProtocolKind{"param", 21},    ProtocolKind{"class", 7},
    ProtocolKind{"predicate", 8}, ProtocolKind{"macro", 3},
    ProtocolKind{"relation", 18}, ProtocolKind{"group", 13},
    ProtocolKind{"rule", 2},      ProtocolKind{"fixture", 6},
    ProtocolKind{"pack", 9},      ProtocolKind{"operator", 24},
    ProtocolKind{"function", 3},  ProtocolKind{"unit", 11},
    ProtocolKind{"value", 12},    ProtocolKind{"word", 14},
    ProtocolKind{"key", 10},
};

/// SymbolKind.
constexpr std::array kSymbolKinds = {
    ProtocolKind{"section", 3},    ProtocolKind{"param", 14}, ProtocolKind{"class", 5},
    ProtocolKind{"predicate", 11}, ProtocolKind{"macro", 12}, ProtocolKind{"relation", 7},
    ProtocolKind{"group", 18},     ProtocolKind{"rule", 6},   ProtocolKind{"entry", 24},
    ProtocolKind{"fixture", 19},   ProtocolKind{"test", 6},
};

template <std::size_t size>
int number_of(const std::array<ProtocolKind, size>& kinds, std::string_view word) {
  const auto* found = std::ranges::find(kinds, word, &ProtocolKind::word);
  return found == kinds.end() ? 1 : found->number;
}

int severity_number(Severity severity) {
  switch (severity) {
    case Severity::error:
      return 1;
    case Severity::warning:
      return 2;
    case Severity::note:
      return 3;
  }
  return 3;
}

int from_zero(const JsonValue& number) {
  constexpr std::int64_t kMost = std::numeric_limits<int>::max() - 1;
  return static_cast<int>(std::clamp<std::int64_t>(number.get<std::int64_t>(), 0, kMost)) + 1;
}

/// A client refuses a symbol without a name.
std::string name_of(const OutlineItem& item) { return item.name.empty() ? "?" : item.name; }

JsonValue symbol_in_tree(const EditedPack& pack, const OutlineItem& item) {
  JsonValue symbol{{"name", name_of(item)},
                   {"kind", number_of(kSymbolKinds, item.kind)},
                   {"range", protocol_range(pack.places(), item.where)},
                   {"selectionRange", protocol_range(pack.places(), item.name_span)}};
  if (!item.detail.empty()) symbol["detail"] = item.detail;
  return symbol;
}

JsonValue symbol_in_list(const EditedPack& pack, const OutlineItem& item, const std::string& uri) {
  return {{"name", name_of(item)},
          {"kind", number_of(kSymbolKinds, item.kind)},
          {"containerName", item.section},
          {"location", {{"uri", uri}, {"range", protocol_range(pack.places(), item.where)}}}};
}

/// Where the line begins that is at `at`.
std::size_t line_begin(std::string_view text, std::size_t at) {
  const std::size_t end = at == 0 ? std::string_view::npos : text.rfind('\n', at - 1);
  return end == std::string_view::npos ? 0 : end + 1;
}

}  // namespace

JsonValue position_json(TextPlace place) {
  return {{"line", place.line - 1}, {"character", place.column - 1}};
}

JsonValue protocol_range(const TextPlaces& places, TextSpan where) {
  return {{"start", position_json(places.place(where.begin))},
          {"end", position_json(places.place(where.end))}};
}

TextPlace place_of_position(const JsonValue& position) {
  return {from_zero(position.at("line")), from_zero(position.at("character"))};
}

JsonValue edits_json(const TextPlaces& places, const std::vector<TextEdit>& edits) {
  JsonValue list = JsonValue::array();
  for (const TextEdit& edit : edits)
    list.push_back({{"range", protocol_range(places, edit.where)}, {"newText", edit.text}});
  return list;
}

JsonValue diagnostic_json(const EditedPack& pack, const TextFinding& finding,
                          const std::string& docs_url) {
  JsonValue diagnostic{{"range", protocol_range(pack.places(), finding.where)},
                       {"severity", severity_number(finding.severity)},
                       {"code", to_string(finding.code)}};
  if (!docs_url.empty() && !page_of(finding.code).empty())
    diagnostic["codeDescription"]["href"] =
        fmt::format("{}/{}#{}", docs_url, document_of(finding.code), anchor_of(finding.code));
  diagnostic["source"] = "oriel";
  diagnostic["message"] = finding.sentence;
  return diagnostic;
}

JsonValue completion_json(const EditedPack& pack, std::size_t offset) {
  JsonValue items = JsonValue::array();
  for (const Completion& completion : pack.complete(offset)) {
    JsonValue item{{"label", completion.label}, {"kind", number_of(kItemKinds, completion.kind)}};
    item["detail"] = completion.detail.empty()
                         ? completion.kind
                         : fmt::format("{}: {}", completion.kind, completion.detail);
    if (!completion.documentation.empty()) item["documentation"] = completion.documentation;
    item["sortText"] = fmt::format("{:05}", items.size());
    item["filterText"] = completion.label;
    item["textEdit"] = {{"range", protocol_range(pack.places(), completion.replaced)},
                        {"newText", completion.insert}};
    items.push_back(std::move(item));
  }
  return {{"isIncomplete", false}, {"items", std::move(items)}};
}

JsonValue symbols_json(const EditedPack& pack, const std::string& uri, bool is_tree) {
  const std::vector<OutlineItem> outline = pack.outline();
  JsonValue symbols = JsonValue::array();
  if (!is_tree) {
    for (const OutlineItem& item : outline) symbols.push_back(symbol_in_list(pack, item, uri));
    return symbols;
  }
  for (const OutlineItem& item : outline)
    if (item.section.empty() || symbols.empty())
      symbols.push_back(symbol_in_tree(pack, item));
    else
      symbols.back()["children"].push_back(symbol_in_tree(pack, item));
  return symbols;
}

std::vector<TextEdit> changed_lines(const std::string& before, const std::string& after) {
  if (before == after) return {};
  const auto [p, q] = std::ranges::mismatch(before, after);
  const std::size_t begin = line_begin(before, static_cast<std::size_t>(p - before.begin()));
  std::size_t same = 0;  // bytes at the end that are the same
  const std::size_t most = std::min(before.size(), after.size()) - begin;
  while (same < most && before[before.size() - 1 - same] == after[after.size() - 1 - same]) ++same;
  // Up to the line end before them.
  const std::size_t line = before.find('\n', before.size() - same);
  const std::size_t end = line == std::string::npos ? before.size() : line + 1;
  const std::size_t end_after = after.size() - (before.size() - end);
  return {{{begin, end}, after.substr(begin, end_after - begin)}};
}

}  // namespace oriel::studio
