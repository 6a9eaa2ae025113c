#include "studio/lsp/editing_json.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

using Json = nlohmann::ordered_json;

std::string as_text(const Json& json) {
  return json.dump(-1, ' ', false, Json::error_handler_t::replace);
}

Json edit_json(const TextPlaces& places, const TextEdit& edit) {
  Json json = range_json(places, edit.where);
  json["text"] = edit.text;
  return json;
}

Json fixes_json(const TextPlaces& places, const std::vector<QuickFix>& fixes) {
  Json list = Json::array();
  for (const QuickFix& fix : fixes) {
    Json edits = Json::array();
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

Json complete(const LanguageQuestion& question) {
  const TextPlaces& places = question.pack.places();
  Json items = Json::array();
  for (const Completion& item : question.pack.complete(question.offset))
    items.push_back({{"label", item.label},
                     {"kind", item.kind},
                     {"detail", item.detail},
                     {"documentation", item.documentation},
                     {"insert", item.insert},
                     {"from_column", places.place(item.replaced.begin).column}});
  return {{"items", std::move(items)}};
}

Json hover(const LanguageQuestion& question) {
  const auto hover = question.pack.hover(question.offset);
  if (!hover) return nullptr;
  Json json{{"text", hover->text}};
  json.update(range_json(question.pack.places(), hover->where));
  return json;
}

Json definition(const LanguageQuestion& question) {
  const auto place = question.pack.definition(question.offset);
  if (!place) return nullptr;
  Json json{{"line", place->begin.line},
            {"column", place->begin.column},
            {"end_line", place->end.line},
            {"end_column", place->end.column}};
  json["file"] = place->is_here ? Json(nullptr) : Json(place->file);
  return json;
}

/// Only the edits of the pack itself: the page has no other text open.
Json rename(const LanguageQuestion& question) {
  const Renaming renaming = question.pack.rename(question.offset, question.name);
  if (!renaming.refusal.empty()) return {{"error", renaming.refusal}};
  Json edits = Json::array();
  for (const FileEdits& file : renaming.files)
    if (file.file == question.pack.file())
      for (const TextEdit& edit : file.edits)
        edits.push_back(edit_json(question.pack.places(), edit));
  return {{"edits", std::move(edits)}};
}

Json format(const LanguageQuestion& question) {
  const auto formatted = question.pack.format();
  if (formatted.value) return {{"text", *formatted.value}};
  return {{"findings", findings_json(question.pack)}};
}

Json outline(const LanguageQuestion& question) {
  const TextPlaces& places = question.pack.places();
  Json items = Json::array();
  for (const OutlineItem& item : question.pack.outline())
    items.push_back({{"kind", item.kind},
                     {"name", item.name},
                     {"section", item.section},
                     {"parent", item.parent},
                     {"detail", item.detail},
                     {"line", places.place(item.where.begin).line},
                     {"end_line", places.place(item.where.end).line}});
  return {{"items", std::move(items)}};
}

Json fixes(const LanguageQuestion& question) {
  return {{"findings", findings_json(question.pack)}};
}

struct LanguageVerb {
  std::string_view name{};
  Json (*answer)(const LanguageQuestion&);
};
constexpr std::array<LanguageVerb, 7> kVerbs = {{{"complete", complete},
                                                 {"hover", hover},
                                                 {"definition", definition},
                                                 {"rename", rename},
                                                 {"format", format},
                                                 {"outline", outline},
                                                 {"fixes", fixes}}};

std::optional<std::string> text_member(const Json& body, const char* key) {
  const auto found = body.find(key);
  if (found == body.end() || !found->is_string()) return std::nullopt;
  return found->get<std::string>();
}

/// A line or a column, 1 where there is none.
int number_member(const Json& body, const char* key) {
  const auto found = body.find(key);
  if (found == body.end() || !found->is_number_integer()) return 1;
  return static_cast<int>(std::clamp<std::int64_t>(found->get<std::int64_t>(), 1, 1'000'000'000));
}

}  // namespace

Json range_json(const TextPlaces& places, TextSpan where) {
  const TextPlace begin = places.place(where.begin);
  const TextPlace end = places.place(where.end);
  return {{"line", begin.line},
          {"column", begin.column},
          {"end_line", end.line},
          {"end_column", end.column}};
}

Json findings_json(const EditedPack& pack) {
  Json list = Json::array();
  for (const TextFinding& finding : pack.findings()) {
    const std::size_t advice = begin_of_advice(finding.sentence);
    Json json{{"code", to_string(finding.code)},
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
  const Json json = Json::parse(body, nullptr, false);
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
  Json answer = known->answer(question);
  if (answer.is_object() && answer.contains("error"))
    return error_reply(409, answer["error"].get<std::string>());
  return {200, as_text(answer)};
}

}  // namespace oriel::studio
