#include "interpret/explain/explain.h"
#include "interpret/labelling/interpret.h"
#include "interpret/pack/rule_base.h"
#include "tests/fuzz/support/scene.h"
#include "tests/fuzz/targets.h"

#include <string>

namespace oriel::fuzz {

namespace {

/// In double quotes it may have every byte but those that end the quotes; YAML refuses some.
std::string pack_requiring(std::string_view expression) {
  std::string text =
      "schema: oriel/1\n"
      "pack: {name: fuzz, version: 1.0.0}\n"
      "params:\n"
      "  low: {value: 1 m, range: 0 m .. 2 m, why: a test}\n"
      "  share: {value: 20 %, range: 0 % .. 50 %, why: a test}\n"
      "classes: {window: {}, door: {}}\n"
      "rules:\n"
      "  - id: w\n"
      "    label: window\n"
      "    require:\n"
      "      - \"";
  for (const char byte : expression) text += byte == '"' || byte == '\\' ? ' ' : byte;
  return text + "\"\n";
}

}  // namespace

/// A condition of a rule, and what it makes of a few features, with the reasons.
void expressions(std::string_view bytes) {
  const auto pack = load_pack(pack_requiring(bytes), "a.yaml");
  promise(pack.value.has_value() != has_errors(pack.issues), "a condition has a value or an error");
  for (const Issue& issue : pack.issues)
    promise(issue.place.line >= 1 && issue.place.column >= 1, "a finding has a place",
            to_string(issue));
  if (!pack.value) return;
  const Interpretation once = interpret(*pack.value, scene().table, scene().graph);
  for (const Verdict& verdict : once.verdicts) {
    const Explanation why =
        explain(*pack.value, scene().table, scene().graph, once, verdict.feature);
    (void)to_text(why);
    (void)to_json(why);
  }
}

}  // namespace oriel::fuzz
