#pragma once

#include "io/cityjson/cityjson_source.h"
#include "io/document.h"
#include "io/json/text.h"
#include "io/reader.h"
#include "kernel/base/issue.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oriel::detail {

/// What the lines of a CityJSONSeq share.
struct SequenceHeader {
  Transform transform;
  std::string crs;
  std::string version;
  /// stream_header_facts of its text.
  std::string facts;
};

/// Reads CityJSON records; keeps simdjson's buffers between them.
class CityJsonReader {
 public:
  explicit CityJsonReader(ReadOptions options);
  ~CityJsonReader();
  CityJsonReader(const CityJsonReader&) = delete;
  CityJsonReader& operator=(const CityJsonReader&) = delete;

  /// The document in `text`: a CityJSON object, or a CityJSONFeature if `header` is given. An
  /// object with the same facts as the header (streams that were put together) has neither value
  /// nor issues. Behind one with other facts (E116) features are refused up to one with the same,
  /// and so are features with an id that an earlier one had (E207).
  Checked<Document> read(std::string text, const TextName& name,
                         const std::optional<SequenceHeader>& header);

  /// The last text that came without a value.
  [[nodiscard]] const std::string& refused() const;

  /// Objects with templates only, as Reader::take_unread().
  std::vector<UnreadObject> take_unread();

  /// What the last CityJSON object that was read says to the lines that follow it.
  [[nodiscard]] const SequenceHeader& header() const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace oriel::detail
