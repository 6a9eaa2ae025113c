#include "oriel/repair.h"
#include "oriel/write.h"
#include "tests/fuzz/support/promises.h"
#include "tests/fuzz/targets.h"

namespace oriel::fuzz {

namespace {

PipelineOptions options_of(ByteSource& bytes) {
  PipelineOptions options = repair_defaults();
  if (bytes.flag()) options.repair.close = static_cast<Closing>(bytes.below(3));
  return options;
}

}  // namespace

/// repair: what it writes is valid.
void repairs(std::string_view input) {
  ByteSource bytes(input);
  const PipelineOptions options = options_of(bytes);
  const auto document = changed_document(bytes);
  if (!document) return;
  const Repaired repaired = repair(*document, document->buildings[0], options);
  promise_no_fault(repaired.issues);
  promise(repaired.solid.has_value() != has_errors(repaired.issues), "a solid or an error");
  if (!repaired.solid) return;
  OutputRecord output;
  add(repaired.output, output);
  promise_valid(write(*document, output), "repair");
}

}  // namespace oriel::fuzz
