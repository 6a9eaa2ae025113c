// Writes the files of this folder into the folder that is named: `oriel-make-errors
// tests/data/errors`.

#include "tests/support/error_files.h"

#include <cstdio>
#include <filesystem>
#include <fstream>

int main(int argc, char** argv) {
  if (argc != 2) {
    std::fputs("usage: oriel-make-errors FOLDER\n", stderr);
    return 2;
  }
  for (const auto& file : oriel::test::error_files()) {
    std::ofstream out(std::filesystem::path(argv[1]) / file.name, std::ios::binary);
    out << file.text;
    if (!out.flush()) return 6;
  }
  return 0;
}
