#include "experiments/report/report.h"

#include "kernel/base/sha256.h"
#include "tests/experiments/report/results_of.h"

#include <algorithm>
#include <limits>
#include <string>
#include <vector>

#include <doctest/doctest.h>

using namespace oriel;
using oriel::test::add_run;
using oriel::test::some_results;

namespace {

const std::string& text_of(const std::vector<ReportFile>& files, const std::string& path) {
  const auto found = std::ranges::find(files, path, &ReportFile::path);
  REQUIRE_MESSAGE(found != files.end(), path);
  return found->text;
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1))
    ++count;
  return count;
}

bool has(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

}  // namespace

TEST_SUITE("report") {
  TEST_CASE("results.csv has a line a row and no value where there is none") {
    ExperimentResults results = some_results();
    results.rows.resize(3);
    results.rows[0].precision = std::numeric_limits<double>::quiet_NaN();
    const auto files = report_files(results);
    const std::string& csv = text_of(files, "results.csv");
    CHECK(count_of(csv, "\n") == results.rows.size() + 1);
    CHECK(has(csv, "sweep,houses,residential,as the pack says,,,,yes,door,8,9,2,,0.9,0.9,0.85,"));
    CHECK_FALSE(has(csv, "nan"));
  }

  TEST_CASE("every figure that report.md shows is among the files") {
    const auto files = report_files(some_results());
    const std::string& page = text_of(files, "report.md");
    std::size_t shown = 0;
    for (std::size_t at = page.find("](figures/"); at != std::string::npos;
         at = page.find("](figures/", at + 1), ++shown) {
      const std::size_t begin = at + 2;
      CHECK(has(text_of(files, page.substr(begin, page.find(')', begin) - begin)), "</svg>"));
    }
    CHECK(shown == 3);
  }

  TEST_CASE("buildings that changed have a figure or the reason why not") {
    ExperimentResults results = some_results();
    results.changed.push_back(
        {"2 of 9 buildings changed.",
         {{"changed-a-1", "a <b>", "3 labels changed.", "<?xml?>\n<svg>1</svg>"},
          {"changed-a-2", "c", "It is not drawn: too far.", ""}}});
    const auto files = report_files(results);
    CHECK(text_of(files, "figures/changed-a-1.svg") == "<?xml?>\n<svg>1</svg>");
    CHECK(std::ranges::find(files, "figures/changed-a-2.svg", &ReportFile::path) == files.end());
    const std::string& page = text_of(files, "report.md");
    CHECK(has(page, "## Buildings that changed\n\n2 of 9 buildings changed.\n"));
    CHECK(has(page, "](figures/changed-a-1.svg)"));
    CHECK_FALSE(has(page, "changed-a-2.svg"));
    const std::string& html = text_of(files, "report.html");
    CHECK(has(html, "<h3>a &lt;b&gt;</h3>\n<p>3 labels changed.</p>"));
    CHECK(has(html, "<div class=\"scroll\"><svg>1</svg>"));
    CHECK_FALSE(has(html, "<?xml"));
    CHECK(has(html, "It is not drawn: too far."));
  }

  TEST_CASE("the manifest has the hash of every other file and of the inputs") {
    const auto files = report_files(some_results());
    const std::string& manifest = text_of(files, "manifest.json");
    for (const ReportFile& file : files)
      if (file.path != "manifest.json")
        CHECK_MESSAGE(has(manifest, "\"" + sha256(file.text) + "\""), file.path);
    CHECK(has(manifest, std::string(64, '0')));
  }

  TEST_CASE("the same results give the same files") {
    const auto first = report_files(some_results());
    const auto second = report_files(some_results());
    REQUIRE(first.size() == second.size());
    for (std::size_t i = 0; i < first.size(); ++i) CHECK(first[i].text == second[i].text);
  }

  TEST_CASE("names are escaped in every form") {
    const auto files = report_files(some_results());
    CHECK(has(text_of(files, "report.html"), "<h1>tried &amp; &lt;true&gt;</h1>"));
    CHECK(has(text_of(files, "report.md"), "# tried & \\<true\\>\n"));
    CHECK(has(text_of(files, "report.md"), "without 'width \\< 1 m \\| 50 %'"));
    const std::string& latex = text_of(files, "tables.tex");
    CHECK(has(latex, "without 'width $<$ 1 m | 50 \\%'"));
    CHECK(has(latex, "mine\\_1.yaml"));
    const std::string& figure = text_of(files, "figures/ablate-houses.svg");
    CHECK(has(figure, "width &lt; 1 m"));
    CHECK_FALSE(has(figure, "width < 1 m"));
  }

  TEST_CASE("the page shows every figure with the value of each point and has no script") {
    const auto files = report_files(some_results());
    const std::string& page = text_of(files, "report.html");
    std::size_t figures = 0;
    for (const ReportFile& file : files) {
      if (!file.path.ends_with(".svg")) continue;
      ++figures;
      CHECK(has(page, file.text));
      CHECK(count_of(file.text, "<circle") == count_of(file.text, "<title>"));
    }
    CHECK(figures == 3);
    CHECK(has(page, "<title>without 'width &lt; 1 m"));
    CHECK_FALSE(has(page, "<script"));
  }

  TEST_CASE(
      "a sweep lists the best and the worst value of each param and what matters most first") {
    ExperimentResults results = some_results();
    add_run(results, ExperimentPart::sweep, {"low = 1 m", "low", 1, "m", false}, 0.94, 0.9);
    const auto files = report_files(results);
    const std::string& page = text_of(files, "report.md");
    const std::string parapet =
        "| parapet | as the pack says | 0.900 \\[0.850, 0.950\\] | – | – | 1.1 m | 0.870 "
        "\\[0.820, 0.920\\] | -0.030 \\[-0.060, -0.010\\] | 0.020 |\n";
    const std::string low =
        "| low | 1 m | 0.920 \\[0.870, 0.970\\] | +0.020 \\[-0.010, +0.040\\] | 0.020 | as the "
        "pack says | 0.900 \\[0.850, 0.950\\] | – | – |\n";
    CHECK(has(page, parapet));
    CHECK(has(page, low));
    // The param step loses 0.1.
    CHECK(page.find("| step |") < page.find(parapet));
    CHECK(page.find(parapet) < page.find(low));
  }

  TEST_CASE("a sweep of one param has a line for each of its values") {
    for (const double worst : {0.8, 0.9}) {  // with and without an effect
      CAPTURE(worst);
      ExperimentResults results;
      results.name = "sweep";
      add_run(results, ExperimentPart::sweep, {"as it is", "", {}, "", true}, 0.9, 0.9);
      add_run(results, ExperimentPart::sweep, {"step = 1 m", "step", 1, "m", false}, 0.9, 0.9);
      add_run(results, ExperimentPart::sweep, {"step = -2 m", "step", -2, "m", false}, worst, 0.9);
      const auto files = report_files(results);
      const std::string& page = text_of(files, "report.md");
      for (const char* run : {"| as it is | 0.900 ", "| step = 1 m | 0.900 ", "| step = -2 m | "})
        CHECK(count_of(page, run) == 1);
      const std::string& latex = text_of(files, "tables.tex");
      CHECK(count_of(latex, "\\\\\n") == 4);
      CHECK(has(latex, "step = $-$2 m & "));
    }
  }

  TEST_CASE("a sweep of params without any effect lists them all") {
    ExperimentResults results;
    results.name = "sweep";
    add_run(results, ExperimentPart::sweep, {"as it is", "", {}, "", true}, 0.9, 0.9);
    for (const std::string name : {"a", "b"})
      add_run(results, ExperimentPart::sweep, {name + " = 1", name, 1, "", false}, 0.9, 0.9);
    const std::string page = text_of(report_files(results), "report.md");
    CHECK(has(page, "Without any effect here: a, b."));
    CHECK(has(page, "| a | as it is | 0.900"));
    CHECK(has(page, "| b | as it is | 0.900"));
  }

  TEST_CASE("LaTeX has minus signs for numbers and hyphens for names and tables in the text") {
    const std::string latex = text_of(report_files(some_results()), "tables.tex");
    CHECK(has(latex, " & $-$0.100 [$-$0.130, $-$0.080] & 0.020 "));
    CHECK_FALSE(has(latex, " -0."));
    CHECK(has(latex, "macro-F1 & difference"));
    CHECK(count_of(latex, "\\resizebox{\\ifdim\\width>\\linewidth") ==
          count_of(latex, "\\end{tabular}}\n"));
  }

  TEST_CASE("what can be taken out without any effect is named below the ablations") {
    ExperimentResults results;
    results.name = "ablate";
    add_run(results, ExperimentPart::ablate, {"as it is", "", {}, "", true}, 0.9, 0.9);
    add_run(results, ExperimentPart::ablate, {"without a", "", {}, "", false}, 0.9, 0.9);
    add_run(results, ExperimentPart::ablate, {"without b", "", {}, "", false}, 0.8, 0.9);
    const auto files = report_files(results);
    const std::string& page = text_of(files, "report.md");
    CHECK(has(page, "| without b | 0.850"));
    CHECK(has(page, "### Ablation on houses: without any effect\n"));
    CHECK(has(page, "\n| without a |\n"));
    CHECK_FALSE(has(text_of(files, "figures/ablate-houses.svg"), "without a<"));
    CHECK(has(text_of(files, "results.csv"), "without a"));
  }

  TEST_CASE("a param without any effect is named and not drawn") {
    ExperimentResults results;
    results.name = "sweep";
    add_run(results, ExperimentPart::sweep, {"as it is", "", {}, "", true}, 0.9, 0.9);
    for (const double value : {1., 2.}) {
      const std::string text = std::to_string(value).substr(0, 1);
      add_run(results, ExperimentPart::sweep, {"idle = " + text, "idle", value, "", false}, 0.9,
              0.9);
      add_run(results, ExperimentPart::sweep, {"busy = " + text, "busy", value, "", false}, 0.9,
              0.8);
    }
    const auto files = report_files(results);
    const std::string& page = text_of(files, "report.md");
    CHECK(has(page, "Without any effect here: idle."));
    CHECK_FALSE(has(page, "| idle |"));
    CHECK(has(page, "| busy |"));
    CHECK(has(text_of(files, "figures/sweep-houses.svg"), ">busy<"));
    CHECK_FALSE(has(text_of(files, "figures/sweep-houses.svg"), ">idle<"));
    CHECK(has(text_of(files, "results.csv"), "idle = 1"));
  }

  TEST_CASE("of ablations the one that loses most comes first after the pack itself") {
    const auto files = report_files(some_results());
    const std::string& page = text_of(files, "report.md");
    const std::size_t section = page.find("## Ablation on houses");
    const std::size_t base = page.find("| as the pack says", section);
    const std::size_t most = page.find("| without rule door.on\\_ground", section);
    const std::size_t less = page.find("| without 'width", section);
    CHECK(base < most);
    CHECK(most < less);
    CHECK(has(page, "door -0.700 |"));
  }

  TEST_CASE("of many joint runs the best are listed and all are counted") {
    ExperimentResults results;
    results.name = "grid";
    add_run(results, ExperimentPart::sweep, {"base", "", {}, "", true}, 0.9, 0.9);
    for (int i = 0; i < 30; ++i)
      add_run(results, ExperimentPart::sweep, {"run " + std::to_string(i), "", {}, "", false},
              i / 100., 0.9);
    const auto files = report_files(results);
    const std::string& page = text_of(files, "report.md");
    CHECK(has(page, "The best 20 of 30 runs; results.csv has all."));
    CHECK(has(page, "| run 29 |"));
    CHECK_FALSE(has(page, "| run 9 |"));
  }

  TEST_CASE("values that are none leave no point in a figure") {
    ExperimentResults results;
    results.name = "none";
    const double none = std::numeric_limits<double>::quiet_NaN();
    add_run(results, ExperimentPart::stability, {"noise 1 cm", "noise", 1, "cm", true}, none, none);
    const auto files = report_files(results);
    CHECK(
        std::ranges::none_of(files, [](const ReportFile& file) { return has(file.path, "svg"); }));
    CHECK(has(text_of(files, "report.md"), "–"));
    CHECK_FALSE(has(text_of(files, "report.md"), "nan"));
  }

  TEST_CASE("a value alone has an axis around it") {
    ExperimentResults results;
    results.name = "one";
    add_run(results, ExperimentPart::learning_curve, {"20 buildings", "buildings", 20, "", false},
            1, 1);
    const auto files = report_files(results);
    const std::string& figure = text_of(files, "figures/learning-curve-houses.svg");
    CHECK(has(figure, "<circle"));
    CHECK_FALSE(has(figure, "nan"));
    CHECK_FALSE(has(figure, "inf"));
  }
}
