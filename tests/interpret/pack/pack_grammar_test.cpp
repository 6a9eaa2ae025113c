#include "interpret/pack/pack_grammar.h"

#include "interpret/pack/rule_base.h"
#include "interpret/plan/operators.h"
#include "interpret/plan/profile_grammar.h"
#include "interpret/testing/test_grammar.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <yaml-cpp/yaml.h>

namespace oriel {
namespace {

using nlohmann::json;
namespace fs = std::filesystem;

const json& schema() {
  static const json parsed = json::parse(rules::pack_grammar().schema());
  return parsed;
}

/// A document as editors see it: YAML's numbers and truths are JSON's.
json as_json(const YAML::Node& node) {
  if (node.IsNull()) return nullptr;
  if (node.IsScalar()) {
    const std::string text = node.Scalar();
    if (node.Tag() != "?") return text;
    if (text == "true" || text == "false") return text == "true";
    static const std::regex number("[-+]?(0|[1-9][0-9]*)(\\.[0-9]+)?");
    return std::regex_match(text, number) ? json::parse(text) : json(text);
  }
  json value = node.IsSequence() ? json::array() : json::object();
  if (node.IsSequence())
    for (const auto& item : node) value.push_back(as_json(item));
  else
    for (const auto& entry : node) value[entry.first.Scalar()] = as_json(entry.second);
  return value;
}

bool is_of_type(const json& value, const std::string& type) {
  if (type == "integer") return value.is_number_integer();
  if (type == "number") return value.is_number();
  return value.type_name() == type;
}

/// So much of draft 7 as the schema uses; another keyword fails the test.
class Validator {
 public:
  explicit Validator(const json& root = schema()) : root_(root) {}

  bool conforms(const json& value, const json& rule) {
    return std::ranges::all_of(rule.items(), [&](const auto& keyword) {
      return holds(keyword.key(), keyword.value(), value, rule);
    });
  }

 private:
  bool holds(const std::string& keyword, const json& wanted, const json& value, const json& rule) {
    if (keyword == "$schema" || keyword == "$id" || keyword == "title" ||
        keyword == "description" || keyword == "defaultSnippets" || keyword == "definitions")
      return true;
    if (keyword == "$ref")
      return conforms(value, root_.at(json::json_pointer(wanted.get<std::string>().substr(1))));
    if (keyword == "const") return value == wanted;
    if (keyword == "enum") return std::ranges::find(wanted, value) != wanted.end();
    if (keyword == "anyOf")
      return std::ranges::any_of(wanted, [&](const json& one) { return conforms(value, one); });
    if (keyword == "type") {
      if (wanted.is_string()) return is_of_type(value, wanted);
      return std::ranges::any_of(wanted, [&](const json& one) { return is_of_type(value, one); });
    }
    if (keyword == "pattern")
      return !value.is_string() ||
             std::regex_search(value.get<std::string>(), std::regex(wanted.get<std::string>()));
    if (keyword == "minimum") return !value.is_number() || value >= wanted;
    if (keyword == "exclusiveMinimum") return !value.is_number() || value > wanted;
    if (keyword == "exclusiveMaximum") return !value.is_number() || value < wanted;
    if (keyword == "maximum") return !value.is_number() || value <= wanted;
    if (value.is_array()) return holds_of_list(keyword, wanted, value);
    return !value.is_object() || holds_of_map(keyword, wanted, value, rule);
  }

  bool holds_of_list(const std::string& keyword, const json& wanted, const json& value) {
    if (keyword == "minItems") return value.size() >= wanted;
    if (keyword == "items")
      return std::ranges::all_of(value, [&](const json& item) { return conforms(item, wanted); });
    return true;
  }

  bool holds_of_map(const std::string& keyword, const json& wanted, const json& value,
                    const json& rule) {
    if (keyword == "minProperties") return value.size() >= wanted;
    if (keyword == "maxProperties") return value.size() <= wanted;
    if (keyword == "required")
      return std::ranges::all_of(
          wanted, [&](const json& key) { return value.contains(key.get<std::string>()); });
    if (keyword != "properties" && keyword != "additionalProperties") {
      CHECK_MESSAGE((keyword == "items" || keyword == "minItems"), keyword);
      return true;
    }
    return std::ranges::all_of(value.items(), [&](const auto& member) {
      const bool is_named =
          rule.contains("properties") && rule["properties"].contains(member.key());
      if (is_named != (keyword == "properties")) return true;
      if (is_named) return conforms(member.value(), wanted[member.key()]);
      return wanted.is_boolean() ? wanted.get<bool>() : conforms(member.value(), wanted);
    });
  }

