#include "tests/fuzz/support/documents.h"

namespace oriel::fuzz {

void cityjson_seq(std::string_view bytes) {
  static const ScratchFile file("a.city.jsonl");
  read_and_write(file, Format::cityjson_seq, bytes);
}

}  // namespace oriel::fuzz
