#include "io/records/feature_tables.h"

#include "io/json/words.h"
#include "io/records/record_text.h"
#include "kernel/base/text/counted.h"

#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <string_view>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

namespace field = detail::record_field;

struct TextHash {
  using is_transparent = void;
  std::size_t operator()(std::string_view text) const {
    return std::hash<std::string_view>()(text);
  }
};

/// Says what is wrong with a class of related features.
std::optional<std::string> wrong_class(const detail::RecordCells& cells) {
  const std::size_t first = field::first_attribute + feature_schema().size();
  for (std::size_t r = 0; r < detail::recorded_relations().size(); ++r)
    if (const std::string_view cell = cells[first + r];
        cell.starts_with(detail::kClassMark) && !detail::relation_class_of(cell))
      return fmt::format(
          "'{}' is {}; expected ids joined by ';', or a class and the number of its "
          "features, such as #3/12",
          record_fields()[first + r], in_quotes(cell));
  return std::nullopt;
}

/// Collects the records of one building after the other.
class TableBuilder {
 public:
  /// `boxes` may be null.
  TableBuilder(Checked<std::vector<DescribedBuilding>>& result,
               std::vector<std::vector<Box>>* boxes)
      : result_(&result), boxes_(boxes) {
    result_->value.emplace();
    if (boxes_ != nullptr) boxes_->clear();
  }

  /// Says what is wrong with the record.
  std::optional<std::string> add(const detail::RecordCells& cells);
  /// The last record was added.
  void finish();

 private:
  std::optional<std::string> add_attributes(const detail::RecordCells& cells);
  [[nodiscard]] FeatureTable make_table() const;
  FeatureGraph make_graph();
  void set_relation(const std::string& name, std::size_t relation, FeatureGraph& graph);
  [[nodiscard]] std::string_view list_of(std::size_t row, std::size_t relation) const;
  std::vector<FeatureGraph::Pair> pairs_of_ids(std::size_t relation);
  std::map<std::string_view, std::vector<FeatureId>> classes_in(std::size_t relation);

  Checked<std::vector<DescribedBuilding>>* result_;
  std::vector<std::vector<Box>>* boxes_;
  std::string building_;
  /// The rows so far, by id.
  std::unordered_map<std::string, int, TextHash, std::equal_to<>> rows_;
  /// Of the building at hand, row by row: its numbers, and its texts (id first).
  std::vector<double> numbers_;
  std::vector<std::string> texts_;
  std::vector<Box> row_boxes_;
  /// Row by row the ids that each relation leads to, and the host: where they stand in `lists_`.
  std::string lists_;
  std::vector<std::size_t> list_ends_;
  /// Relations that lead to what is not there, and the first such id.
  std::size_t dangling_ = 0;
  std::string first_dangling_;
};

std::optional<std::string> TableBuilder::add(const detail::RecordCells& cells) {
  if (cells[field::building] != building_) {
    finish();
    building_ = cells[field::building];
  }
  if (rows_.contains(cells[field::id]))
    return fmt::format("the building '{}' has a feature '{}' already", building_, cells[field::id]);
  if (auto fault = wrong_class(cells)) return fault;
  std::array<double, 6> box{};
  if (boxes_ != nullptr)
    if (auto fault = detail::read_box(cells[field::aabb_m], box)) return fault;
  const std::size_t numbers = numbers_.size(), texts = texts_.size();
  texts_.emplace_back(cells[field::id]);
  if (auto fault = add_attributes(cells)) {
    numbers_.resize(numbers);
    texts_.resize(texts);
    return fault;
  }
  rows_.emplace(cells[field::id], static_cast<int>(rows_.size()));
  row_boxes_.push_back({{box[0], box[1], box[2]}, {box[3], box[4], box[5]}});
  const std::size_t first = field::first_attribute + feature_schema().size();
  for (std::size_t r = 0; r <= detail::recorded_relations().size(); ++r) {
    lists_ += r == 0 ? cells[field::host] : cells[first + r - 1];
    list_ends_.push_back(lists_.size());
  }
  return std::nullopt;
}

std::optional<std::string> TableBuilder::add_attributes(const detail::RecordCells& cells) {
  std::size_t at = field::first_attribute;
  for (const AttributeInfo& attribute : feature_schema()) {
    const std::string_view cell = cells[at++];
    if (attribute.unit == Unit::text) {
      texts_.emplace_back(cell);
      continue;
    }
    const auto number =
        cell.empty() ? std::numeric_limits<double>::quiet_NaN() : detail::as_double(cell);
    if (!number) return detail::no_number(record_name(attribute), cell);
    numbers_.push_back(*number);
  }
  return std::nullopt;
}

