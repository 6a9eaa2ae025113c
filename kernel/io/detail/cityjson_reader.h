#pragma once

#include "kernel/io/detail/cityjson_source.h"
#include "kernel/io/detail/text.h"
#include "kernel/io/document.h"
#include "kernel/model/issue.h"

#include <memory>
#include <optional>
#include <string>

namespace oriel::detail {

/// What the lines of a CityJSONSeq share.
struct SequenceHeader {
  Transform transform;
  std::string crs;
};

/// Reads CityJSON records; keeps simdjson's buffers between them.
class CityJsonReader {
 public:
  /// `lod` as in ReadOptions.
  explicit CityJsonReader(std::optional<std::string> lod);
  ~CityJsonReader();
  CityJsonReader(const CityJsonReader&) = delete;
  CityJsonReader& operator=(const CityJsonReader&) = delete;

  /// The document in `text`: a CityJSON object, or a CityJSONFeature if `header` is given.
  Checked<Document> read(std::string text, const TextName& name,
                         const std::optional<SequenceHeader>& header);

  /// The last text that came without a value.
  [[nodiscard]] const std::string& refused() const;

  /// What the last CityJSON object that was read says to the lines that follow it.
  [[nodiscard]] const SequenceHeader& header() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace oriel::detail
