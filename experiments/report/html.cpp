#include "experiments/report/forms.h"
#include "experiments/report/tables.h"
#include "kernel/base/text/printable.h"
#include "kernel/base/text/xml.h"

#include <algorithm>

#include <fmt/format.h>

namespace oriel::report {

/// Returns report.html, which the build puts into embedded.cpp.
std::string_view report_page();

namespace {

void append_html_row(std::string& out, const std::vector<std::string>& cells, const char* tag) {
  out += "<tr>";
  for (const std::string& cell : cells)
    out += fmt::format("<{0}>{1}</{0}>", tag, escaped_xml(printable(cell)));
  out += "</tr>\n";
}

void append_html_table(std::string& out, const ReportTable& table) {
  out += fmt::format("<h3>{}</h3>\n<p>{}</p>\n<div class=\"scroll\"><table>\n",
                     escaped_xml(printable(table.title)), escaped_xml(printable(table.caption)));
  append_html_row(out, table.header, "th");
  for (const auto& row : table.rows) append_html_row(out, row, "td");
  out += "</table></div>\n";
}

void append_html_changed(std::string& out, const ChangedBuildings& changed) {
  out += fmt::format("<p>{}</p>\n", escaped_xml(printable(changed.sentence)));
  for (const ReportBuilding& one : changed.buildings)
    out += fmt::format("<h3>{}</h3>\n<p>{}</p>\n<div class=\"scroll\">{}</div>\n",
                       escaped_xml(printable(one.title)), escaped_xml(printable(one.caption)),
                       one.svg.substr(std::min(one.svg.find("<svg"), one.svg.size())));
}

/// The page with each {{name}} replaced, from the first to the last.
std::string filled(std::string_view page,
                   const std::vector<std::pair<std::string_view, std::string_view>>& places) {
  std::string out;
  for (const auto& [place, text] : places) {
    const std::size_t at = page.find(place);
    out += page.substr(0, at);
    out += text;
    page.remove_prefix(at + place.size());
  }
  return out += page;
}

}  // namespace

std::string html_of(const ExperimentResults& results, const std::vector<ReportSection>& sections) {
  std::string body = fmt::format("<h1>{}</h1>\n", escaped_xml(printable(results.name)));
  if (!results.about.empty())
    body += fmt::format("<p>{}</p>\n", escaped_xml(printable(results.about)));
  for (const ReportSection& section : sections) {
    body += fmt::format("<h2>{}</h2>\n", escaped_xml(printable(section.group.title())));
    for (const Chart& chart : section.charts)
      body += fmt::format("<div class=\"scroll\">{}</div>\n", svg_of(chart));
    for (const ReportTable& table : section.tables) append_html_table(body, table);
  }
  if (!results.changed.empty()) body += "<h2>Buildings that changed</h2>\n";
  for (const ChangedBuildings& changed : results.changed) append_html_changed(body, changed);
  if (!results.tables.empty())
    body += sections.empty() ? "<h2>Tables</h2>\n" : "<h2>Further tables</h2>\n";
  for (const ReportTable& table : results.tables) append_html_table(body, table);
  body += fmt::format(
      "<h2>How it was made</h2>\n<p>By {}. All rows are in <code>results.csv</code>, "
      "all inputs with their hashes in <code>manifest.json</code>.</p>\n",
      escaped_xml(printable(results.program)));
  append_html_table(body, table_of_options(results));
  return filled(report_page(),
                {{"{{title}}", escaped_xml(printable(results.name))}, {"{{body}}", body}});
}

}  // namespace oriel::report
