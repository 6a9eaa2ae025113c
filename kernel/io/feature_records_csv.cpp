#include "kernel/io/detail/json_text.h"
#include "kernel/io/detail/record_text.h"

#include <utility>

#include <fmt/format.h>

namespace oriel::detail {

namespace {

std::string joined(const std::vector<std::string>& parts) {
  std::string text;
  for (const std::string& part : parts) text += (&part == &parts.front() ? "" : ";") + part;
  return text;
}

template <class Numbers>
std::string joined_numbers(const Numbers& numbers) {
  std::vector<std::string> parts;
  parts.reserve(numbers.size());
  for (const auto number : numbers) parts.push_back(shortest(number));
  return joined(parts);
}

std::string cell_of(const std::optional<double>& number) { return number ? shortest(*number) : ""; }

std::string cell_of(const RecordValue& value) {
  if (const auto* number = std::get_if<double>(&value)) return shortest(*number);
  const auto* text = std::get_if<std::string>(&value);
  return text == nullptr ? "" : *text;
}

/// Splits a CSV into cells (RFC 4180; line ends LF or CRLF).
class CsvReader {
 public:
  explicit CsvReader(std::string_view text) : text_(text) {}

  /// The cells of the next line; false at the end. `fault` is set where a quote does not fit.
  bool next_line(std::vector<std::string>& cells, std::optional<std::string>& fault) {
    cells.clear();
    if (at_ >= text_.size()) return false;
    start_ = at_;
    bool is_more = true;
    while (is_more && !fault) {
      cells.emplace_back();
      is_more = read_cell(cells.back(), fault);
    }
    return true;
  }

  /// Where the last line started.
  [[nodiscard]] std::size_t start() const { return start_; }

 private:
  /// Reads one cell and what ends it; true if a comma does.
  bool read_cell(std::string& cell, std::optional<std::string>& fault) {
    if (at_ < text_.size() && text_[at_] == '"')
      read_quoted(cell, fault);
    else
      while (at_ < text_.size() && !is_end(text_[at_])) cell += text_[at_++];
    if (fault || at_ >= text_.size()) return false;
    if (text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n') ++at_;
    const char end = text_[at_++];
    if (!is_end(end)) fault = "text follows a closing quote";
    return end == ',';
  }

  void read_quoted(std::string& cell, std::optional<std::string>& fault) {
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] != '"') {
        cell += text_[at_];
      } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
        cell += text_[at_++];
      } else {
        ++at_;
        return;
      }
    }
    fault = "a quote is not closed";
  }

  static bool is_end(char c) { return c == ',' || c == '\n' || c == '\r'; }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t start_ = 0;
};

/// The record of one line; says what is wrong with it.
std::optional<std::string> read_record(const std::vector<std::string>& fields,
                                       const std::vector<std::string>& cells,
                                       FeatureRecord& record) {
  if (cells.size() != fields.size())
    return fmt::format("the line has {} cells; the header names {}", cells.size(), fields.size());
  for (std::size_t i = 0; i < cells.size(); ++i)
    if (auto fault = set_field(record, fields[i], cells[i])) return fault;
  if (record.building.empty() || record.id.empty()) return "'building' or 'id' is empty";
  return std::nullopt;
}

}  // namespace

void append_csv_line(std::string& out, const std::vector<std::string>& cells) {
  for (const std::string& cell : cells) {
    if (&cell != &cells.front()) out += ',';
    if (cell.find_first_of(",\"\r\n") == std::string::npos) {
      out += cell;
      continue;
    }
    out += '"';
    for (const char c : cell) out.append(c == '"' ? 2 : 1, c);
    out += '"';
  }
  out += '\n';
}

void append_csv_record(std::string& out, const FeatureRecord& record) {
  std::vector<std::string> cells{record.building,
                                 record.id,
                                 record.label,
                                 cell_of(record.score),
                                 cell_of(record.margin),
                                 record.rule,
                                 record.runner_up,
                                 record.parent,
                                 record.host,
                                 joined_numbers(record.aabb_m),
                                 joined_numbers(record.source_polygons)};
  for (const RecordValue& value : record.attributes) cells.push_back(cell_of(value));
  for (const auto& ids : record.relations) cells.push_back(joined(ids));
  cells.push_back(joined(record.groups));
  append_csv_line(out, cells);
}

Checked<std::vector<FeatureRecord>> read_csv_records(std::string_view text, const TextName& name) {
  Checked<std::vector<FeatureRecord>> result;
  CsvReader reader(text);
  std::vector<std::string> fields;
  std::optional<std::string> fault;
  if (!reader.next_line(fields, fault)) {
    result.issues.push_back(
        error_in(name, {"E102", "the file is empty; expected a header line of field names"}));
    return result;
  }
  for (const std::string_view needed : {"building", "id"})
    if (!fault && std::ranges::find(fields, needed) == fields.end())
      fault = fmt::format("the header names no field '{}'", needed);
  if (fault) {
    result.issues.push_back(error_at(name, text, 0, {"E111", *fault}));
    return result;
  }
  result.value.emplace();
  std::vector<std::string> cells;
  while (!fault && reader.next_line(cells, fault)) {
    FeatureRecord record = empty_record();
    const auto wrong = fault ? fault : read_record(fields, cells, record);
    if (wrong)
      result.issues.push_back(error_at(name, text, reader.start(), {"E111", *wrong}));
    else
      result.value->push_back(std::move(record));
  }
  return result;
}

}  // namespace oriel::detail
