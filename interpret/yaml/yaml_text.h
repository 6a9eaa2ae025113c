#pragma once

#include "interpret/yaml/yaml_tree.h"

#include <string>
#include <string_view>

namespace oriel::rules {

/// A pack's tree in canonical form: sections, params, rules and the like on lines of their own,
/// what is small in brackets as long as the line has no more than 120 characters. Names and their
/// order stay, and so does whether a scalar is quoted: read again it is the same tree.
std::string to_yaml(const YamlNode& root);

/// The same with the comments of `text`, from which all of the tree was read: those on lines of
/// their own stay before what they stand before, others stay after what they follow. One
/// empty line stays where there are some.
std::string to_yaml(const YamlNode& root, std::string_view text);

/// True if both say the same, wherever they stand.
bool is_same(const YamlNode& p, const YamlNode& q);

}  // namespace oriel::rules
