#include "studio/editing/pack_outline.h"

#include "studio/editing/cursor/word_texts.h"
#include "studio/editing/cursor/yaml_path.h"

#include <algorithm>
#include <string_view>
#include <utility>

namespace oriel::rules {

namespace {

/// The end of the last text in a tree; brackets that close after it do not count.
std::size_t end_of_texts(const YamlNode& node) {
  std::size_t end = node.span.end;
  for (const YamlNode& item : node.items) end = std::max(end, end_of_texts(item));
  for (const YamlEntry& entry : node.entries)
    end = std::max({end, entry.key.span.end, end_of_texts(entry.value)});
  return end;
}

/// The end of the line of the last text.
std::size_t end_of_node(const YamlNode& node, const std::string& text) {
  std::size_t end = std::min(text.find('\n', end_of_texts(node)), text.size());
  if (end > 0 && text[end - 1] == '\r') --end;
  return end;
}

TextSpan as_text(SourceSpan span) { return {span.begin, span.end}; }

std::string text_below(const YamlNode& map, std::string_view key) {
  const YamlNode* value = find_value(map, key);
  return value == nullptr ? "" : value->text;
}

OutlineItem item_of(const DeclaredName& declared, const std::string& text) {
  const WordText words = text_of(declared);
  OutlineItem item{words.sort, declared.name, "", "", words.detail};
  item.name_span = as_text(declared.span);
  const std::size_t begin = std::min(declared.span.begin, declared.value->span.begin);
  item.where = {begin, end_of_node(*declared.value, text)};
  if (declared.sort == WordSort::class_name) item.parent = text_below(*declared.value, "is");
  if (declared.sort == WordSort::rule) item.parent = text_below(*declared.value, "label");
  return item;
}

void add_tests(const YamlNode& root, const std::string& text, std::vector<OutlineItem>& items) {
  const YamlNode* tests = find_value(root, "tests");
  if (tests == nullptr) return;
  for (const YamlNode& test : tests->items) {
    const YamlNode* name = find_value(test, "name");
    if (name == nullptr) continue;
    items.push_back({"test",
                     name->text,
                     "",
                     "",
                     "",
                     {test.span.begin, end_of_node(test, text)},
                     as_text(name->span)});
  }
}

}  // namespace

std::vector<OutlineItem> outline_of(const PackLayers& layers) {
  const PackLayer& top = layers.top();
  const std::string& text = top.source.text();
  std::vector<OutlineItem> items, sections;
  for (const YamlEntry& entry : top.tree.entries) {
    const bool has_parts = !entry.value.entries.empty() || !entry.value.items.empty();
    if (!has_parts) continue;
    const std::size_t begin = entry.key.span.begin;
    sections.push_back({"section",
                        entry.key.text,
                        "",
                        "",
                        "",
                        {begin, end_of_node(entry.value, text)},
                        as_text(entry.key.span)});
  }
  for (const DeclaredName& declared : layers.names())
    if (declared.layer == &top) items.push_back(item_of(declared, text));
  add_tests(top.tree, text, items);
  for (OutlineItem& item : items)
    for (const OutlineItem& section : sections)
      if (section.where.begin <= item.where.begin && item.where.end <= section.where.end)
        item.section = section.name;
  std::ranges::move(sections, std::back_inserter(items));
  std::ranges::stable_sort(items, [](const OutlineItem& p, const OutlineItem& q) {
    return p.where.begin < q.where.begin ||
           (p.where.begin == q.where.begin && p.where.end > q.where.end);
  });
  return items;
}

}  // namespace oriel::rules
