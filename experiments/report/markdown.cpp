#include "experiments/report/forms.h"
#include "experiments/report/tables.h"
#include "kernel/base/text/printable.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::report {

namespace {

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : printable(text)) {
    if (std::string_view("|\\`*_<>[]").find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

void append_row(std::string& out, const std::vector<std::string>& cells) {
  out += '|';
  for (const std::string& cell : cells) out += ' ' + escaped(cell) + " |";
  out += '\n';
}

void append_table(std::string& out, const ReportTable& table) {
  out += fmt::format("### {}\n\n{}\n\n", escaped(table.title), escaped(table.caption));
  append_row(out, table.header);
  out += '|';
  for (std::size_t i = 0; i < table.header.size(); ++i) out += "---|";
  out += '\n';
  for (const auto& row : table.rows) append_row(out, row);
  out += '\n';
}

void append_section(std::string& out, const ReportSection& section) {
  out += fmt::format("## {}\n\n", escaped(section.group.title()));
  for (const Chart& chart : section.charts)
    out += fmt::format("![{}](figures/{}.svg)\n\n", escaped(chart.title), chart.name);
  for (const ReportTable& table : section.tables) append_table(out, table);
}

void append_changed(std::string& out, const ChangedBuildings& changed) {
  out += escaped(changed.sentence) + "\n\n";
  for (const ReportBuilding& one : changed.buildings) {
    out += fmt::format("### {}\n\n{}\n\n", escaped(one.title), escaped(one.caption));
    if (!one.svg.empty())
      out += fmt::format("![{}](figures/{}.svg)\n\n", escaped(one.title), one.name);
  }
}

}  // namespace

std::string markdown_of(const ExperimentResults& results,
                        const std::vector<ReportSection>& sections) {
  std::string out = fmt::format("# {}\n\n", escaped(results.name));
  if (!results.about.empty()) out += escaped(results.about) + "\n\n";
  for (const ReportSection& section : sections) append_section(out, section);
  if (!results.changed.empty()) out += "## Buildings that changed\n\n";
  for (const ChangedBuildings& changed : results.changed) append_changed(out, changed);
  if (!results.tables.empty()) out += sections.empty() ? "## Tables\n\n" : "## Further tables\n\n";
  for (const ReportTable& table : results.tables) append_table(out, table);
  out += "## How it was made\n\n";
  out += fmt::format(
      "By {}. All rows are in results.csv, all inputs with their hashes in "
      "manifest.json.\n\n",
      escaped(results.program));
  append_table(out, table_of_options(results));
  out.pop_back();
  return out;
}

}  // namespace oriel::report
