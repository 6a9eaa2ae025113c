#include "tests/fuzz/support/promises.h"

#include "io/reader.h"
#include "kernel/validate/validate.h"
#include "tests/fuzz/support/bodies.h"
#include "tests/fuzz/support/retold.h"
#include "tests/fuzz/support/scratch_file.h"
#include "tests/fuzz/targets.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::fuzz {

void promise_no_fault(const std::vector<Issue>& issues) {
  for (const Issue& issue : issues)
    promise(issue.code != Code::E901, "no building shows a fault of oriel's own", to_string(issue));
}

std::optional<Document> document_of(const std::string& text) {
  static const ScratchFile file("a.city.json");
  Reader reader(file.write(text), {});
  auto record = reader.next();
  if (!record || !record->value || record->value->buildings.empty()) return std::nullopt;
  return std::move(*record->value);
}

std::optional<Document> changed_document(ByteSource& bytes) {
  const double scale_m = bytes.flag() ? kUnit_m : 0.001;
  return document_of(cityjson_of(changed_body(bytes).building, scale_m));
}

void promise_valid(const std::string& text, const char* what) {
  const auto document = document_of(text);
  promise(document.has_value(), "what was written can be read", what);
  for (const Building& building : document->buildings)
    for (const Finding& finding : validate(building))
      throw BrokenPromise(fmt::format("what {} wrote is valid: {} {} {}", what,
                                      to_string(finding.code), finding.val3dity, finding.sentence));
}

std::vector<std::string> labels_of(const PipelineResult& result) {
  std::vector<std::string> labels;
  for (std::size_t i = 0; i < result.interpretation.verdicts.size(); ++i) {
    const std::string label(result.interpretation.verdicts[i].label);
    labels.push_back(to_string(result.segmentation->features[i].sense) + " " + label);
  }
  std::ranges::sort(labels);
  return labels;
}

std::string joined(const std::vector<std::string>& words) {
  return fmt::format("{}", fmt::join(words, ", "));
}

std::vector<std::string> error_codes(const std::vector<Issue>& issues) {
  std::vector<std::string> codes;
  for (const Issue& issue : issues)
    if (issue.severity == Severity::error) codes.push_back(to_string(issue.code));
  std::ranges::sort(codes);
  codes.erase(std::unique(codes.begin(), codes.end()), codes.end());
  return codes;
}

}  // namespace oriel::fuzz
