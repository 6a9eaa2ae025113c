#include "kernel/io/document.h"

#include "kernel/io/cityjson/cityjson_source.h"

namespace oriel {

std::string_view source_line(const Document& document) {
  if (document.format != Format::cityjson_seq || !document.source) return {};
  return document.source->text;
}

}  // namespace oriel
