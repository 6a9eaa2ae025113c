#include "io/records/feature_records.h"
#include "io/records/record_text.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/json_text.h"

#include <algorithm>
#include <deque>
#include <utility>

#include <fmt/format.h>

namespace oriel {

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

}  // namespace oriel

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

  /// The cells of the next line, valid until the next call; false at the end. `fault` is set where
  /// a quote does not fit.
  bool next_line(std::vector<std::string_view>& cells, std::optional<std::string>& fault) {
    cells.clear();
    unquoted_.clear();
    if (at_ >= text_.size()) return false;
    start_ = at_;
    if (read_plain_line(cells)) return true;
    bool is_more = true;
    while (is_more && !fault) {
      const CsvCell cell = read_cell(fault);
      cells.push_back(cell.text);
      is_more = cell.is_more;
    }
    return true;
  }

  /// Where the last line started.
  [[nodiscard]] std::size_t start() const { return start_; }

 private:
  struct CsvCell {
    std::string_view text;
    /// A comma ends it.
    bool is_more = false;
  };

  /// A line without quotes, the usual one; false if it is none.
  bool read_plain_line(std::vector<std::string_view>& cells) {
    const std::size_t end = std::min(text_.find('\n', at_), text_.size());
    std::string_view line = text_.substr(at_, end - at_);
    if (line.ends_with('\r') && end < text_.size()) line.remove_suffix(1);
    if (line.find('"') != std::string_view::npos || line.find('\r') != std::string_view::npos)
      return false;
    at_ = std::min(end + 1, text_.size());
    while (true) {
      const std::size_t comma = line.find(',');
      cells.push_back(line.substr(0, comma));
      if (comma == std::string_view::npos) return true;
      line.remove_prefix(comma + 1);
    }
  }

  CsvCell read_cell(std::optional<std::string>& fault) {
    CsvCell cell;
    if (at_ < text_.size() && text_[at_] == '"') {
      cell.text = read_quoted(fault);
    } else {
      const std::size_t begin = at_;
      while (at_ < text_.size() && !is_end(text_[at_])) ++at_;
      cell.text = text_.substr(begin, at_ - begin);
    }
    if (fault || at_ >= text_.size()) return cell;
    if (text_[at_] == '\r' && at_ + 1 < text_.size() && text_[at_ + 1] == '\n') ++at_;
    const char end = text_[at_++];
    if (!is_end(end)) fault = "text follows a closing quote";
    cell.is_more = end == ',';
    return cell;
  }

  std::string_view read_quoted(std::optional<std::string>& fault) {
    std::string& cell = unquoted_.emplace_back();
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] != '"') {
        cell += text_[at_];
      } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
        cell += text_[at_++];
      } else {
        ++at_;
        return cell;
      }
    }
    fault = "a quote is not closed";
    return cell;
  }

  static bool is_end(char c) { return c == ',' || c == '\n' || c == '\r'; }

  std::string_view text_;
  std::size_t at_ = 0;
  std::size_t start_ = 0;
  /// The cells of the line that stood in quotes; they stay where they are when more come.
  std::deque<std::string> unquoted_;
};

/// For each column its position in record_fields(), or that of none.
std::vector<std::size_t> fields_of(const std::vector<std::string_view>& header) {
  const auto& known = record_fields();
  std::vector<std::size_t> fields;
  for (const std::string_view name : header)
    fields.push_back(static_cast<std::size_t>(std::ranges::find(known, name) - known.begin()));
  return fields;
}

/// Gives the record of one line away; says what is wrong with it.
std::optional<std::string> take_line(const std::vector<std::size_t>& fields,
                                     const std::vector<std::string_view>& line, RecordCells& record,
                                     const RecordTaker& take) {
  if (line.size() != fields.size())
    return fmt::format("the line has {}; the header names {}", counted(line.size(), "cell"),
                       fields.size());
  for (std::size_t i = 0; i < line.size(); ++i)
    if (fields[i] < record.size()) record[fields[i]] = line[i];
  if (record[record_field::building].empty() || record[record_field::id].empty())
    return "'building' or 'id' is empty";
  return take(record);
}

}  // namespace

void append_csv_record(std::string& out, const FeatureRecord& record,
                       const RecordColumns& columns) {
  std::vector<std::string> cells{record.building,
                                 record.id,
                                 record.name,
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
  cells.insert(cells.end(), {record.part_of, record.corrected_by, record.corrected_why});
  if (columns.empty()) return append_csv_line(out, cells);
  std::vector<std::string> wanted;
  for (std::size_t field = 0; field < cells.size(); ++field)
    if (columns[field]) wanted.push_back(std::move(cells[field]));
  append_csv_line(out, wanted);
}

bool visit_csv_records(std::string_view text, const TextName& name, const RecordTaker& take,
                       std::vector<Issue>& issues, RecordColumns& columns) {
  CsvReader reader(text);
  std::vector<std::string_view> line;
  std::optional<std::string> fault;
  if (!reader.next_line(line, fault)) {
    issues.push_back(
        error_in(name, {Code::E102, "the file is empty; expected a header line of field names"}));
    return false;
  }
  for (const std::string_view needed : {"building", "id"})
    if (!fault && std::ranges::find(line, needed) == line.end())
      fault = fmt::format("the header names no field '{}'", needed);
  if (fault) {
    issues.push_back(error_at(name, text, 0, {Code::E111, *fault}));
    return false;
  }
  const std::vector<std::size_t> fields = fields_of(line);
  columns = columns_named({line.begin(), line.end()});
  RecordCells record(record_fields().size());
  while (!fault && reader.next_line(line, fault)) {
    const auto wrong = fault ? fault : take_line(fields, line, record, take);
    if (wrong) issues.push_back(error_at(name, text, reader.start(), {Code::E111, *wrong}));
  }
  return true;
}

}  // namespace oriel::detail
