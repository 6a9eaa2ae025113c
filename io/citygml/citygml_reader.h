#pragma once

#include "io/document.h"
#include "io/files/input.h"
#include "io/json/text.h"
#include "io/reader.h"
#include "io/unread_object.h"
#include "kernel/base/issue.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oriel::detail {

/// Reads CityGML 1.0, 2.0 and 3.0, a building at a time. Each becomes a CityJSONFeature, in memory,
/// that the CityJSON reader reads: so levels of detail, families and semantics are what they are
/// there.
class CityGmlReader {
 public:
  /// `input` must outlive the reader.
  CityGmlReader(Input& input, TextName name, const ReadOptions& options);
  ~CityGmlReader();
  CityGmlReader(const CityGmlReader&) = delete;
  CityGmlReader& operator=(const CityGmlReader&) = delete;

  /// First a header without buildings, then a document for each Building with its parts, which has
  /// no building if that has a fault. A document without a value where the file cannot be read on;
  /// nothing after that, or at the end.
  std::optional<Checked<Document>> next();

  /// As Reader::take_unread().
  std::vector<UnreadObject> take_unread();

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace oriel::detail
