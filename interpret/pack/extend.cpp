#include "interpret/pack/extend.h"

#include "interpret/pack/embedded.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <set>
#include <string_view>
#include <utility>
#include <vector>

namespace oriel::rules {

namespace {

/// Entries of `over` replace those of the same key, or with `levels` left are put over them.
void put_over(YamlNode& base, YamlNode over, int levels) {
  if (base.kind != YamlNode::Kind::map || over.kind != YamlNode::Kind::map) {
    base = std::move(over);
    return;
  }
  for (YamlEntry& entry : over.entries) {
    YamlNode* beneath = find_value(base, entry.key.text);
    if (beneath == nullptr)
      base.entries.push_back(std::move(entry));
    else if (levels > 1)
      put_over(*beneath, std::move(entry.value), levels - 1);
    else
      *beneath = std::move(entry.value);
  }
}

bool is_removal(const YamlNode& item) {
  const YamlNode* remove = find_value(item, "remove");
  return remove != nullptr && remove->is_plain && remove->text == "true";
}

/// Puts the items of a list over those with the same id.
class ListMerge {
 public:
  ListMerge(YamlNode& base, Findings& findings)
      : base_(&base), findings_(&findings), is_replaced_(base.items.size(), false) {}

  void put(YamlNode item) {
    const YamlNode* id = find_value(item, "id");
    const auto beneath = id == nullptr ? npos : find_beneath(id->text);
    if (!is_removal(item)) {
      if (beneath == npos)
        base_->items.push_back(std::move(item));
      else
        base_->items[beneath] = std::move(item);
    } else if (beneath == npos) {
      findings_->error(Code::R246, item.span,
                       "no pack beneath has this id, so there is nothing to remove");
    } else {
      removed_.insert(beneath);
    }
    if (beneath != npos) is_replaced_[beneath] = true;
  }

  void end() {
    for (auto i = removed_.rbegin(); i != removed_.rend(); ++i)
      base_->items.erase(base_->items.begin() + static_cast<std::ptrdiff_t>(*i));
  }

 private:
  static constexpr std::size_t npos = static_cast<std::size_t>(-1);

  /// An id that stands twice above must not hide itself: it replaces once.
  [[nodiscard]] std::size_t find_beneath(std::string_view id) const {
    for (std::size_t i = 0; i < is_replaced_.size(); ++i) {
      const YamlNode* other = find_value(base_->items[i], "id");
      if (other != nullptr && other->text == id) return is_replaced_[i] ? npos : i;
    }
    return npos;
  }

  YamlNode* base_;
  Findings* findings_;
  std::vector<bool> is_replaced_;
  std::set<std::size_t> removed_;
};

void put_section(std::string_view key, YamlNode& base, YamlNode over, Findings& findings) {
  const bool is_list = key == "rules" || key == "surfaces" || key == "generalise";
  if (is_list && base.kind == YamlNode::Kind::sequence && over.kind == YamlNode::Kind::sequence) {
    ListMerge merge(base, findings);
    for (YamlNode& item : over.items) merge.put(std::move(item));
    merge.end();
    return;
  }
  const bool is_whole = key == "schema" || key == "pack" || key == "iterate" || is_list;
  const bool has_keys = key == "params" || key == "classes";
  if (is_whole)
    base = std::move(over);
  else
    put_over(base, std::move(over), has_keys ? 2 : 1);
}

/// `over` with what it does not say taken from `base`.
YamlNode merged(YamlNode base, YamlNode over, Findings& findings) {
  base.span = over.span;
  for (YamlEntry& entry : over.entries) {
    YamlNode* beneath = find_value(base, entry.key.text);
    if (beneath == nullptr)
      base.entries.push_back(std::move(entry));
    else
      put_section(entry.key.text, *beneath, std::move(entry.value), findings);
  }
  return base;
}

/// The node after `extends:`, taken out of the tree.
std::optional<YamlNode> take_extends(YamlNode& root) {
  const auto found = std::ranges::find(root.entries, std::string_view("extends"),
                                       [](const YamlEntry& e) { return e.key.text; });
  if (root.kind != YamlNode::Kind::map || found == root.entries.end()) return std::nullopt;
  YamlNode node = std::move(found->value);
  root.entries.erase(found);
  return node;
}

/// A name without folders: nothing outside the pack's own folder is read.
bool is_plain_name(const YamlNode& node) {
  if (node.kind != YamlNode::Kind::scalar || node.text.empty() || node.text.front() == '.')
    return false;
  return std::ranges::all_of(node.text, [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_' ||
           c == '-' || c == '.';
  });
}

/// What was probably meant: a pack that is built in, or the file with its extension.
std::string suggest_pack(const std::string& name, const PackFinder& find_pack) {
  if (find_pack(name + ".yaml")) return "; did you mean '" + name + ".yaml'?";
  std::vector<std::string> names;
  for (const EmbeddedPack& pack : embedded()) names.emplace_back(pack.name);
  const std::string stem = name.ends_with(".yaml")
                               ? name.substr(0, name.size() - std::string_view(".yaml").size())
                               : name;
  if (contains(names, stem)) return "; did you mean '" + stem + "'?";
  const std::string near = did_you_mean(stem, names);
  return near.empty() ? "; built in are: " + join(names) : near;
}

/// The text of the pack that `node` names, appended to `source`.
std::optional<SourceSpan> append_pack(const YamlNode& node, std::set<std::string>& seen,
                                      Source& source, const PackFinder& find_pack,
                                      Findings& findings) {
  if (!is_plain_name(node)) {
    findings.error(
        Code::R246, node.span,
        "after 'extends' comes the name of a built-in pack, or of a file in the same folder");
    return std::nullopt;
  }
  auto found = find_pack(node.text);
  if (!found) {
    findings.error(Code::R200, node.span,
                   "there is no pack '" + node.text +
                       "' here: neither built in nor a file in the folder of this pack" +
                       suggest_pack(node.text, find_pack));
    return std::nullopt;
  }
  if (!seen.insert(found->file).second || seen.size() > kMostBeneath + 1) {
    findings.error(Code::R246, node.span,
                   seen.contains(found->file) && seen.size() <= kMostBeneath + 1
                       ? "the pack extends itself"
                       : "a pack has no more than 8 packs beneath it");
    return std::nullopt;
  }
  const std::size_t bad = find_bad_byte(found->text);
  if (bad == std::string_view::npos) return source.append(std::move(found->file), found->text);
  findings.error(Code::R200, node.span, "'" + node.text + "' is not UTF-8 text");
  return std::nullopt;
}

}  // namespace

std::optional<YamlNode> read_tree(Source& source, const PackFinder& find_pack, Findings& findings) {
  std::vector<YamlNode> trees;
  std::set<std::string> seen = {source.file()};
  std::optional<SourceSpan> where = SourceSpan{0, source.text().size()};
  while (where) {
    auto tree = parse_yaml(*where, findings);
    if (!tree) return std::nullopt;
    const auto extends = take_extends(*tree);
    trees.push_back(std::move(*tree));
    if (!extends) break;
    where = append_pack(*extends, seen, source, find_pack, findings);
  }
  if (!where) return std::nullopt;
  YamlNode tree = std::move(trees.back());
  for (std::size_t i = trees.size() - 1; i-- > 0;)
    tree = merged(std::move(tree), std::move(trees[i]), findings);
  return tree;
}

}  // namespace oriel::rules
