#include "tests/fuzz/support/documents.h"

namespace oriel::fuzz {

void cityjson(std::string_view bytes) {
  static const ScratchFile file("a.city.json");
  read_and_write(file, Format::cityjson, bytes);
}

}  // namespace oriel::fuzz
