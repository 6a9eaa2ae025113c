#pragma once

#include "io/json/dom.h"
#include "io/json/plain_arrays.h"

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace oriel::detail {

/// Parses JSON whose arrays may be plain, and keeps simdjson's buffers.
class PlainParser {
 public:
  /// How deep simdjson goes.
  static constexpr std::size_t kDepth = simdjson::DEFAULT_MAX_DEPTH;

  /// The value in `text`, of which `room` bytes behind it may be read; with {} for what is `cut`
  /// out (PlainArrays). It lasts until the next call. Throws std::bad_alloc.
  simdjson::error_code parse(std::string_view text, std::size_t room, dom::element& value,
                             std::span<const TextRange> cut = {}, std::size_t depth = kDepth);

  /// Those of which the value has the numbers; null if it has arrays as they stand in the text.
  [[nodiscard]] const PlainArrays* arrays() const { return is_plain_ ? &arrays_ : nullptr; }

 private:
  dom::parser parser_;
  PlainArrays arrays_;
  std::string rest_;  ///< of a text that is not plain and of which something was cut
  bool is_plain_ = false;
};

}  // namespace oriel::detail
