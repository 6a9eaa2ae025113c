#include "interpret/yaml/known_keys.h"

#include "interpret/pack/pack_schema.h"

#include <set>
#include <string>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

using namespace oriel;
using namespace oriel::rules;

namespace {

void add_keys(const nlohmann::json& schema, std::set<std::string>& keys) {
  if (schema.is_object() && schema.contains("properties"))
    for (const auto& [key, value] : schema["properties"].items()) keys.insert(key);
  for (const auto& inside : schema)
    if (inside.is_structured()) add_keys(inside, keys);
}

}  // namespace

TEST_SUITE("interpret") {
  TEST_CASE("the keys that are known are those of the schema") {
    std::set<std::string> keys;
    add_keys(nlohmann::json::parse(pack_schema()), keys);
    CHECK(keys.size() > 60);
    for (const std::string& key : keys) {
      CAPTURE(key);
      const bool has_blank = key.find(' ') != std::string::npos;
      CHECK((has_blank || is_known_yaml_key(key)));
    }
  }
}
