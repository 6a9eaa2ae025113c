#include "interpret/pack/rule_base.h"

#include "interpret/compile/counts.h"
#include "interpret/compile/emitted.h"
#include "interpret/compile/reach.h"
#include "interpret/compile/reads.h"
#include "interpret/compile/strata.h"
#include "interpret/evaluate/pack_values.h"
#include "interpret/evaluate/relations.h"
#include "interpret/language/findings.h"
#include "interpret/pack/embedded.h"
#include "interpret/pack/extend.h"
#include "interpret/pack/loader.h"
#include "interpret/pack/pack.h"
#include "interpret/pack/pack_grammar.h"
#include "interpret/pack/pack_page.h"
#include "interpret/pack/read/read_pack.h"
#include "interpret/yaml/section.h"
#include "interpret/yaml/yaml_text.h"
#include "interpret/yaml/yaml_tree.h"
#include "kernel/base/sha256.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

namespace oriel::rules {

namespace {

constexpr const char* kSchema = "oriel/1";

/// More would make the checks of a pack from a stranger slow.
constexpr std::size_t kMostClasses = 256;
constexpr std::size_t kMostNames = 1024;

void check_schema(YamlSection& top, Findings& findings) {
  const YamlNode* schema = top.require("schema");
  if (schema == nullptr) return;
  const auto text = read_text(*schema, "'schema'", findings);
  if (text && *text != kSchema)
    findings.error(Code::R212, schema->span,
                   "the schema is " + std::string(kSchema) + ", not '" + *text + "'");
}

std::size_t size_of(const YamlNode* node) {
  return node == nullptr ? 0 : std::max(node->entries.size(), node->items.size());
}

bool is_small_enough(const YamlSection& top, Findings& findings) {
  bool is_small = true;
  const auto check = [&](const char* key, std::size_t most) {
    const YamlNode* node = top.find(key);
    if (size_of(node) <= most) return;
    is_small = false;
    findings.error(
        Code::R213, node->span,
        std::string("'") + key + "' has no more than " + std::to_string(most) + " entries");
  };
  check("classes", kMostClasses);
  for (const char* key :
       {"params", "relations", "macros", "rules", "groups", "emit", "surfaces", "generalise"})
    check(key, kMostNames);
  return is_small;
}

void read_sections(YamlSection& top, Loader& loader) {
  const auto read = [&](const YamlNode* node, void (*reader)(const YamlNode&, Loader&)) {
    if (node != nullptr) reader(*node, loader);
  };
  read(top.require("pack"), read_header);
  read(top.find("params"), read_params);
  read(top.find("hosts"), read_hosts);
  read(top.find("classes"), read_classes);
  read(top.find("macros"), read_macros);
  read(top.find("relations"), read_relations);
  read(top.find("iterate"), read_iterate);
  read(top.require("rules"), read_rules);
  read(top.find("decide"), read_decide);
  read(top.find("groups"), read_groups);
  read(top.find("emit"), read_emit);
  read(top.find("surfaces"), read_surfaces);
  read(top.find("generalise"), read_generalise);
  read(top.find("invariants"), read_invariants);
  check_entries(loader.pack, loader.findings);
}

/// What a pack beneath says and this one has no use for is no fault of this one.
bool is_own(SourceSpan span, const Loader& loader) {
  return loader.pack.source.is_in_first(span.begin);
}

/// A macro that no rule uses is checked all the same.
void report_unused_macros(Loader& loader) {
  std::vector<const Macro*> unused;
  for (const Macro& macro : loader.names.macros)
    if (!macro.is_used && is_own(macro.span, loader)) unused.push_back(&macro);
  for (const Macro* macro : unused) {
    loader.findings.warning(Code::R242, macro->span,
                            fmt::format("the macro '{}' is never used", macro->name));
    loader.checker.term(macro->body);
  }
}

void report_unused_params(const Loader& loader) {
  for (std::size_t i = 0; i < loader.pack.params.size(); ++i)
    if (const Param& param = loader.pack.params[i];
        !loader.names.is_param_used[i] && is_own(param.span, loader))
      loader.findings.warning(Code::R241, param.span,
                              fmt::format("the param '{}' is never used", param.name));
}

void report_unused_relations(const Loader& loader) {
  const auto& used = loader.names.used_relations;
  for (const RelationDefinition& relation : loader.pack.relations)
    if (is_own(relation.span, loader) &&
        !used.contains(relation_number(loader.pack, relation.name)))
      loader.findings.warning(Code::R248, relation.span,
                              fmt::format("the relation '{}' is never used", relation.name));
}

/// A class called window or door is written as what it says, unless the pack says otherwise.
void add_default_emissions(Pack& pack) {
  for (Class& c : pack.classes) {
    if (c.emission || (c.name != "window" && c.name != "door")) continue;
    c.emission.emplace().type = c.name == "window" ? "Window" : "Door";
  }
}

void find_raised(std::vector<Class>& classes) {
  for (std::size_t id = 0; id < classes.size(); ++id)
    for (auto at = static_cast<ClassId>(id); at != kNoClass;) {
      const Class& c = classes[static_cast<std::size_t>(at)];
      const bool is_itself = at == static_cast<ClassId>(id);
      if (is_itself || !c.is_abstract || !c.has_rules) classes[id].raised.push_back(at);
      at = c.parent;
    }
}

void name_rules(Pack& pack) {
  for (Rule& rule : pack.rules) {
    rule.name_of_label = pack.classes[static_cast<std::size_t>(rule.label)].name;
    pack.names_of_rules.push_back({rule.id, rule.name_of_label});
  }
}

/// Another file, a city or a truth in JSON say, which is YAML, too: one finding is enough.
bool is_other_file(const YamlNode& root) {
  constexpr std::size_t kFewKeys = 2;  // all of them may be misspelt
  return root.kind == YamlNode::Kind::map && root.entries.size() > kFewKeys &&
         std::ranges::none_of(root.entries, [](const YamlEntry& entry) {
           return contains(pack_grammar().keys(""), entry.key.text);
         });
}

void read_pack(const YamlNode& root, Pack& pack, Findings& findings) {
  if (is_other_file(root)) {
    findings.error(
        Code::R210, root.span,
        "this is not a rule pack: it has none of the keys of one, such as 'schema', 'pack' "
        "and 'rules'; expected a YAML file as 'oriel rules new' writes it");
    return;
  }
  check_traps(root, findings);
  YamlSection top(root, "a pack", pack_grammar().keys(""), findings);
  if (!top.is_map()) return;
  check_schema(top, findings);
  if (!is_small_enough(top, findings)) return;
  Loader loader(pack, findings);
  read_sections(top, loader);
  if (findings.has_errors()) return;
  relate_counts(pack);
  for (const int relation : evidence_relations(pack)) loader.names.used_relations.insert(relation);
  report_unused_macros(loader);
  report_unused_params(loader);
  report_unused_relations(loader);
  check_counts(pack, PackValues(pack), findings);
  find_strata(pack, findings);
  if (!findings.has_errors()) check_reach(pack, findings);
  add_default_emissions(pack);
  if (!findings.has_errors()) check_emitted(pack, findings);
  pack.reads = find_reads(pack);
  find_raised(pack.classes);
  for (RelationDefinition& relation : pack.relations) relation.sides = sides_of(pack, relation);
  name_rules(pack);
}

/// Takes the mark away that some editors put before UTF-8.
void drop_byte_order_mark(std::string& text) {
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (text.starts_with(kByteOrderMark)) text.erase(0, kByteOrderMark.size());
}

}  // namespace

ReadPack read_pack_text(std::string text, std::string file, const PackFinder& find) {
  std::string digest = sha256(text);
  drop_byte_order_mark(text);
  const PackFinder find_and_digest = [&](const std::string& name) {
    auto found = find(name);
    if (!found) return found;
    digest = sha256(digest + sha256(found->text));
    drop_byte_order_mark(found->text);
    return found;
  };
  ReadPack read;
  read.pack = std::make_shared<Pack>(Source(std::move(file), std::move(text)));
  Pack& pack = *read.pack;
  Findings findings(pack.source);
  const std::size_t bad = find_bad_byte(pack.source.text());
  if (bad != std::string_view::npos)
    findings.error(Code::R200, {bad, bad}, "this is not UTF-8 text");
  else
    read.tree = read_tree(pack.source, find_and_digest, findings);
  if (read.tree) read_pack(*read.tree, pack, findings);
  pack.sha256 = std::move(digest);
  read.issues = findings.issues();
  read.findings = findings.spanned();
  read.is_good = !findings.has_errors();
  return read;
}

}  // namespace oriel::rules

