#include "interpret/yaml/known_keys.h"

#include "interpret/pack/pack_grammar.h"
#include "interpret/plan/profile_grammar.h"
#include "interpret/testing/test_grammar.h"

namespace oriel::rules {

bool is_known_yaml_key(std::string_view word) {
  return word.size() > 1 && (pack_grammar().has_key(word) || profile_grammar().has_key(word) ||
                             test_grammar().has_key(word));
}

}  // namespace oriel::rules
