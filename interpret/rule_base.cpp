#include "interpret/rule_base.h"

#include "interpret/detail/embedded.h"
#include "interpret/detail/load.h"
#include "interpret/detail/pack.h"
#include "interpret/detail/read_file.h"
#include "interpret/detail/suggest.h"

#include <filesystem>
#include <set>

namespace oriel {

namespace {

Checked<RuleBase> refuse(const std::string& path, std::string sentence) {
  Issue issue;
  issue.code = "R200";
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

Checked<RuleBase> load_pack(std::string text, std::string file) {
  return load(std::move(text), std::move(file), find_embedded);
}

Checked<RuleBase> load_pack_file(const std::string& path) {
  if (const auto text = embedded_pack(path)) return load_pack(std::string(*text), path + ".yaml");
  auto text = rules::read_file(path);
  if (!text)
    return refuse(path, "there is no pack here that can be read; the packs built in are: " +
                            rules::join(embedded_packs()));
  return load(std::move(*text), path, [&](const std::string& name) {
    auto embedded = find_embedded(name);
    return embedded ? embedded : find_beside(path, name);
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
