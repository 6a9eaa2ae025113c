#include "io/gpkg/gpkg_writer.h"

#include "io/gpkg/gpkg_geometry.h"
#include "io/gpkg/gpkg_schema.h"
#include "kernel/base/text/printable.h"

#include <array>
#include <optional>
#include <utility>

#include <fmt/format.h>

namespace oriel {

using detail::Database;
using detail::GpkgColumns;
using detail::GpkgRow;
using detail::GpkgTable;

namespace {

constexpr std::array<GpkgTable, detail::kGpkgTables> kTablesInOrder{
    GpkgTable::buildings, GpkgTable::surfaces, GpkgTable::features};

/// The statements that put rows into a table and its index.
class TableFiller {
 public:
  TableFiller(Database& database, GpkgTable table, const GpkgColumns& columns,
              const detail::ReferenceSystem& system)
      : columns_(columns), system_(system.number), insert_(database, insertion(table, columns)) {
    if (detail::make_index(database, table))
      index_.emplace(database, fmt::format("INSERT INTO rtree_{}_geom VALUES (?, ?, ?, ?, ?)",
                                           detail::table_name(table)));
  }

  [[nodiscard]] bool has_index() const { return index_.has_value(); }

  void add(GpkgRow row) {
    const std::int64_t number = ++rows_;
    const auto values = columns_.values(row, number);
    insert_.set(1, number);
    if (!row.geometry.empty()) detail::set_reference_system(row.geometry, system_);
    insert_.set_blob(2, row.geometry);
    for (std::size_t i = 0; i < values.size(); ++i) insert_.set(static_cast<int>(i) + 3, values[i]);
    insert_.run();
    if (row.geometry.empty() || !index_) return;
    const std::array<detail::GpkgValue, 5> entry{number, row.box.min.x, row.box.max.x,
                                                 row.box.min.y, row.box.max.y};
    for (std::size_t i = 0; i < entry.size(); ++i) index_->set(static_cast<int>(i) + 1, entry[i]);
    index_->run();
  }

 private:
  static std::string insertion(GpkgTable table, const GpkgColumns& columns) {
    std::string sql = fmt::format("INSERT INTO {} VALUES (?, ?", detail::table_name(table));
    const std::size_t count = columns.columns().size() + (columns.has_rest() ? 1 : 0);
    for (std::size_t i = 0; i < count; ++i) sql += ", ?";
    return sql + ")";
  }

  const GpkgColumns& columns_;
  std::int32_t system_;
  std::int64_t rows_ = 0;
  Database::Statement insert_;
  std::optional<Database::Statement> index_;
};

Issue mixed_types(const std::string& output, GpkgTable table, const detail::GpkgColumn& column) {
  Issue issue;
  issue.severity = Severity::warning;
  issue.code = Code::E165;
  issue.place.file = output;
  issue.sentence =
      fmt::format("the attribute '{}' has values of different types: its column in {} is text",
                  printable(column.name), detail::table_name(table));
  return issue;
}

}  // namespace

struct GpkgWriter::State {
  explicit State(std::string path) : output(std::move(path)), folder(scratch_folder(output)) {
    rows.emplace(folder, output).forget_name();
    for (const GpkgTable table : kTablesInOrder)
      columns[static_cast<std::size_t>(table)] = detail::table_columns(table);
  }

  GpkgColumns& columns_of(GpkgTable table) { return columns[static_cast<std::size_t>(table)]; }
  void fill(Database& database, const detail::ReferenceSystem& system);

  std::string output;
  std::string folder;
  std::optional<NamelessFile> rows;
  std::array<GpkgColumns, detail::kGpkgTables> columns;
  std::string crs;
};

GpkgWriter::GpkgWriter(std::string output) : state_(std::make_unique<State>(std::move(output))) {}

GpkgWriter::~GpkgWriter() = default;

void GpkgWriter::take(std::string_view rows, std::string_view crs) {
  if (state_->crs.empty()) state_->crs = crs;
  detail::for_each_row(rows, [&](const GpkgRow& row) { state_->columns_of(row.table).note(row); });
  state_->rows->append(rows);
}

void GpkgWriter::State::fill(Database& database, const detail::ReferenceSystem& system) {
  std::array<std::optional<TableFiller>, detail::kGpkgTables> fillers;
  for (const GpkgTable table : kTablesInOrder) {
    detail::make_table(database, table, columns_of(table), system);
    fillers[static_cast<std::size_t>(table)].emplace(database, table, columns_of(table), system);
  }
  rows->read([&](std::string_view bytes) {
    return detail::for_each_row(bytes, [&](GpkgRow row) {
      fillers[static_cast<std::size_t>(row.table)]->add(std::move(row));
    });
  });
  for (const GpkgTable table : kTablesInOrder)
    if (fillers[static_cast<std::size_t>(table)]->has_index())
      detail::make_triggers(database, table);
}

std::vector<Issue> GpkgWriter::end(OutputFile& file) {
  std::vector<Issue> issues;
  for (const GpkgTable table : kTablesInOrder) {
    state_->columns_of(table).settle();
    for (const detail::GpkgColumn& column : state_->columns_of(table).columns())
      if (column.is_mixed) issues.push_back(mixed_types(state_->output, table, column));
  }
  Database database(state_->folder, state_->output);
  const detail::ReferenceSystem system = detail::reference_system(state_->crs);
  detail::make_gpkg(database, system);
  state_->fill(database, system);
  state_->rows.reset();
  database.finish().read([&](std::string_view bytes) {
    file.append(bytes);
    return bytes.size();
  });
  return issues;
}

}  // namespace oriel
