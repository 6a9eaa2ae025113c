#pragma once

#include "kernel/base/issue.h"

#include <string>
#include <vector>

namespace oriel {

/// A file to begin with, and its bytes.
struct StarterFile {
  std::string name;
  std::string text;
};

/// A pack called `name` with a class of that name on top of residential, its tests, and a sample
/// building that they are about: NAME.yaml, NAME.test.yaml, NAME.city.json. The pack has no
/// findings, and the tests pass. R216, and no files, where no class can be called `name` or
/// residential has that class already.
Checked<std::vector<StarterFile>> starter_pack(const std::string& name);

}  // namespace oriel
