#include "examples/generator/command.h"

#include <iostream>

int main(int argc, char** argv) {
  std::ios::sync_with_stdio(false);
  return oriel::generator::run_command(argc, argv, std::cout, std::cerr);
}
