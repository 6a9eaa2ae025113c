#include "io/json/plain_parser.h"

#include <new>

namespace oriel::detail {

namespace {

void copy_without(std::span<const TextRange> cut, std::string_view text, std::string& rest) {
  rest.clear();
  std::size_t copied = 0;
  for (const auto [begin, end] : cut) {
    rest.append(text, copied, begin - copied).append("{}");
    copied = end;
  }
  rest.append(text, copied, std::string::npos);
}

}  // namespace

simdjson::error_code PlainParser::parse(std::string_view text, std::size_t room,
                                        dom::element& value, std::span<const TextRange> cut,
                                        std::size_t depth) {
  if (parser_.max_depth() != depth && parser_.allocate(0, depth) != simdjson::SUCCESS)
    throw std::bad_alloc();
  const auto parsed = [&](std::string_view json, bool needs_copy) {
    const auto error = parser_.parse(json.data(), json.size(), needs_copy).get(value);
    if (error == simdjson::MEMALLOC) throw std::bad_alloc();  // to parse once more would crash
    return error;
  };
  const auto parsed_rest = [&](const std::string& rest) {
    return parsed(rest, rest.capacity() - rest.size() < simdjson::SIMDJSON_PADDING);
  };
  is_plain_ = arrays_.read(text, cut) && parsed_rest(arrays_.rest()) == simdjson::SUCCESS;
  if (is_plain_) return simdjson::SUCCESS;
  if (cut.empty()) return parsed(text, room < simdjson::SIMDJSON_PADDING);
  copy_without(cut, text, rest_);
  return parsed_rest(rest_);
}

}  // namespace oriel::detail
