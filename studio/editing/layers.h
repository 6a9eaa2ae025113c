#pragma once

#include "interpret/language/source.h"
#include "interpret/pack/extend.h"
#include "interpret/yaml/grammar.h"
#include "interpret/yaml/yaml_tree.h"
#include "studio/editing/cursor/expression_words.h"

#include <cstddef>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace oriel::rules {

/// The text of a pack as far as it can be read.
struct PackLayer {
  Source source;
  YamlNode tree;
};

/// A name that a pack, or one beneath, declares.
struct DeclaredName {
  WordSort sort = WordSort::param;
  std::string name{};
  const PackLayer* layer = nullptr;
  SourceSpan span{};
  /// What stands after the name; of a rule or an entry all of it.
  const YamlNode* value = nullptr;
};

/// A text and the packs beneath it: those that a pack extends, or the pack that tests are for and
/// what it extends, the nearest first.
class PackLayers {
 public:
  PackLayers(std::string text, std::string file, const PackFinder& find);
  PackLayers(const PackLayers&) = delete;
  PackLayers& operator=(const PackLayers&) = delete;

  [[nodiscard]] const PackLayer& top() const { return layers_.front(); }
  [[nodiscard]] const std::deque<PackLayer>& all() const { return layers_; }
  /// In the order of the texts; a name that several layers declare is there several times.
  [[nodiscard]] const std::vector<DeclaredName>& names() const { return names_; }
  /// The nearest declaration, or null.
  [[nodiscard]] const DeclaredName* find(WordSort sort, std::string_view name) const;
  /// The grammar of the text: of packs, of tests, or of profiles.
  [[nodiscard]] const Grammar& grammar() const;

 private:
  std::deque<PackLayer> layers_;
  std::vector<DeclaredName> names_;
};

}  // namespace oriel::rules