namespace oriel {

namespace {

template <class Value>
Checked<Value> refuse(Code code, const std::string& path, std::string sentence) {
  Issue issue;
  issue.code = code;
  issue.sentence = std::move(sentence);
  issue.place.file = path;
  return {std::nullopt, {std::move(issue)}};
}

std::optional<rules::FoundPack> find_embedded(const std::string& name) {
  const auto text = embedded_pack(name);
  if (!text) return std::nullopt;
  return rules::FoundPack{name + ".yaml", std::string(*text)};
}

/// The folder that the file `pack` is in, links resolved; of a file that is not there yet the one
/// that it would be in.
std::filesystem::path folder_of(const std::string& pack) {
  std::error_code problem;
  const auto real = std::filesystem::canonical(pack, problem);
  if (!problem) return real.parent_path();
  const auto parent = std::filesystem::path(pack).parent_path();
  return std::filesystem::canonical(parent.empty() ? "." : parent, problem);
}

/// The file `name` in the folder of `pack`. A link that leads out of the folder is not followed,
/// and nothing is read that may wait for ever, as a pipe does.
std::optional<rules::FoundPack> find_beside(const std::string& pack, const std::string& name) {
  const std::filesystem::path file = std::filesystem::path(pack).parent_path() / name;
  std::error_code problem;
  const auto folder = folder_of(pack);
  const auto real = std::filesystem::canonical(file, problem);
  if (problem || real.parent_path() != folder) return std::nullopt;
  if (!std::filesystem::is_regular_file(real, problem)) return std::nullopt;
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

}  // namespace

rules::PackFinder rules::finder_for(const std::string& path) {
  if (embedded_pack(path)) return find_embedded;
  return [path](const std::string& name) {
    auto embedded = find_embedded(name);
    return embedded ? embedded : find_beside(path, name);
  };
}

namespace {

Checked<RuleBase> load(std::string text, std::string file, const rules::PackFinder& find) {
  rules::ReadPack read = rules::read_pack_text(std::move(text), std::move(file), find);
  Checked<RuleBase> checked{std::nullopt, std::move(read.issues)};
  if (read.is_good) checked.value.emplace(std::move(read.pack));
  return checked;
}

/// The pack that is built in and was probably meant by `path`, or all of them.
std::string suggest_embedded(const std::string& path) {
  const auto names = embedded_packs();
  const std::string stem = std::filesystem::path(path).stem().string();
  if (contains(names, stem)) return "; did you mean '" + stem + "', which is built in?";
  const std::string near = did_you_mean(stem, names);
  return near.empty() ? "; the packs built in are: " + join(names) : near;
}

/// `found` is what find_pack has at `path`.
Checked<RuleBase> load(const std::optional<rules::FoundPack>& found, const std::string& path) {
  if (found) return load(found->text, found->file, rules::finder_for(path));
  return refuse<RuleBase>(Code::R200, path,
                          "there is no pack here that can be read" + suggest_embedded(path));
}

/// What `write` makes of the pack, which load(`found`, `path`) must be able to load, and of its
/// text without a byte order mark. Findings are those of loading it and of `write`; with an error
/// among them there is no text.
template <class Write>
Checked<std::string> write_pack(std::optional<rules::FoundPack> found, const std::string& path,
                                const Write& write) {
  auto loaded = load(found, path);
  Checked<std::string> result{std::nullopt, std::move(loaded.issues)};
  if (!loaded.value) return result;
  rules::drop_byte_order_mark(found->text);
  rules::Source source(std::move(found->file), std::move(found->text));
  rules::Findings findings(source);
  Checked<std::string> written = write(*loaded.value, source, findings);
  result.value = std::move(written.value);
  result.issues.insert(result.issues.end(), written.issues.begin(), written.issues.end());
  return result;
}

/// `text`, of which it is certain that it says the same as `tree`. Packs that can be read may be
/// beyond the limits when they are put into one: R213.
Checked<std::string> certain(const rules::YamlNode& tree, std::string text,
                             const std::string& path) {
  const rules::Source again(path, text);
  rules::Findings findings(again);
  const auto read_again = rules::parse_yaml({0, text.size()}, findings);
  if (read_again && rules::is_same(tree, *read_again)) return {std::move(text), {}};
  const auto issues = findings.issues();
  const auto limit = std::ranges::find(issues, Code::R213, &Issue::code);
  if (limit == issues.end()) throw std::logic_error("the printed pack does not say the same");
  return refuse<std::string>(Code::R213, path,
                             "the pack could not be read when printed: " + limit->sentence);
}

}  // namespace

RuleBase::RuleBase(std::shared_ptr<const rules::Pack> pack)
    : RuleBase(pack, rules::PackValues(*pack), pack->sha256) {}

RuleBase::RuleBase(std::shared_ptr<const rules::Pack> pack, const rules::PackValues& values,
                   std::string sha256)
    : pack_(std::move(pack)),
      values_(std::make_shared<rules::PackValues>(values)),
      sha256_(std::move(sha256)) {}

const std::string& RuleBase::name() const { return pack_->name; }
const std::string& RuleBase::version() const { return pack_->version; }
const std::string& RuleBase::file() const { return pack_->source.file(); }
std::vector<std::string> RuleBase::files() const { return pack_->source.files(); }
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

Checked<RuleBase> load_pack_file(const std::string& path) { return load(find_pack(path), path); }

namespace {

Checked<std::string> format_found(std::optional<rules::FoundPack> found, const std::string& path) {
  return write_pack(std::move(found), path,
                    [&](const RuleBase&, rules::Source& source, rules::Findings& findings) {
                      const auto tree = rules::parse_yaml({0, source.text().size()}, findings);
                      return certain(tree.value(), rules::to_yaml(tree.value(), source.text()),
                                     path);
                    });
}

}  // namespace

Checked<std::string> format_pack_file(const std::string& path) {
  return format_found(find_pack(path), path);
}

Checked<std::string> format_pack(std::string text, const std::string& path) {
  return format_found(rules::FoundPack{path, std::move(text)}, path);
}

Checked<std::string> merge_pack_file(const std::string& path) {
  return write_pack(find_pack(path), path,
                    [&](const RuleBase&, rules::Source& source, rules::Findings& findings) {
                      const auto tree = rules::read_tree(source, rules::finder_for(path), findings);
                      return certain(tree.value(), rules::to_yaml(tree.value()), path);
                    });
}

Checked<std::string> describe_pack_file(const std::string& path) {
  return write_pack(
      find_pack(path), path,
      [&](const RuleBase& base, rules::Source& source, rules::Findings& findings) {
        const auto tree = rules::read_tree(source, rules::finder_for(path), findings);
        return Checked<std::string>{rules::pack_page(tree.value(), base.pack(), findings), {}};
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
