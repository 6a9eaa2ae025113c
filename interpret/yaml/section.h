#pragma once

#include "interpret/language/findings.h"
#include "interpret/yaml/yaml_tree.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace oriel::rules {

/// A map of a pack whose keys are fixed. Making one reports every key that is not among `keys`
/// (R209), and a node that is no map (R211); `what` names it in messages ("a rule"). A key that is
/// probably meant for one of `keys` is read as that one.
class YamlSection {
 public:
  YamlSection(const YamlNode& node, std::string what, const std::vector<std::string>& keys,
              Findings& findings);

  /// The value of `key`, or null.
  [[nodiscard]] const YamlNode* find(std::string_view key) const;
  /// The same; an error R210 where it is missing.
  const YamlNode* require(std::string_view key);

  [[nodiscard]] bool is_map() const { return node_->kind == YamlNode::Kind::map; }

 private:
  void check_keys(const std::vector<std::string>& keys);
  void report_unknown_key(const YamlEntry* before, const YamlEntry& entry,
                          const std::vector<std::string>& keys);

  /// A key that was written otherwise, and its value; null if it has none that can be read.
  using Meant = std::pair<std::string, const YamlNode*>;

  const YamlNode* node_;
  std::string what_;
  std::vector<Meant> meant_;
  Findings* findings_;
};

/// "the rule 'door.ground'" for kind "rule", or "a rule" (`without_id`) if the map has no id.
std::string name_with_id(const YamlNode& node, std::string_view kind, std::string_view without_id);

/// True if `node` is a map or empty; else an error R211 that calls it `what`.
bool expect_map(const YamlNode& node, const std::string& what, Findings& findings);
/// True if `node` is a list or empty; else an error R211 that calls it `what`.
bool expect_list(const YamlNode& node, const std::string& what, Findings& findings);

/// Values of one kind, or nothing and an error R211; `what` names them in the message.
std::optional<std::string> read_text(const YamlNode& node, const std::string& what,
                                     Findings& findings);
std::optional<int> read_integer(const YamlNode& node, const std::string& what, Findings& findings);
std::optional<double> read_number(const YamlNode& node, const std::string& what,
                                  Findings& findings);
std::optional<bool> read_flag(const YamlNode& node, const std::string& what, Findings& findings);

/// Where the expression in a scalar stands; nothing and R211 if it is no scalar, R221 if it runs
/// over lines or has escapes, since then no caret could point into it.
std::optional<SourceSpan> expression_span(const YamlNode& node, Findings& findings);

/// Reports (R214) what YAML readers understand in different ways: bare yes, no, on and off, and
/// numbers in base 60 such as 1:50.
void check_traps(const YamlNode& node, Findings& findings);

}  // namespace oriel::rules
