#include "experiments/report/forms.h"
#include "kernel/base/text/printable.h"

#include <fmt/format.h>

namespace oriel::report {

namespace {

std::string escaped_latex(const std::string& text) {
  std::string out;
  const std::string shown = printable(text);
  for (std::size_t at = 0; at < shown.size(); ++at) {
    const char c = shown[at];
    if (shown.compare(at, 3, "–") == 0) {
      out += "--";
      at += 2;
    } else if (c == '-' && (at == 0 || shown[at - 1] == ' ' || shown[at - 1] == '[') &&
               shown[at + 1] >= '0' && shown[at + 1] <= '9') {
      out += "$-$";  // of a number; else it is a hyphen
    } else if (c == '\\') {
      out += "\\textbackslash{}";
    } else if (c == '~' || c == '^') {
      out += fmt::format("\\{}{{}}", c);
    } else if (c == '<' || c == '>') {
      out += fmt::format("${}$", c);
    } else if (c == '[' && out.empty()) {
      out += "{[}";  // else it would be an argument of the line end before it
    } else {
      if (std::string_view("&%$#_{}").find(c) != std::string_view::npos) out += '\\';
      out += c;
    }
  }
  return out;
}

void append_latex_row(std::string& out, const std::vector<std::string>& cells) {
  const char* separator = "    ";
  for (const std::string& cell : cells) {
    out += separator + escaped_latex(cell);
    separator = " & ";
  }
  out += " \\\\\n";
}

void append_latex_table(std::string& out, const ReportTable& table, const std::string& label) {
  out +=
      fmt::format("\\begin{{table}}\n  \\centering\n  \\caption{{{}. {}}}\n  \\label{{tab:{}}}\n",
                  escaped_latex(table.title), escaped_latex(table.caption), label);
  out += fmt::format(
      "  \\resizebox{{\\ifdim\\width>\\linewidth\\linewidth\\else\\width\\fi}}{{!}}{{%\n"
      "  \\begin{{tabular}}{{{}}}\n    \\toprule\n",
      std::string(table.header.size(), 'l'));
  append_latex_row(out, table.header);
  out += "    \\midrule\n";
  for (const auto& row : table.rows) append_latex_row(out, row);
  out += "    \\bottomrule\n  \\end{tabular}}\n\\end{table}\n\n";
}

}  // namespace

std::string latex_of(const ExperimentResults& results, const std::vector<ReportSection>& sections) {
  std::string out = fmt::format("% {}: tables for \\usepackage{{booktabs,graphicx}}.\n\n",
                                escaped_latex(results.name));
  for (const ReportSection& section : sections)
    for (std::size_t i = 0; i < section.tables.size(); ++i)
      append_latex_table(
          out, section.tables[i],
          i == 0 ? section.group.slug() : fmt::format("{}-{}", section.group.slug(), i + 1));
  for (std::size_t i = 0; i < results.tables.size(); ++i)
    append_latex_table(out, results.tables[i], fmt::format("further-{}", i + 1));
  if (!out.empty()) out.pop_back();
  return out;
}

}  // namespace oriel::report
