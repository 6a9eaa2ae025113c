#pragma once

#include "io/document.h"
#include "kernel/base/issue.h"
#include "model/building.h"
#include "oriel/result.h"
#include "tests/fuzz/support/byte_source.h"

#include <optional>
#include <string>
#include <vector>

/// What the targets of geometry/ ask of results.
namespace oriel::fuzz {

/// No issue is a fault of oriel's own (E901).
void promise_no_fault(const std::vector<Issue>& issues);

/// Every building of a CityJSON text is valid; `what` says who wrote it.
void promise_valid(const std::string& text, const char* what);

/// The one record of a CityJSON text; nothing if there is no building in it.
std::optional<Document> document_of(const std::string& text);

/// A changed body as it is read from a file whose vertices are on the millimetre or on kUnit_m.
std::optional<Document> changed_document(ByteSource& bytes);

/// The labels of all features, sorted, with what kind of feature each is: "hole window".
std::vector<std::string> labels_of(const PipelineResult& result);

/// "hole window, protrusion chimney".
std::string joined(const std::vector<std::string>& words);

/// The codes of the errors among issues, sorted, without repetition.
std::vector<std::string> error_codes(const std::vector<Issue>& issues);

}  // namespace oriel::fuzz