FeatureTable TableBuilder::make_table() const {
  FeatureTable table(building_, rows_.size());
  auto number = numbers_.begin();
  auto text = texts_.begin();
  for (int i = 0; i < static_cast<int>(rows_.size()); ++i) {
    const FeatureId row{i};
    table.set_id(row, *text++);
    for (const Attribute attribute : kAttributes) {
      if (info_of(attribute).unit == Unit::text)
        table.set(row, attribute, *text++);
      else if (const double value = *number++; !std::isnan(value))
        table.set(row, attribute, value);
    }
  }
  return table;
}

/// What the host (0) or a recorded relation (1 …) of a row says.
std::string_view TableBuilder::list_of(std::size_t row, std::size_t relation) const {
  const std::size_t list = row * (detail::recorded_relations().size() + 1) + relation;
  const std::size_t begin = list == 0 ? 0 : list_ends_[list - 1];
  return std::string_view(lists_).substr(begin, list_ends_[list] - begin);
}

/// The features of each class of a recorded relation (1 …) by its text. Those that are not in the
/// file are counted.
std::map<std::string_view, std::vector<FeatureId>> TableBuilder::classes_in(std::size_t relation) {
  std::map<std::string_view, std::vector<FeatureId>> classes;
  for (std::size_t row = 0; row < rows_.size(); ++row)
    if (const std::string_view text = list_of(row, relation); text.starts_with(detail::kClassMark))
      classes[text].push_back(FeatureId{static_cast<int>(row)});
  for (const auto& [text, features] : classes) {
    const auto size = static_cast<std::size_t>(detail::relation_class_of(text)->size);
    if (features.size() >= size) continue;
    if (dangling_ == 0) first_dangling_ = text;
    dangling_ += features.size() * (size - features.size());
  }
  return classes;
}

/// The pairs that lists of ids say: of the host (0), or where a recorded relation (1 …) says no
/// class.
std::vector<FeatureGraph::Pair> TableBuilder::pairs_of_ids(std::size_t relation) {
  std::vector<FeatureGraph::Pair> pairs;
  for (std::size_t row = 0; row < rows_.size(); ++row) {
    const std::string_view ids = list_of(row, relation);
    if (relation > 0 && ids.starts_with(detail::kClassMark)) continue;
    detail::for_each_part(ids, [&](std::string_view id) {
      const auto found = rows_.find(id);
      if (found != rows_.end())
        pairs.emplace_back(FeatureId{static_cast<int>(row)}, FeatureId{found->second});
      else if (dangling_++ == 0)
        first_dangling_ = id;
    });
  }
  return pairs;
}

FeatureGraph TableBuilder::make_graph() {
  FeatureGraph graph;
  graph.set("host", pairs_of_ids(0));
  for (std::size_t r = 0; r < detail::recorded_relations().size(); ++r)
    set_relation(detail::recorded_relations()[r].name, r + 1, graph);
  return graph;
}

/// Sets a recorded relation; without pairs of every class if all that is said are classes.
void TableBuilder::set_relation(const std::string& name, std::size_t relation,
                                FeatureGraph& graph) {
  const auto classes = classes_in(relation);
  std::vector<FeatureGraph::Pair> pairs = pairs_of_ids(relation);
  if (pairs.empty()) {
    std::vector<int> class_of_row(rows_.size(), -1);
    int number = 0;
    for (const auto& [text, features] : classes) {
      for (const FeatureId feature : features) class_of_row[feature.index()] = number;
      ++number;
    }
    return graph.set_classes(name, class_of_row);
  }
  for (const auto& [text, features] : classes)
    for (const FeatureId self : features)
      for (const FeatureId other : features) pairs.emplace_back(self, other);
  graph.set(name, std::move(pairs));
}

void TableBuilder::finish() {
  if (!rows_.empty()) {
    result_->value->push_back({make_table(), make_graph()});
    if (boxes_ != nullptr) boxes_->push_back(std::move(row_boxes_));
  }
  if (dangling_ > 0)
    result_->issues.push_back(
        building_issue(Severity::warning, Code::E121, building_,
                       fmt::format("{} not in the file, such as '{}'; labels "
                                   "may differ from those of the whole building",
                                   counted(dangling_, "relation leads to a feature that is",
                                           "relations lead to features that are"),
                                   first_dangling_)));
  rows_.clear();
  numbers_.clear();
  texts_.clear();
  row_boxes_.clear();
  lists_.clear();
  list_ends_.clear();
  dangling_ = 0;
}

}  // namespace

Checked<std::vector<DescribedBuilding>> read_feature_tables(const std::string& path,
                                                            RecordColumns* columns,
                                                            std::vector<std::vector<Box>>* boxes) {
  Checked<std::vector<DescribedBuilding>> result;
  TableBuilder builder(result, boxes);
  const auto add = [&](const detail::RecordCells& cells) { return builder.add(cells); };
  if (detail::visit_records(path, add, result.issues, columns))
    builder.finish();
  else
    result.value.reset();
  return result;
}

}  // namespace oriel
