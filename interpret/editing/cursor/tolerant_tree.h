#pragma once

#include "interpret/yaml/yaml_tree.h"

#include <string>

namespace oriel::rules {

/// The tree of a text that may be broken; spans count in `text`. A section that cannot be read is
/// read without the lines at which its faults are, and left out if there are many. Its findings are
/// those of parse_yaml and not told here.
YamlNode read_tolerantly(const std::string& text);

}  // namespace oriel::rules
