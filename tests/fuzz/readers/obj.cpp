#include "tests/fuzz/support/documents.h"

namespace oriel::fuzz {

void obj(std::string_view bytes) {
  static const ScratchFile file("a.obj");
  read_and_write(file, Format::obj, bytes);
}

}  // namespace oriel::fuzz
