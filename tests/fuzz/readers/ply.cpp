#include "tests/fuzz/support/documents.h"

namespace oriel::fuzz {

void ply(std::string_view bytes) {
  static const ScratchFile file("a.ply");
  read_and_write(file, Format::ply, bytes);
}

}  // namespace oriel::fuzz
