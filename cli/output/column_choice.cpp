#include "cli/output/column_choice.h"

#include "kernel/base/text/printable.h"
#include "kernel/base/text/suggest.h"

#include <algorithm>
#include <iterator>
#include <map>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

using ColumnNames = std::vector<std::string>;

ColumnNames with_prefix(const std::string& prefix, ColumnNames names) {
  for (const std::string& field : record_fields())
    if (field.starts_with(prefix)) names.push_back(field);
  return names;
}

ColumnNames attribute_columns() {
  ColumnNames names;
  for (const AttributeInfo& attribute : feature_schema()) names.push_back(record_name(attribute));
  return names;
}

/// The columns of each group but `rules`, which are the pack's.
const std::map<std::string, ColumnNames>& column_groups() {
  static const std::map<std::string, ColumnNames> groups = {
      {"all", record_fields()},
      {"attributes", attribute_columns()},
      {"ids", {"building", "id", "name"}},
      {"labels",
       {"label", "score", "margin", "rule", "runner_up", "groups", "part_of", "corrected_by",
        "corrected_why"}},
      {"relations", with_prefix("rel_", {"parent", "host"})}};
  return groups;
}

std::string wrong_column(const std::string& word) {
  ColumnNames words = record_fields();
  for (const auto& [group, names] : column_groups()) words.push_back(group);
  words.emplace_back("rules");
  if (std::ranges::find(words, word) != words.end()) return {};
  const std::string meant = nearest(word, words);
  return fmt::format(
      "'{}' is no column of records and none of the groups all, attributes, ids, "
      "labels, relations, rules{}",
      printable(word), meant.empty() ? "" : "; did you mean '" + meant + "'?");
}

}  // namespace

void add_columns_argument(CLI::App& command, std::vector<std::string>& columns) {
  command
      .add_option("--columns", columns,
                  "Columns of the records, with commas between: names, or the groups ids, labels, "
                  "attributes, relations, rules (what the pack reads), all")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(wrong_column);
}

RecordColumns chosen_columns(const std::vector<std::string>& words, const RuleBase& rules) {
  if (words.empty() || std::ranges::find(words, "all") != words.end()) return {};
  ColumnNames names;
  for (const std::string& word : words) {
    if (word == "rules") {
      std::ranges::move(names_of_columns(columns_read(rules)), std::back_inserter(names));
    } else if (const auto group = column_groups().find(word); group != column_groups().end()) {
      std::ranges::copy(group->second, std::back_inserter(names));
    } else {
      names.push_back(word);
    }
  }
  return columns_named(names);
}

}  // namespace oriel::cli
