#include "interpret/pack/rule_base.h"

#include "interpret/language/findings.h"
#include "interpret/language/suggest.h"
#include "interpret/pack/embedded.h"
#include "interpret/pack/extend.h"
#include "interpret/pack/load.h"
#include "interpret/pack/pack.h"
#include "interpret/yaml/yaml_text.h"
#include "interpret/yaml/yaml_tree.h"

#include <filesystem>
#include <set>
#include <stdexcept>

namespace oriel {

namespace {

Checked<RuleBase> refuse(const std::string& path, std::string sentence) {
  Issue issue;
  issue.code = Code::R200;
  issue.sentence = std::move(sentence);
  issue.place.file = path;
  return {std::nullopt, {std::move(issue)}};
}

std::optional<rules::FoundPack> find_embedded(const std::string& name) {
  const auto text = embedded_pack(name);
  if (!text) return std::nullopt;
  return rules::FoundPack{name + ".yaml", std::string(*text)};
}

/// The file `name` in the folder of `pack`. A link that leads out of the folder is not followed.
std::optional<rules::FoundPack> find_beside(const std::string& pack, const std::string& name) {
  const std::filesystem::path file = std::filesystem::path(pack).parent_path() / name;
  std::error_code problem;
  const auto folder = std::filesystem::canonical(pack, problem).parent_path();
  const auto real = std::filesystem::canonical(file, problem);
  if (problem || real.parent_path() != folder) return std::nullopt;
  auto text = rules::read_file(file.string());
  if (!text) return std::nullopt;
  return rules::FoundPack{file.string(), std::move(*text)};
}

/// The embedded pack called `path`, else the file.
std::optional<rules::FoundPack> find_pack(const std::string& path) {
  if (auto embedded = find_embedded(path)) return embedded;
  auto text = rules::read_file(path);
  if (!text) return std::nullopt;
  return rules::FoundPack{path, std::move(*text)};
}

/// Finds what the pack at `path` extends.
rules::PackFinder finder_for(const std::string& path) {
  if (embedded_pack(path)) return find_embedded;
  return [path](const std::string& name) {
    auto embedded = find_embedded(name);
    return embedded ? embedded : find_beside(path, name);
  };
}

/// Prints a pack that can be loaded; `printed` gives a tree and its text, of which it is certain
/// that it says the same.
template <class Print>
Checked<std::string> print(const std::string& path, const Print& printed) {
  auto loaded = load_pack_file(path);
  Checked<std::string> result{std::nullopt, std::move(loaded.issues)};
  if (!loaded.value) return result;
  auto found = find_pack(path);
  if (!found) return result;
  rules::drop_byte_order_mark(found->text);
  rules::Source source(std::move(found->file), std::move(found->text));
  rules::Findings findings(source);
  auto [tree, text] = printed(source, findings);
  const rules::Source again(path, text);
  rules::Findings none(again);
  const auto read_again = rules::parse_yaml({0, text.size()}, none);
  if (!read_again || !rules::is_same(*tree, *read_again))
    throw std::logic_error("the printed pack does not say the same");
  result.value = std::move(text);
  return result;
}

Checked<RuleBase> load(std::string text, std::string file, const rules::PackFinder& find) {
  Checked<RuleBase> checked;
  if (auto pack = rules::load(std::move(text), std::move(file), find, checked.issues))
    checked.value.emplace(std::move(pack));
  return checked;
}

}  // namespace

const std::string& RuleBase::name() const { return pack_->name; }
const std::string& RuleBase::version() const { return pack_->version; }
const std::string& RuleBase::file() const { return pack_->source.file(); }
std::vector<std::string> RuleBase::files() const { return pack_->source.files(); }
const std::string& RuleBase::sha256() const { return pack_->sha256; }
const Limits& RuleBase::limits() const { return pack_->limits; }
std::size_t RuleBase::rule_count() const { return pack_->rules.size(); }

std::vector<std::string> RuleBase::labels() const {
  std::vector<std::string> names;
  for (const rules::Class& c : pack_->classes)
    if (!c.is_abstract) names.push_back(c.name);
  return names;
}

std::vector<std::string> RuleBase::codelists() const {
  std::set<std::string> lists;
  for (const rules::Class& c : pack_->classes)
    if (c.emission)
      for (const auto& [list, code] : c.emission->function) lists.insert(list);
  return {lists.begin(), lists.end()};
}

std::vector<bool> RuleBase::attributes_read() const {
  std::vector<bool> is_read(kAttributes.size(), false);
  for (const auto* columns : {&pack_->reads.numbers, &pack_->reads.texts})
    for (const std::size_t column : *columns) is_read[column] = true;
  return is_read;
}

std::vector<bool> RuleBase::relations_read() const {
  const auto& all = pack_->reads.relations;
  return {all.begin(), all.begin() + std::ssize(relation_schema())};
}

Checked<RuleBase> load_pack(std::string text, std::string file) {
  return load(std::move(text), std::move(file), find_embedded);
}

Checked<RuleBase> load_pack_file(const std::string& path) {
  auto found = find_pack(path);
  if (found) return load(std::move(found->text), std::move(found->file), finder_for(path));
  return refuse(path, "there is no pack here that can be read; the packs built in are: " +
                          rules::join(embedded_packs()));
}

Checked<std::string> format_pack_file(const std::string& path) {
  return print(path, [](rules::Source& source, rules::Findings& findings) {
    const auto tree = rules::parse_yaml({0, source.text().size()}, findings);
    return std::pair(tree, rules::to_yaml(tree.value(), source.text()));
  });
}

Checked<std::string> merge_pack_file(const std::string& path) {
  return print(path, [&](rules::Source& source, rules::Findings& findings) {
    const auto tree = rules::read_tree(source, finder_for(path), findings);
    return std::pair(tree, rules::to_yaml(tree.value()));
  });
}

std::optional<std::string_view> embedded_pack(std::string_view name) {
  for (const rules::EmbeddedPack& pack : rules::embedded())
    if (pack.name == name) return pack.text;
  return std::nullopt;
}

std::vector<std::string> embedded_packs() {
  std::vector<std::string> names;
  for (const rules::EmbeddedPack& pack : rules::embedded()) names.emplace_back(pack.name);
  return names;
}

}  // namespace oriel
