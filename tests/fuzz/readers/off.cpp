#include "tests/fuzz/support/documents.h"

namespace oriel::fuzz {

void off(std::string_view bytes) {
  static const ScratchFile file("a.off");
  read_and_write(file, Format::off, bytes);
}

}  // namespace oriel::fuzz
