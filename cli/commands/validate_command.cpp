#include "cli/batch/inputs/input_files.h"
#include "cli/commands/commands.h"
#include "cli/options/options.h"
#include "cli/output/named_files.h"
#include "cli/output/sarif.h"
#include "cli/terminal/file_advice.h"
#include "cli/terminal/logging.h"
#include "cli/terminal/option_values.h"
#include "io/cityjson/cityjson_source.h"
#include "io/files/output_file.h"
#include "kernel/base/text/counted.h"
#include "kernel/base/text/printable.h"
#include "oriel/read.h"
#include "oriel/validate.h"

#include <algorithm>
#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

namespace oriel::cli {

namespace {

using nlohmann::ordered_json;

/// What --lod says to judge all levels of detail.
constexpr const char* kAllLods = "all";

struct ValidateArguments : RunOptions {
  bool is_json = false;
  bool shows_problems_only = false;
  std::string primitive = "stated";
  std::string out = "-";
  std::string sarif;
  ValidateOptions options;
};

/// A geometry of a building or of another object, and all that was found about it.
struct GeometryFindings {
  std::string id;
  std::string lod;
  /// "solid" or "surfaces"; empty for a building that could not be read.
  std::string primitive;
  std::vector<Finding> findings;
  /// Its number in the object, where that has several of this level of detail.
  std::optional<std::size_t> number{};

  /// It can be told whether other parts overlap it.
  [[nodiscard]] bool is_valid_solid() const { return primitive == "solid" && findings.empty(); }
};

/// What was read and not judged: ids by type.
class UnjudgedObjects {
 public:
  void add(const std::vector<UnreadObject>& objects) {
    for (const UnreadObject& object : objects) {
      Kind& kind = kinds_[object.type];
      ++kind.count;
      if (kind.ids.size() < kShown && !object.id.empty()) kind.ids.push_back(object.id);
    }
  }
  [[nodiscard]] int count() const {
    int count = 0;
    for (const auto& [type, kind] : kinds_) count += kind.count;
    return count;
  }
  /// A warning E214 for each type.
  [[nodiscard]] std::vector<Issue> issues(const std::string& input) const {
    std::vector<Issue> issues;
    for (const auto& [type, kind] : kinds_) {
      Issue issue;
      issue.severity = Severity::warning;
      issue.code = Code::E214;
      issue.sentence = fmt::format(
          "{} of type {} with geometry {} not checked{}{}{}", counted(kind.count, "object"), type,
          agreeing(kind.count, "is", "are"), kind.ids.empty() ? "" : ": ",
          fmt::join(kind.ids, ", "),
          std::cmp_less(kind.ids.size(), kind.count) && !kind.ids.empty() ? ", ..." : "");
      issue.place.file = input;
      issues.push_back(std::move(issue));
    }
    return issues;
  }

 private:
  static constexpr std::size_t kShown = 5;

