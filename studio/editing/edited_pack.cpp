#include "studio/editing/edited_pack.h"

#include "interpret/language/findings.h"
#include "interpret/pack/loader.h"
#include "interpret/pack/names.h"
#include "interpret/pack/read/read_pack.h"
#include "interpret/plan/profile.h"
#include "interpret/testing/test_file.h"
#include "interpret/yaml/yaml_tree.h"
#include "model/description/feature_table.h"
#include "studio/editing/cursor/word_at.h"
#include "studio/editing/layers.h"

#include <algorithm>
#include <filesystem>
#include <iterator>
#include <string_view>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

bool is_of_name(char c) {
  return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}

/// "a param".
std::string sort_in_words(rules::WordSort sort) {
  switch (sort) {
    case rules::WordSort::param:
      return "param";
    case rules::WordSort::class_name:
      return "class";
    case rules::WordSort::macro:
      return "macro";
    case rules::WordSort::relation:
      return "relation";
    case rules::WordSort::group:
      return "group";
    case rules::WordSort::fixture:
      return "fixture";
    default:
      return "rule";
  }
}

void add_dollar_places(const std::string& text, const std::string& name,
                       std::vector<TextSpan>& places) {
  const std::string wanted = "$" + name;
  for (std::size_t at = text.find(wanted); at != std::string::npos;
       at = text.find(wanted, at + 1)) {
    const std::size_t end = at + wanted.size();
    if (end == text.size() || !is_of_name(text[end])) places.push_back({at + 1, end});
  }
}

/// The sort under which the word is declared.
rules::WordSort declared_sort(const rules::PackWord& word) {
  return word.sort == rules::WordSort::value_name ? rules::WordSort::macro : word.sort;
}

/// Why the word can not be renamed, or nothing: only what the top layer alone declares can be.
std::string refuse_renaming(const rules::PackLayers& layers, const rules::PackWord& word) {
  const rules::WordSort sort = declared_sort(word);
  const bool is_own = std::ranges::any_of(layers.names(), [&](const rules::DeclaredName& declared) {
    return declared.sort == sort && declared.name == word.name && declared.layer == &layers.top();
  });
  for (const rules::DeclaredName& declared : layers.names())
    if (declared.sort == sort && declared.name == word.name && declared.layer != &layers.top())
      return fmt::format("'{}' is {} in {}: rename it there", word.name,
                         is_own ? "also stated" : "stated", declared.layer->source.file());
  return is_own ? "" : fmt::format("'{}' is not a name that this pack states", word.name);
}

/// Why it cannot be called `name`, or nothing.
std::string refuse_name(const rules::PackLayers& layers, const rules::PackWord& word,
                        const std::string& name) {
  const rules::WordSort sort = declared_sort(word);
  if (name == word.name) return "";
  if (layers.find(sort, name) != nullptr)
    return fmt::format("there is a {} '{}' already", sort_in_words(sort), name);
  if (sort == rules::WordSort::rule || sort == rules::WordSort::entry)
    return rules::is_rule_id(name) ? "" : "an id is names joined by points, such as door.ground";
  if (sort == rules::WordSort::macro && find_attribute(name))
    return fmt::format("there is an attribute '{}'", name);
  const rules::Source source("", name);
  rules::Findings findings(source);
  rules::YamlNode node;
  node.kind = rules::YamlNode::Kind::scalar;
  node.text = name;
  if (rules::expect_name(node, "a " + sort_in_words(sort), findings)) return "";
  return findings.spanned().front().sentence;
}

/// The places of the top layer of `layers` that name what `word` names, ascending: those in
/// expressions, keys and lists, and of params also `$name` in comments and reasons.
std::vector<TextSpan> places_of(const rules::PackLayers& layers, rules::WordSort sort,
                                const std::string& name) {
  const rules::PackLayer& top = layers.top();
  std::vector<TextSpan> places;
  for (const rules::PackWord& word : rules::pack_words(top.tree, top.source))
    if (rules::is_same_name(layers, word, sort, name))
      places.push_back({word.span.begin, word.span.end});
  if (sort == rules::WordSort::param) add_dollar_places(top.source.text(), name, places);
  std::ranges::sort(places);
  places.erase(std::unique(places.begin(), places.end()), places.end());
  return places;
}

