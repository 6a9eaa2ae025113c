#include "kernel/model/version.h"

#include <cstdio>

int main() { std::printf("oriel %s\n", oriel::kVersion); }
