#pragma once

#include <functional>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

namespace oriel::rules {

/// What the maps of a YAML language may have, as its JSON Schema (draft 7) states it. It is stated
/// there alone: readers, the words that a misspelt key may mean, completion, hover and editors go
/// by it. It knows nothing of expressions, units and names: readers do.
class Grammar {
 public:
  explicit Grammar(std::string schema);

  [[nodiscard]] const std::string& schema() const { return schema_; }
  /// The same, parsed; keys stay in their order.
  [[nodiscard]] const nlohmann::ordered_json& tree() const { return *tree_; }
  /// The keys with a fixed name of a map, in the order of the schema; a map is called as its
  /// definition is, or as the key that it is the value of, and the whole text "". Throws
  /// std::out_of_range for one that the schema does not have.
  [[nodiscard]] const std::vector<std::string>& keys(std::string_view map) const;
  /// True if some map has the key.
  [[nodiscard]] bool has_key(std::string_view key) const { return all_keys_.contains(key); }

 private:
  std::string schema_;
  std::shared_ptr<const nlohmann::ordered_json> tree_;
  std::map<std::string, std::vector<std::string>, std::less<>> keys_;
  std::set<std::string, std::less<>> all_keys_;
};

}  // namespace oriel::rules