constexpr std::string_view kYamlExtension = ".yaml";
constexpr std::string_view kTestExtension = ".test.yaml";

/// What the keys that are not indented say.
EditedPack::Kind kind_of_text(std::string_view text) {
  for (std::size_t line = 0; line < text.size();) {
    const std::size_t end = std::min(text.find('\n', line), text.size());
    const std::string_view content = text.substr(line, end - line);
    if (content.starts_with("tests_for:")) return EditedPack::Kind::tests;
    if (content.starts_with("profile:") || content.starts_with("schema: oriel-profile/"))
      return EditedPack::Kind::profile;
    if (content.starts_with("experiment:") || content.starts_with("schema: oriel-experiment/"))
      return EditedPack::Kind::other;
    line = end + 1;
  }
  return EditedPack::Kind::pack;
}

std::string without_byte_order_mark(std::string text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.erase(0, 3);
  return text;
}

/// The text at `path` as an editor has it, else as it is on disk.
std::optional<std::string> text_open_or_stored(const std::string& path, const OpenTexts& open) {
  if (auto text = open ? open(path) : std::nullopt) return text;
  return rules::read_file(path);
}

/// The file of an embedded pack is called NAME.yaml and has no folder.
std::optional<std::string_view> embedded_text(const std::string& file) {
  if (!file.ends_with(kYamlExtension)) return std::nullopt;
  return embedded_pack(file.substr(0, file.size() - kYamlExtension.size()));
}

}  // namespace

struct EditedPack::State {
  State(std::string t, std::string f, OpenTexts o)
      : text(without_byte_order_mark(std::move(t))),
        file(std::move(f)),
        open(std::move(o)),
        places(text),
        kind(kind_of_text(text)) {}

  std::string text;
  std::string file;
  OpenTexts open;
  TextPlaces places;
  Kind kind;
  std::optional<rules::PackLayers> layers;
  std::optional<std::vector<TextFinding>> findings;
  std::optional<RuleBase> base;

  [[nodiscard]] rules::PackFinder finder() const {
    return [find = rules::finder_for(file), open = open](const std::string& name) {
      auto found = find(name);
      if (found && open)
        if (auto text_of_editor = open(found->file)) found->text = std::move(*text_of_editor);
      return found;
    };
  }

  const rules::PackLayers& read_layers() {
    if (!layers) layers.emplace(text, file, finder());
    return *layers;
  }

  void find() {
    findings.emplace();
    if (kind == Kind::pack) find_in_pack();
    if (kind == Kind::tests)
      for (const rules::SpannedFinding& found : rules::read_tests_text(text, file).findings)
        add(found, text);
    if (kind == Kind::profile)
      for (const Issue& issue : load_profile(text, file, "").issues) add(issue);
  }

  void find_in_pack() {
    rules::ReadPack read = rules::read_pack_text(text, file, finder());
    for (const rules::SpannedFinding& found : read.findings)
      if (read.pack->source.is_in_first(found.where.begin))
        add(found, text);
      else
        add_beneath(found, read.pack->source);
    if (read.is_good) base.emplace(std::move(read.pack));
  }

  /// The piece of text that `where` has, at least a character where there is one on the line.
  [[nodiscard]] TextSpan shown(rules::SourceSpan where) const {
    TextSpan span{std::min(where.begin, text.size()), std::min(where.end, text.size())};
    span.end = std::max(span.begin, span.end);
    if (span.begin == span.end && span.end < text.size() && text[span.end] != '\n') ++span.end;
    while (span.end < text.size() && (static_cast<unsigned char>(text[span.end]) & 0xC0U) == 0x80U)
      ++span.end;
    return span;
  }

  void add(const rules::SpannedFinding& found, std::string_view of_text) {
    findings->push_back({found.severity, found.code, found.sentence, shown(found.where),
                         rules::fixes_of(of_text, found)});
  }

