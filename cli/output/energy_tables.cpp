#include "cli/output/energy_tables.h"

#include "cli/output/safe_cells.h"
#include "cli/terminal/option_values.h"
#include "io/records/feature_records.h"
#include "kernel/base/text/counted.h"

#include <algorithm>
#include <filesystem>
#include <string_view>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::cli {

namespace {

TableFormat table_format(const std::string& path) {
  if (path == "-") return TableFormat::csv;
  const auto format = record_format_of(path);
  if (!format)
    throw CLI::ValidationError("--table",
                               fmt::format("'{}' does not end in .csv, .json or .jsonl", path));
  if (*format == RecordFormat::csv) return TableFormat::csv;
  return *format == RecordFormat::json ? TableFormat::json : TableFormat::jsonl;
}

}  // namespace

void add_energy_arguments(CLI::App& command, EnergyArguments& arguments) {
  command
      .add_option("--table", arguments.tables,
                  "A table for energy and solar studies: energy (a row for each building) or "
                  "envelope (a row for each face of its envelope), as CSV on stdout; NAME=FILE "
                  "writes .csv, .json or .jsonl; may be repeated")
      ->allow_extra_args(false);
  command
      .add_option("--unheated", arguments.energy.unheated,
                  "Classes whose features are no part of the heated body, for --table and "
                  "--extension")
      ->allow_extra_args(false)
      ->delimiter(',')
      ->capture_default_str();
  command
      .add_option("--extension", arguments.extension,
                  "Also write what an extension of CityJSON has of the buildings: energy (CityJSON "
                  "Energy extension)")
      ->check(one_of({"energy"}));
}

void check_unheated(const EnergyArguments& arguments, const RuleBase& rules) {
  if (!arguments.has_any() && arguments.energy.unheated != EnergyOptions{}.unheated)
    throw CLI::ValidationError("--unheated", "needs --table or --extension");
  if (const auto unknown = unknown_class(rules, arguments.energy); !unknown.empty())
    throw CLI::ValidationError("--unheated", unknown);
}

Issue nothing_measured(int buildings) {
  Issue issue;
  issue.severity = Severity::warning;
  issue.code = Code::E134;
  issue.sentence =
      fmt::format("{} {} no closed solid to measure: --table has only {}, --extension nothing",
                  counted(buildings, "building"), agreeing(buildings, "has", "have"),
                  agreeing(buildings, "its id", "their ids"));
  return issue;
}

EnergyTables::EnergyTables(const EnergyArguments& arguments, bool is_safe)
    : energy_(arguments.energy), is_safe_(is_safe) {
  tables_[1].kind = EnergyTable::envelope;
  tables_[1].part = OutputPart::envelope;
  for (const std::string& asked : arguments.tables) {
    const std::size_t sign = asked.find('=');
    const std::string name = asked.substr(0, sign);
    const auto table =
        std::ranges::find_if(tables_, [&](const Table& t) { return to_string(t.kind) == name; });
    if (table == tables_.end())
      throw CLI::ValidationError("--table",
                                 fmt::format("there is no table '{}': energy, envelope", name));
    if (!table->path.empty())
      throw CLI::ValidationError("--table", fmt::format("'{}' is named twice", name));
    table->path = sign == std::string::npos ? "-" : asked.substr(sign + 1);
    table->format = table_format(table->path);
  }
  if (tables_[0].path == "-" && tables_[1].path == "-")
    throw CLI::ValidationError("--table",
                               "stdout takes one table: name a file for the other, NAME=FILE");
}

bool EnergyTables::has_any() const {
  return std::ranges::any_of(tables_, [](const Table& t) { return !t.path.empty(); });
}

bool EnergyTables::takes_stdout() const {
  return std::ranges::any_of(tables_, [](const Table& t) { return t.path == "-"; });
}

bool EnergyTables::is_of_lines() const {
  return std::ranges::all_of(tables_, [](const Table& t) {
    return t.path.empty() || (t.path != "-" && t.format != TableFormat::json);
  });
}

std::string EnergyTables::recipe() const {
  if (!has_any()) return {};
  std::string text = " tables=";
  for (const Table& table : tables_)
    if (!table.path.empty())
      text += fmt::format("{}:{},", to_string(table.kind), static_cast<int>(table.format));
  return text + fmt::format(" unheated={}", fmt::join(energy_.unheated, ","));
}

void EnergyTables::name_files(NamedFiles& files) const {
  for (const Table& table : tables_) files.add_output("--table", table.path);
}

void EnergyTables::begin(bool is_rehearsal) {
  if (is_rehearsal) return;
  for (Table& table : tables_) {
    if (table.path.empty() || table.file) continue;
    table.file = std::make_unique<OutputFile>(table.path);
    table.is_empty = table.file->size() <= 1;
    if (table.file->size() > 0) continue;  // it goes on after a run that was killed
    std::string head = table.format == TableFormat::json ? "[" : "";
    if (table.format == TableFormat::csv) append_csv_line(head, energy_columns(table.kind));
    table.file->append(head);
  }
}

BuildingEnergy EnergyTables::energy(const Building& building, const PipelineResult& result,
                                    const RuleBase& rules, const PipelineOptions& options,
                                    std::optional<int> stated_storeys) const {
  BuildingEnergy of = energy_of(building, result, rules, options, energy_);
  if (stated_storeys) {
    of.storeys = stated_storeys;
    of.storeys_source = "attribute";
  }
  return of;
}

void EnergyTables::make(const BuildingEnergy& of, Product& product) const {
  for (const Table& table : tables_) {
    if (table.path.empty()) continue;
    std::string rows = energy_rows(table.kind, table.format, of);
    if (is_safe_ && table.format == TableFormat::csv) rows = with_safe_cells(rows);
    std::string& bytes = product[table.part];
    if (table.format == TableFormat::json && !bytes.empty() && !rows.empty()) bytes += ",\n";
    bytes += rows;
  }
}

void EnergyTables::take(const Product& product) {
  for (Table& table : tables_) {
    const std::string& bytes = product[table.part];
    if (!table.file || bytes.empty()) continue;
    if (table.format == TableFormat::json) table.file->append(table.is_empty ? "\n" : ",\n");
    table.file->append(bytes);
    table.is_empty = false;
  }
}

void EnergyTables::add_places(PartPlaces& places) const {
  for (const Table& table : tables_)
    if (table.file) places[static_cast<std::size_t>(table.part)] = {table.path, table.file->size()};
}

void EnergyTables::commit() {
  for (Table& table : tables_) {
    if (!table.file) continue;
    if (table.format == TableFormat::json) table.file->append(table.is_empty ? "]\n" : "\n]\n");
    table.file->commit();
  }
}

}  // namespace oriel::cli