  const json& root_;
};

/// How many files of a folder conform; all with that end have to.
std::size_t conforming(const char* folder, const std::string& end, const json& root) {
  std::size_t files = 0;
  for (const auto& entry : fs::directory_iterator(fs::path(ORIEL_SOURCE_DIR) / folder)) {
    const std::string path = entry.path();
    if (!path.ends_with(end)) continue;
    CAPTURE(path);
    CHECK(Validator(root).conforms(as_json(YAML::LoadFile(path)), root));
    ++files;
  }
  return files;
}

bool conforms(const std::string& text) {
  return Validator().conforms(as_json(YAML::Load(text)), schema());
}

/// A pack in which `sections` stand beside what every pack has.
std::string pack_of(const std::string& sections) {
  return "schema: oriel/1\npack: {name: t, version: 1.0.0}\n" +
         std::string(sections.starts_with("classes:") ? "" : "classes: {window: {}}\n") + sections +
         (sections.find("rules:") == std::string::npos
              ? "rules: [{id: w, label: window, require: natural}]\n"
              : "");
}

/// The keys that the loader names where it finds the key `zzz` in a pack.
std::set<std::string> keys_of_loader(const std::string& pack) {
  std::set<std::string> keys;
  for (const Issue& issue : load_pack(pack, "t.yaml").issues) {
    const std::size_t at = issue.sentence.find("(keys: ");
    if (issue.code != Code::R209 || at == std::string::npos) continue;
    std::string list = issue.sentence.substr(at + 7);
    list.back() = ',';
    while (!list.empty()) {
      keys.insert(list.substr(0, list.find(',')));
      list.erase(0, list.find(',') + 1);
      list.erase(0, list.find_first_not_of(' '));
    }
  }
  return keys;
}

/// Adds all keys with a fixed name.
void add_keys(const json& rule, std::set<std::string>& keys) {
  if (rule.is_object() && rule.contains("properties"))
    for (const auto& property : rule["properties"].items()) keys.insert(property.key());
  for (const auto& inside : rule.items())
    if (inside.key() != "defaultSnippets" && inside.value().is_structured())
      add_keys(inside.value(), keys);
}

/// The keys without a description, with their paths.
void find_undescribed(const json& rule, const std::string& path, std::vector<std::string>& found) {
  if (rule.is_array())
    for (const json& one : rule) find_undescribed(one, path, found);
  if (!rule.is_object()) return;
  for (const auto& member : rule.items()) {
    if (member.key() == "defaultSnippets") continue;
    if (member.key() == "properties" && member.value().is_object())
      for (const auto& property : member.value().items())
        if (property.value().value("description", "").size() < 5)
          found.push_back(path + "/" + property.key());
    find_undescribed(member.value(), path + "/" + member.key(), found);
  }
}

/// A snippet as an editor inserts it: `${1:text}` is text, and `^` before it makes a number of it.
json inserted(const json& body) {
  if (body.is_string()) {
    std::string text = body;
    const bool is_number = text.starts_with("^");
    if (is_number) text.erase(0, 1);
    text = std::regex_replace(text, std::regex("\\$\\{[0-9]+:([^}]*)\\}"), "$1");
    return is_number ? json::parse(text) : json(text);
  }
  if (body.is_array()) {
    json list = json::array();
    for (const json& item : body) list.push_back(inserted(item));
    return list;
  }
  if (!body.is_object()) return body;
  json map = json::object();
  for (const auto& member : body.items())
    map[inserted(json(member.key())).get<std::string>()] = inserted(member.value());
  return map;
}

std::set<std::string> keys_of_schema(const json& rule) {
  std::set<std::string> keys;
  for (const auto& property : rule.at("properties").items()) keys.insert(property.key());
  return keys;
}

TEST_SUITE("interpret") {
  TEST_CASE("every pack that loads conforms to the schema") {
    std::size_t packs = 0;
    for (const char* folder : {"rules", "rules/starter", "bench/rules", "tests/data/rules"})
      for (const auto& entry : fs::directory_iterator(fs::path(ORIEL_SOURCE_DIR) / folder)) {
        const std::string path = entry.path();
        if (!path.ends_with(".yaml") || !load_pack_file(path).value) continue;
        CAPTURE(path);
        CHECK(Validator().conforms(as_json(YAML::LoadFile(path)), schema()));
        ++packs;
      }
    CHECK(packs >= 3);
  }

  TEST_CASE("profiles and tests conform to their schemas and say what each key means") {
    const json of_profiles = json::parse(rules::profile_grammar().schema());
    const json of_tests = json::parse(rules::test_grammar().schema());
    CHECK(conforming("rules/profiles", ".yaml", of_profiles) >= 5);
    CHECK(conforming("rules", ".test.yaml", of_tests) +
              conforming("rules/starter", ".test.yaml", of_tests) >=
          2);
    std::vector<std::string> undescribed;
    find_undescribed(of_profiles, "profile", undescribed);
    find_undescribed(of_tests, "tests", undescribed);
    for (const std::string& key : undescribed) FAIL_CHECK(key);
    const json wrong = as_json(YAML::Load("{tests_for: p, tests: [{name: n, givn: f}]}"));
    CHECK_FALSE(Validator(of_tests).conforms(wrong, of_tests));
  }

  TEST_CASE("the pages name every key of packs and profiles and tests") {
    std::string pages;
    for (const char* page : {"docs/rules.md", "docs/generalisation.md"}) {
      std::ifstream file(fs::path(ORIEL_SOURCE_DIR) / page);
      pages.append(std::istreambuf_iterator<char>(file), {});
    }
    std::set<std::string> keys;
    for (const auto* grammar :
         {&rules::pack_grammar(), &rules::profile_grammar(), &rules::test_grammar()})
      add_keys(json::parse(grammar->schema()), keys);
    CHECK(keys.size() > 100);
    for (const std::string& key : keys) {
      const bool is_named = pages.find(key + ":") != std::string::npos ||
                            pages.find("`" + key + "`") != std::string::npos;
      CHECK_MESSAGE(is_named, key);
    }
  }

  TEST_CASE("wrong packs whose form is wrong do not conform to the schema") {
    std::size_t packs = 0;
    for (const char* name :
         {"empty", "no_label", "no_rules", "bare_yes", "other_schema", "too_many_rounds",
          "unknown_operator", "unknown_section", "code_without_quotes", "scale_without_one"}) {
      CAPTURE(std::string(name));
      const auto path =
          fs::path(ORIEL_SOURCE_DIR) / "tests/data/rules" / (std::string(name) + ".yaml");
      REQUIRE(fs::exists(path));
      CHECK_FALSE(load_pack_file(path).value);
      CHECK_FALSE(Validator().conforms(as_json(YAML::LoadFile(path)), schema()));
      ++packs;
    }
    CHECK(packs == 10);
  }

  TEST_CASE("the schema has the keys that the loader knows everywhere") {
    const auto check = [](const char* definition, const std::string& sections) {
      CAPTURE(definition);
      const std::string pack = pack_of(sections);
      CHECK_FALSE(conforms(pack));
      const auto keys = keys_of_loader(pack);
      CHECK_FALSE(keys.empty());
      CHECK(keys == keys_of_schema(schema()["definitions"][definition]));
    };
    CHECK(keys_of_loader(pack_of("zzz: 1\n")) == keys_of_schema(schema()));
    CHECK(keys_of_loader("schema: oriel/1\npack: {zzz: 1}\nrules: []\n") ==
          keys_of_schema(schema()["definitions"]["header"]));
    check("param", "params: {p: {zzz: 1}}\n");
    check("hosts", "hosts: {zzz: 1}\n");
    check("class", "classes: {window: {}, door: {zzz: 1}}\n");
    check("typical", "classes: {window: {typical: {zzz: 1 .. 2}}}\n");
    check("relation", "relations: {r: {zzz: 1}}\n");
    check("rule", "rules: [{zzz: 1}]\n");
    check("judgement", "rules: [{id: w, label: window, require: natural, score: [a: {zzz: 1}]}]\n");
    check("decide", "decide: {zzz: 1}\n");
    check("iterate", "iterate: {zzz: 1}\n");
    check("group", "groups: {g: {zzz: 1}}\n");
    check("emission", "emit: {window: {zzz: 1}}\n");
    check("surface", "surfaces: [{zzz: 1}]\n");
    check("entry", "generalise: [{zzz: 1}]\n");
  }

  TEST_CASE("the schema has an id and a description for every key") {
    CHECK(schema()["$id"] == "urn:oriel:schema:oriel-1");
    std::vector<std::string> undescribed;
    find_undescribed(schema(), "", undescribed);
    for (const std::string& key : undescribed) FAIL_CHECK(key);
  }

  TEST_CASE("what editors offer as snippets conforms to the schema") {
    std::size_t snippets = 0;
    const auto check = [&](const json& rule) {
      for (const json& snippet : rule.value("defaultSnippets", json::array())) {
        CAPTURE(snippet.dump());
        CHECK(Validator().conforms(inserted(snippet.at("body")), rule));
        CHECK_FALSE(snippet.at("label").get<std::string>().empty());
        CHECK_FALSE(snippet.at("description").get<std::string>().empty());
        ++snippets;
      }
    };
    check(schema());
    for (const auto& definition : schema()["definitions"].items()) check(definition.value());
    CHECK(snippets >= 10);
  }

  TEST_CASE("the schema has the operators that a pack may name with their arguments") {
    const json& operations = schema()["definitions"]["operation"]["anyOf"];
    std::size_t built = 0;
    for (const OperatorKind& kind : operator_table()) {
      CAPTURE(kind.name);
      const bool is_named =
          std::ranges::find(operations[0]["enum"], json(kind.name)) != operations[0]["enum"].end();
      CHECK(is_named);
      if (kind.arguments.empty()) continue;
      ++built;
      const auto keys = keys_of_loader(pack_of(fmt::format(
          "generalise: [{{id: e, scale: '1:1000 ..', for: any, do: {{{}: {{zzz: 1}}}}}}]\n",
          kind.name)));
      CHECK(keys == keys_of_schema(operations[1]["properties"][kind.name]));
    }
    CHECK(built > 0);
  }
}

}  // namespace
}  // namespace oriel
