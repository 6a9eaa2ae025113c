#include "studio/lsp/editing_json.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

std::string as_text(const JsonValue& json) {
  return json.dump(-1, ' ', false, JsonValue::error_handler_t::replace);
}

JsonValue edit_json(const TextPlaces& places, const TextEdit& edit) {
  JsonValue json = range_json(places, edit.where);
  json["text"] = edit.text;
  return json;
}

JsonValue fixes_json(const TextPlaces& places, const std::vector<QuickFix>& fixes) {
  JsonValue list = JsonValue::array();
  for (const QuickFix& fix : fixes) {
    JsonValue edits = JsonValue::array();
    for (const TextEdit& edit : fix.edits) edits.push_back(edit_json(places, edit));
    list.push_back({{"title", fix.title}, {"edits", std::move(edits)}});
  }
  return list;
}

/// Where what a message suggests begins: "; did you mean 'height'?".
std::size_t begin_of_advice(const std::string& sentence) {
  return std::min(sentence.find("; "), sentence.size());
}

/// A request of the page, read.
struct LanguageQuestion {
  std::string verb{};
  std::string name{};
  EditedPack pack;
  std::size_t offset = 0;
};

/// The page has fewer kinds than editors: a predicate is a class there, an entry is called by its
/// section.
std::string kind_on_page(const std::string& kind, const std::string& section = "") {
  if (kind == "predicate") return "class";
  if (kind == "attribute of surfaces") return "attribute";
  return kind == "entry" && !section.empty() ? section : kind;
}

JsonValue complete(const LanguageQuestion& question) {
  const TextPlaces& places = question.pack.places();
  JsonValue items = JsonValue::array();
  for (const Completion& item : question.pack.complete(question.offset))
    items.push_back({{"label", item.label},
                     {"kind", kind_on_page(item.kind)},
                     {"detail", item.detail},
                     {"documentation", item.documentation},
                     {"insert", item.insert},
                     {"from_column", places.place(item.replaced.begin).column}});
  return {{"items", std::move(items)}};
}

JsonValue hover(const LanguageQuestion& question) {
  const auto hover = question.pack.hover(question.offset);
  if (!hover) return nullptr;
  JsonValue json{{"text", hover->text}};
  json.update(range_json(question.pack.places(), hover->where));
  return json;
}

/// The page has no other text than the pack: what is stated elsewhere has no place there.
JsonValue definition(const LanguageQuestion& question) {
  const auto place = question.pack.definition(question.offset);
  if (!place || !place->is_here) return nullptr;
  return {{"line", place->begin.line},
          {"column", place->begin.column},
          {"end_line", place->end.line},
          {"end_column", place->end.column}};
}

/// Only the edits of the pack itself: the page has no other text open.
JsonValue rename(const LanguageQuestion& question) {
  const Renaming renaming = question.pack.rename(question.offset, question.name);
  if (!renaming.refusal.empty()) return {{"error", renaming.refusal}};
  JsonValue edits = JsonValue::array();
  for (const FileEdits& file : renaming.files)
    if (file.file == question.pack.file())
      for (const TextEdit& edit : file.edits)
        edits.push_back(edit_json(question.pack.places(), edit));
  return {{"edits", std::move(edits)}};
}

JsonValue format(const LanguageQuestion& question) {
  const auto formatted = question.pack.format();
  if (formatted.value) return {{"text", *formatted.value}};
  return {{"findings", findings_json(question.pack)}};
}

JsonValue outline(const LanguageQuestion& question) {
  const TextPlaces& places = question.pack.places();
  JsonValue items = JsonValue::array();
  for (const OutlineItem& item : question.pack.outline())
    items.push_back({{"kind", kind_on_page(item.kind, item.section)},
                     {"name", item.name},
                     {"section", item.section},
                     {"parent", item.parent.empty() ? JsonValue(nullptr) : JsonValue(item.parent)},
                     {"detail", item.detail},
                     {"line", places.place(item.where.begin).line},
                     {"end_line", places.place(item.where.end).line}});
  return {{"items", std::move(items)}};
}

/// Those of the findings at the place.
JsonValue fixes(const LanguageQuestion& question) {
  JsonValue all = JsonValue::array();
  for (const TextFinding& finding : question.pack.findings()) {
    const bool is_there =
        finding.where.begin <= question.offset && question.offset <= finding.where.end;
    if (!is_there) continue;
    for (JsonValue& fix : fixes_json(question.pack.places(), finding.fixes))
      all.push_back(std::move(fix));
  }
  return {{"fixes", std::move(all)}};
}

struct LanguageVerb {
  std::string_view name{};
  JsonValue (*answer)(const LanguageQuestion&);
};
constexpr std::array<LanguageVerb, 7> kVerbs = {{{"complete", complete},
                                                 {"hover", hover},
                                                 {"definition", definition},
                                                 {"rename", rename},
                                                 {"format", format},
                                                 {"outline", outline},
                                                 {"fixes", fixes}}};

std::optional<std::string> text_member(const JsonValue& body, const char* key) {
  const auto found = body.find(key);
  if (found == body.end() || !found->is_string()) return std::nullopt;
  return found->get<std::string>();
}

/// A line or a column, 1 where there is none.
int number_member(const JsonValue& body, const char* key) {
  const auto found = body.find(key);
  if (found == body.end() || !found->is_number_integer()) return 1;
  return static_cast<int>(std::clamp<std::int64_t>(found->get<std::int64_t>(), 1, 1'000'000'000));
}

}  // namespace

JsonValue range_json(const TextPlaces& places, TextSpan where) {
  const TextPlace begin = places.place(where.begin);
  const TextPlace end = places.place(where.end);
  return {{"line", begin.line},
          {"column", begin.column},
          {"end_line", end.line},
          {"end_column", end.column}};
}

JsonValue findings_json(const EditedPack& pack) {
  JsonValue list = JsonValue::array();
  for (const TextFinding& finding : pack.findings()) {
    const std::size_t advice = begin_of_advice(finding.sentence);
    JsonValue json{
        {"code", to_string(finding.code)},
        {"severity", to_string(finding.severity)},
        {"sentence", finding.sentence.substr(0, advice)},
        {"advice", finding.sentence.substr(std::min(advice + 2, finding.sentence.size()))}};
    json.update(range_json(pack.places(), finding.where));
    json["fixes"] = fixes_json(pack.places(), finding.fixes);
    list.push_back(std::move(json));
  }
  return list;
}

Reply answer_language(std::string_view body, const std::string& file) {
  const JsonValue json = JsonValue::parse(body, nullptr, false);
  if (!json.is_object()) return error_reply(400, "the request is no JSON object");
  const auto verb = text_member(json, "verb");
  const auto text = text_member(json, "text");
  if (!verb || !text) return error_reply(400, "the request needs the texts 'verb' and 'text'");
  const auto* known = std::ranges::find(kVerbs, *verb, &LanguageVerb::name);
  if (known == kVerbs.end())
    return error_reply(400, fmt::format("there is no '{}' to ask of a text", *verb));
  LanguageQuestion question{*verb, text_member(json, "name").value_or(""), {*text, file}};
  question.offset =
      question.pack.places().offset({number_member(json, "line"), number_member(json, "column")});
  JsonValue answer = known->answer(question);
  if (answer.is_object() && answer.contains("error"))
    return error_reply(409, answer["error"].get<std::string>());
  return {200, as_text(answer)};
}

}  // namespace oriel::studio