  void add_beneath(const rules::SpannedFinding& found, const rules::Source& source) {
    const Place place = source.place(found.where.begin);
    const TextSpan extends = span_of_extends();
    findings->push_back(
        {found.severity,
         found.code,
         fmt::format("in {}:{}:{}: {}", place.file, place.line, place.column, found.sentence),
         extends,
         {}});
  }

  TextSpan span_of_extends() {
    const rules::YamlNode* name = rules::find_value(read_layers().top().tree, "extends");
    return name == nullptr ? TextSpan{} : TextSpan{name->span.begin, name->span.end};
  }

  /// A finding of which only line and column are known: its span is the word there.
  void add(const Issue& issue) {
    rules::SpannedFinding found{{}, issue.severity, issue.code, issue.sentence};
    const std::size_t carets = issue.excerpt.rfind('\n');
    const std::string_view below =
        carets == std::string::npos ? "" : std::string_view(issue.excerpt).substr(carets + 1);
    const std::size_t width = below.size() - std::min(below.find('^'), below.size());
    // Columns of issues count characters; of profiles, which are ASCII, that is the same.
    found.where.begin =
        places.offset({std::max(issue.place.line, 1), std::max(issue.place.column, 1)});
    found.where.end = std::min(found.where.begin + width, text.size());
    add(found, text);
  }
};

EditedPack::EditedPack(std::string text, std::string file, OpenTexts open)
    : state_(std::make_unique<State>(std::move(text), std::move(file), std::move(open))) {}
EditedPack::~EditedPack() = default;
EditedPack::EditedPack(EditedPack&&) noexcept = default;
EditedPack& EditedPack::operator=(EditedPack&&) noexcept = default;

namespace {

bool is_same_file(const std::string& p, const std::string& q) {
  std::error_code problem;
  return p == q || std::filesystem::weakly_canonical(p, problem) ==
                       std::filesystem::weakly_canonical(q, problem);
}

/// Collects the places of a name in files.
class Renamer {
 public:
  Renamer(const rules::PackWord& word, const std::string& name)
      : word_(word), sort_(declared_sort(word)), name_(name) {}

  void add(const rules::PackLayers& of_file) {
    const rules::Source& source = of_file.top().source;
    FileEdits changes{source.file(), source.text(), {}};
    for (const TextSpan where : places_of(of_file, sort_, word_.name))
      changes.edits.push_back({where, name_});
    if (!changes.edits.empty()) renaming_.files.push_back(std::move(changes));
  }

  /// If the file stands upon the pack of the name, whatever is between.
  void add_upon(const rules::PackLayers& of_file, const std::string& pack) {
    const auto& all = of_file.all();
    const bool is_upon = std::any_of(
        std::next(all.begin()), all.end(),
        [&](const rules::PackLayer& layer) { return is_same_file(layer.source.file(), pack); });
    if (!is_upon) return;
    if (const rules::DeclaredName* taken = of_file.find(sort_, name_);
        taken != nullptr && name_ != word_.name && renaming_.refusal.empty())
      renaming_.refusal = fmt::format("'{}' is stated in {} already, which stands upon this pack",
                                      name_, taken->layer->source.file());
    add(of_file);
  }

  Renaming done() {
    if (!renaming_.refusal.empty()) renaming_.files.clear();
    return std::move(renaming_);
  }

 private:
  const rules::PackWord& word_;
  rules::WordSort sort_;
  const std::string& name_;
  Renaming renaming_;
};

}  // namespace

const std::string& EditedPack::text() const { return state_->text; }
const std::string& EditedPack::file() const { return state_->file; }
const TextPlaces& EditedPack::places() const { return state_->places; }
EditedPack::Kind EditedPack::kind() const { return state_->kind; }

const std::vector<TextFinding>& EditedPack::findings() const {
  if (!state_->findings) state_->find();
  return *state_->findings;
}

