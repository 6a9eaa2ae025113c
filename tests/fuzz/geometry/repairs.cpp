#include "oriel/repair.h"
#include "oriel/write.h"
#include "tests/fuzz/support/promises.h"
#include "tests/fuzz/targets.h"

#include <string>

namespace oriel::fuzz {

namespace {

PipelineOptions options_of(ByteSource& bytes) {
  PipelineOptions options = repair_defaults();
  if (bytes.flag()) options.repair.close = static_cast<Closing>(bytes.below(3));
  return options;
}

/// It need not be the same solid: planes are fitted anew to corners that the file's grid has moved.
void check_again(const std::string& text, const PipelineOptions& options) {
  const auto document = document_of(text);
  const Repaired again = repair(*document, document->buildings[0], options);
  promise_no_fault(again.issues);
  promise(again.solid.has_value(), "what was repaired can be repaired again",
          joined(error_codes(again.issues)));
}

}  // namespace

/// repair: what it writes is valid, and is a solid again when it is repaired again.
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
  const std::string text = write(*document, output);
  promise_valid(text, "repair");
  check_again(text, options);
}

}  // namespace oriel::fuzz
