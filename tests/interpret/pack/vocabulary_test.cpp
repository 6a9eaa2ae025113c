#include "interpret/pack/vocabulary.h"

#include "interpret/plan/operators.h"
#include "model/description/attributes.h"
#include "tests/interpret/support.h"

using namespace oriel;
using namespace oriel::test;

namespace {

/// Errors of a pack in which the example stands.
std::string errors_in(const std::string& text) {
  std::string errors;
  for (const Issue& issue : load_pack(text, "t.yaml").issues)
    if (issue.severity == Severity::error) errors += to_string(issue) + "\n";
  return errors;
}

std::vector<std::string> names_in(const std::vector<VocabularyWord>& words) {
  std::vector<std::string> names;
  for (const VocabularyWord& word : words) names.push_back(word.name);
  return names;
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("the lists are those that the engine itself uses") {
    REQUIRE(attribute_words().size() == feature_schema().size());
    REQUIRE(surface_attribute_words().size() == surface_schema().size());
    REQUIRE(relation_words().size() == relation_schema().size());
    REQUIRE(operator_words().size() == operator_table().size());
    for (std::size_t i = 0; i < feature_schema().size(); ++i) {
      CHECK(attribute_words()[i].name == feature_schema()[i].name);
      CHECK(attribute_words()[i].meaning == feature_schema()[i].meaning);
    }
    CHECK(names_in(relation_words()).front() == "host");
  }

  TEST_CASE("every word has a meaning and an example and attributes a unit") {
    for (const auto& words :
         {attribute_words(), surface_attribute_words(), relation_words(), operator_words()})
      for (const VocabularyWord& word : words) {
        CAPTURE(word.name);
        CHECK_FALSE(word.meaning.empty());
        CHECK(word.example.find(word.name) != std::string::npos);
      }
    for (const VocabularyWord& word : attribute_words()) CHECK_FALSE(word.unit.empty());
    for (const VocabularyWord& word : surface_attribute_words()) CHECK_FALSE(word.unit.empty());
  }

  TEST_CASE("every example can be put into a pack as it is") {
    for (const auto& words : {attribute_words(), relation_words()})
      for (const VocabularyWord& word : words)
        CHECK(errors_in(pack_requiring({word.example})) == "");
    for (const VocabularyWord& word : surface_attribute_words())
      CHECK(errors_in(pack_with("rules: []\nsurfaces:\n  - {id: s, type: RoofSurface, when: \"" +
                                word.example + "\"}\n")) == "");
    for (const VocabularyWord& word : operator_words())
      CHECK(errors_in(pack_with(
                "rules: []\ngeneralise:\n  - {id: g, scale: \"1:500 ..\", for: any, do: " +
                word.example + "}\n")) == "");
  }

  TEST_CASE("a word is found by its name and by what others call it") {
    CHECK(find_word(attribute_words(), "slope")->name == "inclination");
    CHECK(find_word(attribute_words(), "base_height_m")->name == "base_height");
    CHECK(find_word(attribute_words(), "area")->name == "silhouette");
    CHECK(find_word(surface_attribute_words(), "area")->name == "area");
    CHECK(find_word(operator_words(), "delete")->name == "omit");
    CHECK(find_word(relation_words(), "adjacent")->name == "beside");
    CHECK_FALSE(find_word(relation_words(), "colour"));
  }
}