std::optional<RuleBase> EditedPack::rules() const {
  if (!state_->findings) state_->find();
  return state_->base;
}

std::vector<Completion> EditedPack::complete(std::size_t offset) const {
  if (kind() == Kind::other) return {};
  return rules::completions_at(state_->read_layers(), std::min(offset, text().size()));
}

std::optional<HoverText> EditedPack::hover(std::size_t offset) const {
  const rules::PackLayers& layers = state_->read_layers();
  if (const auto word = rules::word_at(layers, offset)) {
    std::string said = rules::hover_text(layers, *word);
    if (!said.empty()) return HoverText{std::move(said), {word->span.begin, word->span.end}};
  }
  auto key = kind() == Kind::other ? std::nullopt : rules::key_text(layers, offset);
  if (!key) return std::nullopt;
  return HoverText{std::move(key->text), {key->span.begin, key->span.end}};
}

std::optional<DefinitionPlace> EditedPack::definition(std::size_t offset) const {
  const rules::PackLayers& layers = state_->read_layers();
  const auto word = rules::word_at(layers, offset);
  if (!word) return std::nullopt;
  const rules::PackLayer* layer = nullptr;
  TextSpan span;
  if (const rules::DeclaredName* declared = rules::declaration_of(layers, *word)) {
    layer = declared->layer;
    span = {declared->span.begin, declared->span.end};
  } else if (word->sort == rules::WordSort::pack && layers.all().size() > 1) {
    layer = &layers.all()[1];
  }
  if (layer == nullptr) return std::nullopt;
  DefinitionPlace place;
  place.file = layer->source.file();
  place.is_here = layer == &layers.top();
  place.is_built_in = !place.is_here && embedded_text(place.file) == layer->source.text();
  const TextPlaces places(layer->source.text());
  place.begin = places.place(span.begin);
  place.end = places.place(span.end);
  return place;
}

std::vector<OutlineItem> EditedPack::outline() const {
  return rules::outline_of(state_->read_layers());
}

std::optional<TextSpan> EditedPack::renameable(std::size_t offset) const {
  const rules::PackLayers& layers = state_->read_layers();
  const auto word = rules::word_at(layers, offset);
  if (!word || !refuse_renaming(layers, *word).empty()) return std::nullopt;
  return TextSpan{word->span.begin, word->span.end};
}

Renaming EditedPack::rename(std::size_t offset, const std::string& name,
                            const std::vector<std::string>& others) const {
  const rules::PackLayers& layers = state_->read_layers();
  const auto word = rules::word_at(layers, offset);
  if (!word) return {{}, "there is no name here that could be changed"};
  std::string refusal = refuse_renaming(layers, *word);
  if (refusal.empty()) refusal = refuse_name(layers, *word, name);
  if (!refusal.empty()) return {{}, std::move(refusal)};
  Renamer renamer(*word, name);
  renamer.add(layers);
  if (kind() != Kind::pack || !file().ends_with(kYamlExtension)) return renamer.done();
  const std::string tests =
      file().substr(0, file().size() - kYamlExtension.size()) + std::string(kTestExtension);
  if (auto text_of_tests = text_open_or_stored(tests, state_->open))
    renamer.add(rules::PackLayers(without_byte_order_mark(std::move(*text_of_tests)), tests,
                                  [&](const std::string&) {
                                    return rules::FoundPack{file(), text()};
                                  }));
  for (const std::string& other : others) {
    if (is_same_file(other, file()) || is_same_file(other, tests)) continue;
    auto text_of_other = text_open_or_stored(other, state_->open);
    if (!text_of_other || text_of_other->size() > rules::kMostBytes) continue;
    const State upon(std::move(*text_of_other), other, state_->open);
    if (upon.kind == Kind::pack || upon.kind == Kind::tests)
      renamer.add_upon(rules::PackLayers(upon.text, upon.file, upon.finder()), file());
  }
  return renamer.done();
}

Checked<std::string> EditedPack::format() const {
  if (kind() != Kind::pack) return {};
  return format_pack(text(), file());
}

}  // namespace oriel
