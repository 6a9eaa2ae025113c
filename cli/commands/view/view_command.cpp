#include "cli/batch/batch_runner.h"
#include "cli/batch/inputs/input_files.h"
#include "cli/batch/inputs/neighbours.h"
#include "cli/commands/commands.h"
#include "cli/commands/view/view_picture.h"
#include "cli/options/options.h"
#include "cli/terminal/logging.h"
#include "io/cityjson/carried_labels.h"
#include "io/files/output_file.h"
#include "studio/server/page_files.h"
#include "studio/session/recording.h"

#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <string_view>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

namespace oriel::cli {

namespace {

/// A page of more buildings opens slowly: the studio loads them as they are needed.
constexpr std::size_t kMostOfAPage = 2000;

struct ViewArguments : RunOptions, RulesChoice {
  std::string out;
  std::vector<std::string> after;
  PictureArguments picture;
  std::vector<CLI::Option*> picture_options;
};

[[noreturn]] void refuse(Code code, const std::string& file, std::string sentence) {
  Issue issue;
  issue.code = code;
  issue.sentence = std::move(sentence);
  issue.place.file = file;
  throw InputError(std::move(issue));
}

/// The page of the studio without its editor, in one HTML file that loads nothing.
class PageExhibit final : public Exhibit {
 public:
  explicit PageExhibit(const RuleBase& rules) : recording_(rules) {}

  std::vector<Issue> add(const Document& /*document*/, const Building& building,
                         const PipelineResult& result) override {
    recording_.add(building, result);
    return {};
  }
  void begin_after(const std::string& /*file*/) override { recording_.begin_after(); }
  void add_after(const Building& building, const PipelineResult& result,
                 const CarriedLabels* carried) override {
    recording_.add_after(building, result, carried);
  }
  std::string made() override {
    static constexpr std::string_view kMark = "{{data}}";
    const std::string_view page = studio::page_file("view.html");
    const std::size_t at = page.find(kMark);
    std::string whole(page.substr(0, at));
    return whole.append(recording_.json()).append(page.substr(at + kMark.size()));
  }