  struct Kind {
    int count = 0;
    std::vector<std::string> ids{};
  };
  std::map<std::string, Kind> kinds_;
};

/// What reading says of a building, as a finding.
Finding finding_of(const Issue& issue) {
  Finding finding;
  finding.code = issue.code;
  finding.val3dity = val3dity_number(issue.code);
  finding.sentence = issue.sentence;
  if (issue.place.line > 0) finding.sentence += fmt::format(" (line {})", issue.place.line);
  return finding;
}

ordered_json json_of(const Finding& finding) {
  ordered_json out{{"code", to_string(finding.code)}};
  if (finding.val3dity > 0) {
    out["val3dity"] = finding.val3dity;
    out["val3dity_name"] = val3dity_name(finding.val3dity);
  }
  out["sentence"] = finding.sentence;
  for (const auto& [name, number] : {std::pair("solid", finding.body),
                                     {"shell", finding.shell},
                                     {"polygon", finding.polygon},
                                     {"ring", finding.ring}})
    if (number >= 0) out[name] = number;
  if (!finding.at_m.empty()) {
    ordered_json& points = out["at_m"] = ordered_json::array();
    for (const Vec3 p : finding.at_m) points.push_back({p.x, p.y, p.z});
  }
  return out;
}

std::string json_line(const GeometryFindings& found) {
  ordered_json out{{"id", found.id}};
  if (!found.primitive.empty()) {
    out["lod"] = found.lod;
    out["primitive"] = found.primitive;
  }
  if (found.number) out["geometry"] = *found.number;
  out["valid"] = found.findings.empty();
  out["findings"] = ordered_json::array();
  for (const Finding& finding : found.findings) out["findings"].push_back(json_of(finding));
  return out.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

/// `names_lod`: several levels of detail are judged.
std::string text_of(const GeometryFindings& found, bool names_lod) {
  std::string name = found.id;
  if (names_lod && !found.lod.empty()) name += fmt::format(" (lod {})", found.lod);
  if (found.number) name += fmt::format(" (geometry {})", *found.number);
  name = printable(name);
  if (found.findings.empty())
    return fmt::format("{}: valid{}\n", name,
                       found.primitive == "surfaces" ? " as loose surfaces" : "");
  std::string text = fmt::format("{}: {}\n", name, counted(found.findings.size(), "finding"));
  for (const Finding& finding : found.findings) {
    text += fmt::format("  {} {}", to_string(finding.code), printable(finding.sentence));
    // Sentences of reading name the number themselves.
    if (finding.val3dity > 0 && finding.sentence.find("(val3dity ") == std::string::npos)
      text += fmt::format(" (val3dity {} {})", finding.val3dity, val3dity_name(finding.val3dity));
    text += '\n';
  }
  return text;
}

/// Reads and judges all inputs.
class Validation {
 public:
  explicit Validation(const ValidateArguments& arguments)
      : arguments_(arguments), report_(arguments.is_verbose), out_(arguments.out) {}

  ExitCode go() {
    if (std::ranges::count(arguments_.inputs, "-") > 1)
      throw CLI::ValidationError("input", "stdin can be read only once: give - once");
    for (const std::string& input : arguments_.inputs) read(input);
    report_emptiness();
    if (has_ended_ || arguments_.out == "-") out_.commit();
    if (!arguments_.sarif.empty()) write_file(arguments_.sarif, sarif_.text());
    report_summary();
    return code_;
  }

 private:
  void report(const Issue& issue) {
    report_.add(issue);
    sarif_.add(issue);
  }
  void report(const std::vector<Issue>& issues) {
    for (const Issue& issue : issues) report(issue);
  }

  void raise(ExitCode code) { code_ = graver(code_, code); }

  [[nodiscard]] bool is_of_all_lods() const { return arguments_.lod == kAllLods; }

  void read(const std::string& input) {
    input_ = input;
    ReadOptions options = arguments_.read_options(input);
    options.geometries = is_of_all_lods() ? ReadGeometries::all : ReadGeometries::of_level;
    if (is_of_all_lods()) options.lod.reset();
    UnjudgedObjects unjudged;
    read(input, options, unjudged);
    if (!arguments_.selection.is_all()) return;
    unjudged_ += unjudged.count();
    for (const Issue& issue : unjudged.issues(input)) report(issue);
    if (unjudged.count() > 0) raise(ExitCode::set_aside);
  }

  void read(const std::string& input, const ReadOptions& options, UnjudgedObjects& unjudged) {
    try {
      refuse_folder(input);
      Reader reader(input, options);
      for (bool is_first = true;; is_first = false) {
        auto record = reader.next();
        unjudged.add(reader.take_unread());
        has_ended_ |= !record;
        if (!record) return;
        if (record->value) {
          judge(*record);
          continue;
        }
        report(record->issues);
        const bool is_line = reader.format() == Format::cityjson_seq && !is_first;
        raise(is_line ? ExitCode::set_aside : ExitCode::input);
        unread_records_ += is_line ? 1 : 0;
      }
    } catch (const InputError& error) {
      report(with_file_advice(error.issue()));
      raise(ExitCode::input);
    }
  }

  void judge(const Checked<Document>& record) {
    const Document& document = *record.value;
    std::map<std::string, std::vector<Finding>> of_reading;
    for (const Issue& issue : record.issues) {
      found_ids_.insert(issue.place.building);
      if (issue.severity == Severity::error &&
          !arguments_.selection.takes(issue.place.building, document.feature_type))
        continue;
      if (issue.severity == Severity::error)
        add({issue.place.building.empty() ? document.name : issue.place.building,
             "",
             "",
             {finding_of(issue)}});
      else if (issue.code == Code::E313 || issue.code == Code::E314)
        of_reading[issue.place.building].push_back(finding_of(issue));
      else if (issue.code != Code::E311 && issue.code != Code::E312)  // judged with their places
        report(issue);
    }
    std::vector<GeometryFindings> judged;
    std::map<std::pair<std::size_t, std::string>, std::vector<std::size_t>> parts;  // in `judged`
    std::vector<const Building*> buildings;
    for (std::size_t i = 0; i < document.buildings.size(); ++i) {
      const Building& building = document.buildings[i];
      found_ids_.insert(building.id);
      if (!arguments_.selection.takes(building, document.feature_type)) continue;
      judged.push_back(findings_of(building, document.format, of_reading[building.id]));
      judged.back().number = number_among_several(document, i);
      buildings.push_back(&building);
      const std::size_t family = document.families.empty() ? i : document.families[i];
      are_buildings_ = are_buildings_ && family != kNoFamily && !judged.back().number;
      if (judged.back().is_valid_solid() && family != kNoFamily)
        parts[{family, building.lod}].push_back(judged.size() - 1);
    }
    for (const auto& [family, members] : parts) judge_parts(buildings, members, judged);
    for (const GeometryFindings& found : judged) add(found);
  }

  /// That of a geometry whose object has others of its level of detail.
  static std::optional<std::size_t> number_among_several(const Document& document, std::size_t i) {
    const auto is_beside = [&](std::size_t j) {
      return j < document.buildings.size() &&
             document.buildings[j].lod == document.buildings[i].lod &&
             document.source->places[j].object == document.source->places[i].object;
    };
    if (!document.source || !(is_beside(i + 1) || is_beside(i - 1))) return std::nullopt;
    return document.source->places[i].geometry;
  }

  /// The solids of a building that are valid by themselves.
  void judge_parts(const std::vector<const Building*>& buildings,
                   const std::vector<std::size_t>& members,
                   std::vector<GeometryFindings>& judged) const {
    std::vector<const Building*> parts;
    for (const std::size_t member : members) parts.push_back(buildings[member]);
    for (PartOverlap& overlap : overlapping_parts(parts, arguments_.options))
      judged[members[overlap.part]].findings.push_back(std::move(overlap.finding));
  }

  GeometryFindings findings_of(const Building& building, Format format,
                               std::vector<Finding> of_reading) const {
    ValidateOptions options = arguments_.options;
    // A mesh file does not state what it holds.
    const bool is_mesh = oriel::is_mesh(format);
    const bool is_solid = arguments_.primitive == "solid" ||
                          (arguments_.primitive == "stated" && (building.is_solid || is_mesh));
    options.primitive =
        is_solid && arguments_.primitive != "stated" ? ValidateOptions::Primitive::solid
        : is_mesh && is_solid                        ? ValidateOptions::Primitive::solid
        : arguments_.primitive == "surfaces"         ? ValidateOptions::Primitive::surfaces
                                                     : ValidateOptions::Primitive::as_stated;
    // As in val3dity a shell with an open ring is not judged as a shell.
    if (!of_reading.empty()) options.primitive = ValidateOptions::Primitive::surfaces;
    std::vector<Finding> findings = std::move(of_reading);
    for (Finding& finding : validate(building, options)) findings.push_back(std::move(finding));
    return {building.id, building.lod, is_solid ? "solid" : "surfaces", std::move(findings)};
  }

  void add(const GeometryFindings& found) {
    ++buildings_;
    for (const Finding& finding : found.findings) ++counts_[{finding.code, finding.val3dity}];
    if (!found.findings.empty()) {
      ++invalid_;
      raise(ExitCode::set_aside);
    } else if (arguments_.shows_problems_only) {
      return;
    }
    note(found);
    out_.append(arguments_.is_json ? json_line(found) : text_of(found, is_of_all_lods()));
  }

  /// For the SARIF log: every finding is an error in the input at hand.
  void note(const GeometryFindings& found) {
    for (const Finding& finding : found.findings) {
      Issue issue = building_issue(Severity::error, finding.code, found.id,
                                   found.id + ": " + finding.sentence);
      issue.place.file = input_;
      sarif_.add(issue);
    }
  }

  /// What was asked for and is not there; nothing to judge is no clean end either.
  void report_emptiness() {
    if (code_ == ExitCode::input) return;
    auto issues = arguments_.selection.unmet(found_ids_, buildings_ > 0);
    if (arguments_.selection.is_all() && buildings_ == 0)
      issues.push_back(nothing_to_work_on(arguments_.inputs, "no building"));
    for (const Issue& issue : issues) report(issue);
    if (!issues.empty()) raise(ExitCode::set_aside);
  }

  void report_summary() const {
    const auto valid = buildings_ - invalid_;
    std::string text = fmt::format("{} {} valid",
                                   is_of_all_lods() || !are_buildings_
                                       ? counted_of(valid, buildings_, "geometry", "geometries")
                                       : counted_of(valid, buildings_, "building"),
                                   agreeing_of(valid, buildings_, "is", "are"));
    const char* separator = "; ";
    for (const auto& [code, count] : counts_) {
      text += fmt::format("{}{} {}", separator, count, to_string(code.first));
      if (code.second > 0)
        text += fmt::format(" (val3dity {} {})", code.second, val3dity_name(code.second));
      separator = ", ";
    }
    if (unread_records_ > 0)
      text += fmt::format("; {} could not be read", counted(unread_records_, "record"));
    if (unjudged_ > 0)
      text += fmt::format("; {} not checked",
                          counted(unjudged_, "other object was", "other objects were"));
    run_log().write(LogLevel::info, text);
  }

  const ValidateArguments& arguments_;
  Report report_;
  OutputFile out_;
  SarifLog sarif_;
  std::string input_;  ///< the one at hand
  ExitCode code_ = ExitCode::clean;
  bool has_ended_ = false;  ///< an input did
  int buildings_ = 0;
  int invalid_ = 0;
  int unread_records_ = 0;
  int unjudged_ = 0;  ///< objects
  std::set<std::string> found_ids_;
  bool are_buildings_ = true;  ///< each was the one geometry of a building
  std::map<std::pair<Code, int>, int> counts_;
};

ExitCode work(ValidateArguments& arguments) {
  Report report(arguments.is_verbose);
  settle_inputs(arguments, report);
  NamedFiles files;
  files.add(arguments);
  files.add_output("-o", arguments.out);
  files.add_output("--sarif", arguments.sarif);
  files.check();
  return Validation(arguments).go();
}

}  // namespace

void add_validate(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<ValidateArguments>();
  CLI::App* command = app.add_subcommand(
      "validate", "Check the geometry of buildings as it was read, with the checks of val3dity");
  add_input_arguments(*command, *arguments, true);
  command->get_option("--lod")->description(
      "Level of detail to check, as written in the input, or all (default: the highest)");
  command->add_flag("--json", arguments->is_json,
                    "Write one JSON object per line and building instead of text");
  command->add_flag("--only-problems", arguments->shows_problems_only,
                    "Leave out buildings that are valid");
  command
      ->add_option("--as", arguments->primitive,
                   "Check the geometry as what the file states (OBJ, OFF and PLY: a solid), as a "
                   "solid, or as loose surfaces")
      ->check(one_of({"stated", "solid", "surfaces"}))
      ->capture_default_str();
  command
      ->add_option("--snap", arguments->options.snap_m,
                   "Count vertices closer than this as one, in m")
      ->check(number_in(1e-6, 1.0))
      ->capture_default_str();
  command
      ->add_option("--planarity", arguments->options.planarity_m,
                   "Largest distance of a point from its polygon's plane, in m")
      ->check(number_in(0.0, 1e3))
      ->capture_default_str();
  command
      ->add_option("--planarity-deg", arguments->options.planarity_deg,
                   "Largest deviation between the normals of a polygon's triangles, in degrees")
      ->check(number_in(0.0, 180.0))
      ->capture_default_str();
  command
      ->add_option("--budget", arguments->options.budget,
                   "Most steps that the checks may take on one building")
      ->check(above_zero())
      ->capture_default_str();
  command->add_option("-o,--output", arguments->out, "Where to write (default: stdout)");
  command->add_option("--sarif", arguments->sarif,
                      "Also write all findings to this file, as SARIF 2.1.0");
  command->add_flag("-v,--verbose", arguments->is_verbose, "Also show notes");
  command->footer(
      "Example:\n  oriel validate tile.city.jsonl --lod 2.2 --only-problems\n  oriel validate "
      "house.gml --json | jq '.findings[].code'");
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
