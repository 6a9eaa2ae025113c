#include "tests/fuzz/support/documents.h"

namespace oriel::fuzz {

void stl(std::string_view bytes) {
  static const ScratchFile file("a.stl");
  read_and_write(file, Format::stl, bytes);
}

}  // namespace oriel::fuzz