 private:
  studio::Recording recording_;
};

/// Gathers the buildings of a run, their ids appended to `ids`. With `is_after` they are what
/// became of those before, and have the labels of oriel that they carry.
ExitCode gather(const RunOptions& arguments, const RuleBase& rules, Report& report,
                Exhibit& exhibit, std::vector<std::string>& ids, bool is_after) {
  BatchRunner runner(arguments, &rules, report);
  std::map<std::string, int> counts;
  RecordVisitor visitor([&](const Document& document, std::vector<PipelineResult>& lines) {
    if (!runner.is_last_run()) return;
    const CarriedLabelReader reader(document);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      if (lines[i].is_passed_over) continue;
      const auto carried = is_after ? reader.labels_of(i) : std::nullopt;
      if (carried) {
        for (const CarriedFeature& feature : carried->features) ++counts[feature.said.given()];
      } else {
        for (const Verdict& verdict : lines[i].interpretation.verdicts) ++counts[verdict.label];
      }
      const Building& building = document.buildings[i];
      ids.push_back(building.id);
      if (is_after) {
        exhibit.add_after(building, lines[i], carried ? &*carried : nullptr);
        continue;
      }
      for (const Issue& issue : exhibit.add(document, building, lines[i])) {
        if (issue.severity == Severity::error)
          runner.set_aside(issue);
        else
          runner.warn(issue);
      }
    }
  });
  const ExitCode code = runner.run(visitor);
  runner.report_summary("shown", counts);
  return code;
}

/// The same buildings out of a generalised file, with what was read and written for the first run
/// left as it is.
RunOptions arguments_after(const ViewArguments& arguments, const std::string& file,
                           std::vector<std::string> ids) {
  RunOptions after = arguments;
  after.inputs = {file};
  after.selection = {};
  after.selection.ids = std::move(ids);
  after.lod.clear();
  after.from.clear();
  after.neighbours.reset();  // those are as they were before
  after.timings_file.clear();
  after.status_stem.clear();
  after.repeat = 1;
  after.reports_emptiness = false;  // E128 does, and rejected buildings are none
  return after;
}

void check_names(const ViewArguments& arguments) {
  NamedFiles files;
  files.add(arguments);
  files.add_input("--rules", arguments.rules);
  for (const std::string& file : arguments.after) files.add_input("--after", file);
  for (const std::string& file : arguments.picture.truth_files) files.add_input("--compare", file);
  files.add_output("-o", arguments.out);
  files.check();
}

/// A page under another name is a file that no program opens as what it is.
void check_page_name(const std::string& path) {
  const std::string ending = std::filesystem::path(path).extension().string();
  if (ending.empty() || ending == ".html" || ending == ".htm" || path == "-") return;
  throw CLI::ValidationError(
      "-o", fmt::format("a page or picture is written, and '{}' ends in {}: end it in .html, .png, "
                        ".svg or .pdf",
                        path, ending));
}

/// Options of pictures say nothing of a page.
void check_picture_options(const ViewArguments& arguments) {
  for (const CLI::Option* option : arguments.picture_options)
    if (option->count() > 0)
      throw CLI::ValidationError(option->get_name(),
                                 "is of pictures: end the name of -o in .png, .svg or .pdf");
  if (arguments.after.size() > 1)
    throw CLI::ValidationError("--after", "a page shows one file beside the first");
}

std::unique_ptr<Exhibit> exhibit_for(ViewArguments& arguments, std::optional<PictureFormat> format,
                                     const RuleBase& rules) {
  if (!format) return std::make_unique<PageExhibit>(rules);
  return std::make_unique<PictureExhibit>(
      arguments.picture, *format, rules, arguments.label_options(),
      std::filesystem::path(arguments.inputs.front()).filename().string());
}

ExitCode work(ViewArguments& arguments) {
  Report report(arguments.is_verbose);
  settle_inputs(arguments, report);
  check_names(arguments);
  const auto format = picture_format(arguments.out);
  if (format) {
    settle(arguments.picture);
  } else {
    check_page_name(arguments.out);
    check_picture_options(arguments);
  }
  const auto rules = load_rules(arguments, report);
  if (!rules || !settle_targets(arguments.picture, *rules, report)) return ExitCode::rules;
  const ExitCode truth = read_truth(arguments.picture, report);
  if (truth == ExitCode::input) return truth;
  find_neighbours(arguments, report);
  const auto exhibit = exhibit_for(arguments, format, *rules);
  std::vector<std::string> ids;
  ExitCode code = gather(arguments, *rules, report, *exhibit, ids, false);
  if (ids.empty()) {
    if (code == ExitCode::input) return code;
    refuse(Code::E127, arguments.inputs.front(), "there is no building to show");
  }
  exhibit->check(code);
  for (const std::string& file : arguments.after) {
    std::vector<std::string> found;
    exhibit->begin_after(file);
    const ExitCode second =
        gather(arguments_after(arguments, file, ids), *rules, report, *exhibit, found, true);
    if (found.empty() && second == ExitCode::input) return second;
    if (found.empty()) refuse(Code::E128, file, "has none of the buildings that are shown");
    code = graver(code, second);
  }
  if (!format && ids.size() > kMostOfAPage)
    run_log().info(
        "{} buildings are many for one page, which opens slowly; `oriel studio {}` shows them from "
        "a local server",
        ids.size(), fmt::join(arguments.inputs, " "));
  write_file(arguments.out, exhibit->made());
  return code;
}

}  // namespace

void add_view(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<ViewArguments>();
  CLI::App* command = app.add_subcommand(
      "view",
      "Write a picture of buildings, or an HTML page: a click on a part shows its label and the "
      "reason");
  add_line_arguments(*command, *arguments, true);
  add_rules_arguments(*command, *arguments);
  add_neighbours_argument(*command, arguments->neighbours_of);
  command
      ->add_option("-o,--output", arguments->out,
                   "HTML, PNG, SVG or PDF file to write, or - for a page on stdout")
      ->required();
  command->add_option(
      "--after", arguments->after,
      "The same buildings, generalised: a line divides a page into before and after; a picture has "
      "them beside each other, from each such file");
  command->footer(
      "The page needs no other file and loads nothing; page.html#ID opens it at a feature.\n"
      "Example:\n  oriel view house.city.json -o house.html\n"
      "  oriel view house.city.json -o house.png\n"
      "  oriel view house.city.json --scales 1:1000,1:2500,1:5000 --facade south -o scales.svg\n"
      "  oriel generalise house.city.json --scale 1:2500 -o small.city.json\n"
      "  oriel view house.city.json --after small.city.json -o house.html");
  arguments->picture_options = add_picture_arguments(*command, arguments->picture);
  arguments->joins_installations = true;
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
