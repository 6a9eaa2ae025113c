#include "interpret/labelling/interpret.h"
#include "interpret/pack/rule_base.h"
#include "tests/fuzz/support/scene.h"
#include "tests/fuzz/support/scratch_file.h"
#include "tests/fuzz/targets.h"

#include <string>

namespace oriel::fuzz {

namespace {

/// The canonical form of a pack says the same, and stays as it is.
void check_formatted(std::string_view bytes) {
  static const ScratchFile file("a.yaml"), again("b.yaml");
  const auto once = format_pack_file(file.write(bytes));
  promise(once.value.has_value(), "a pack that loads can be formatted",
          once.issues.empty() ? "" : to_string(once.issues.front()));
  const auto twice = format_pack_file(again.write(*once.value));
  promise(twice.value.has_value(), "a pack that was formatted loads",
          twice.issues.empty() ? "" : to_string(twice.issues.front()));
  promise(*twice.value == *once.value, "a pack that is formatted twice stays as it is");
  const auto merged = merge_pack_file(file.path());
  promise(merged.value.has_value(), "a pack that loads can be merged",
          merged.issues.empty() ? "" : to_string(merged.issues.front()));
}

}  // namespace

/// A rule pack, run over a few features.
void packs(std::string_view bytes) {
  const auto pack = load_pack(std::string(bytes), "a.yaml");
  promise(pack.value.has_value() != has_errors(pack.issues), "a pack has a value or an error");
  for (const Issue& issue : pack.issues) {
    promise(issue.place.line >= 1 && issue.place.column >= 1, "a finding has a place",
            to_string(issue));
    promise(issue.code != Code::none, "a finding has a code", to_string(issue));
  }
  if (!pack.value) return;
  (void)interpret(*pack.value, scene().table, scene().graph);
  check_formatted(bytes);
}

}  // namespace oriel::fuzz
