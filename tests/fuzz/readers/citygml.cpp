#include "tests/fuzz/support/documents.h"

namespace oriel::fuzz {

void citygml(std::string_view bytes) {
  static const ScratchFile file("a.gml");
  read_and_write(file, Format::citygml, bytes);
}

}  // namespace oriel::fuzz
