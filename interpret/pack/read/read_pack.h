#pragma once

#include "interpret/language/findings.h"
#include "interpret/pack/extend.h"
#include "interpret/pack/pack.h"
#include "interpret/yaml/yaml_tree.h"
#include "kernel/base/issue.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace oriel::rules {

/// What was read of a pack's text.
struct ReadPack {
  /// With errors only its `source` is of use: the text, then those of the packs that it extends.
  std::shared_ptr<Pack> pack;
  bool is_good = false;  ///< there are no errors
  /// The tree put over those that it extends; nothing if one of them is no YAML.
  std::optional<YamlNode> tree;
  /// All findings in the order of the text, twice: as they are printed and with their spans in
  /// `pack->source`.
  std::vector<Issue> issues;
  std::vector<SpannedFinding> findings;
};

/// Reads the pack in `text`, called `file` in places, put over those that it extends. A byte order
/// mark at its begin is dropped.
ReadPack read_pack_text(std::string text, std::string file, const PackFinder& find);

/// Finds what the pack at `path` may extend: packs that are built in, and files in its folder.
PackFinder finder_for(const std::string& path);

}  // namespace oriel::rules
