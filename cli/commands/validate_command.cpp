#include "cli/commands/commands.h"
#include "cli/commands/options.h"
#include "cli/terminal/logging.h"
#include "kernel/base/printable.h"
#include "kernel/io/files/output_file.h"
#include "oriel/read.h"
#include "oriel/validate.h"

#include <algorithm>
#include <map>
#include <memory>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace oriel::cli {

namespace {

using nlohmann::ordered_json;

struct ValidateArguments : RunOptions {
  bool is_json = false;
  bool shows_problems_only = false;
  std::string primitive = "stated";
  std::string out = "-";
  ValidateOptions options;
};

/// A building and all that was found about it.
struct BuildingFindings {
  std::string id;
  std::string lod;
  /// "solid" or "surfaces"; empty for a building that could not be read.
  std::string primitive;
  std::vector<Finding> findings;
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

std::string json_line(const BuildingFindings& found) {
  ordered_json out{{"id", found.id}};
  if (!found.primitive.empty()) {
    out["lod"] = found.lod;
    out["primitive"] = found.primitive;
  }
  out["valid"] = found.findings.empty();
  out["findings"] = ordered_json::array();
  for (const Finding& finding : found.findings) out["findings"].push_back(json_of(finding));
  return out.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n";
}

std::string text_of(const BuildingFindings& found) {
  if (found.findings.empty())
    return fmt::format("{}: valid{}\n", printable(found.id),
                       found.primitive == "surfaces" ? " as loose surfaces" : "");
  std::string text = fmt::format("{}: {} finding{}\n", printable(found.id), found.findings.size(),
                                 found.findings.size() == 1 ? "" : "s");
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
      throw CLI::ValidationError("input", "stdin can be read only once");
    for (const std::string& input : arguments_.inputs) read(input);
    out_.commit();
    report_summary();
    return code_;
  }

 private:
  void raise(ExitCode code) { code_ = graver(code_, code); }

  void read(const std::string& input) {
    try {
      Reader reader(input, arguments_.read_options(input));
      for (bool is_first = true;; is_first = false) {
        auto record = reader.next();
        if (!record) return;
        if (record->value) {
          judge(*record);
          continue;
        }
        report_.add(record->issues);
        const bool is_line = reader.format() == Format::cityjson_seq && !is_first;
        raise(is_line ? ExitCode::set_aside : ExitCode::input);
        unread_records_ += is_line ? 1 : 0;
      }
    } catch (const InputError& error) {
      report_.add(error.issue());
      raise(ExitCode::input);
    }
  }

  void judge(const Checked<Document>& record) {
    std::map<std::string, std::vector<Finding>> open_rings;
    for (const Issue& issue : record.issues) {
      if (issue.code == Code::E314)
        open_rings[issue.place.building].push_back(finding_of(issue));
      else if (issue.severity == Severity::error &&
               !arguments_.selection.takes(issue.place.building, record.value->feature_type))
        continue;
      else if (issue.severity == Severity::error)
        add({issue.place.building.empty() ? record.value->name : issue.place.building,
             "",
             "",
             {finding_of(issue)}});
      else if (issue.code != Code::E311 && issue.code != Code::E312)  // judged with their places
        report_.add(issue);
    }
    for (const Building& building : record.value->buildings)
      if (arguments_.selection.takes(building, record.value->feature_type))
        judge(building, record.value->format, std::move(open_rings[building.id]));
  }

  void judge(const Building& building, Format format, std::vector<Finding> open_rings) {
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
    if (!open_rings.empty()) options.primitive = ValidateOptions::Primitive::surfaces;
    std::vector<Finding> findings = std::move(open_rings);
    for (Finding& finding : validate(building, options)) findings.push_back(std::move(finding));
    add({building.id, building.lod, is_solid ? "solid" : "surfaces", std::move(findings)});
  }

  void add(const BuildingFindings& found) {
    ++buildings_;
    for (const Finding& finding : found.findings) ++counts_[{finding.code, finding.val3dity}];
    if (!found.findings.empty()) {
      ++invalid_;
      raise(ExitCode::set_aside);
    } else if (arguments_.shows_problems_only) {
      return;
    }
    out_.append(arguments_.is_json ? json_line(found) : text_of(found));
  }

  void report_summary() const {
    std::string text = fmt::format("{} of {} building{} valid", buildings_ - invalid_, buildings_,
                                   buildings_ == 1 ? " is" : "s are");
    const char* separator = "; ";
    for (const auto& [code, count] : counts_) {
      text += fmt::format("{}{} {}", separator, count, to_string(code.first));
      if (code.second > 0)
        text += fmt::format(" (val3dity {} {})", code.second, val3dity_name(code.second));
      separator = ", ";
    }
    if (unread_records_ > 0) text += fmt::format("; {} records could not be read", unread_records_);
    run_log().write(LogLevel::info, text);
  }

  const ValidateArguments& arguments_;
  Report report_;
  OutputFile out_;
  ExitCode code_ = ExitCode::clean;
  int buildings_ = 0;
  int invalid_ = 0;
  int unread_records_ = 0;
  std::map<std::pair<Code, int>, int> counts_;
};

}  // namespace

void add_validate(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<ValidateArguments>();
  CLI::App* command = app.add_subcommand(
      "validate", "Check the geometry of buildings as it was read, as val3dity does");
  add_input_arguments(*command, *arguments, true);
  command->add_flag("--json", arguments->is_json,
                    "One JSON object per building and line instead of text");
  command->add_flag("--only-problems", arguments->shows_problems_only,
                    "Leave out buildings that are valid");
  command
      ->add_option("--as", arguments->primitive,
                   "Check as what the file states (OBJ and OFF: a solid), as a solid, or as loose "
                   "surfaces")
      ->check(CLI::IsMember({"stated", "solid", "surfaces"}))
      ->capture_default_str();
  command
      ->add_option("--snap", arguments->options.snap_m, "Vertices closer than this are one, in m")
      ->check(CLI::Range(1e-6, 1.0))
      ->capture_default_str();
  command
      ->add_option("--planarity", arguments->options.planarity_m,
                   "How far a point may lie off its polygon's plane, in m")
      ->check(CLI::Range(0.0, 1e3))
      ->capture_default_str();
  command
      ->add_option("--planarity-deg", arguments->options.planarity_deg,
                   "How far the normals of a polygon's triangles may deviate")
      ->check(CLI::Range(0.0, 180.0))
      ->capture_default_str();
  command->add_option("-o,--output", arguments->out, "Where to write (default: stdout)");
  command->add_flag("-v,--verbose", arguments->is_verbose, "Show notes, too");
  command->footer(
      "Example:\n  oriel validate tile.city.jsonl --lod 2.2 --only-problems\n  oriel validate "
      "house.gml --json | jq '.findings[].code'");
  command->callback(
      [arguments, &action] { action = [arguments] { return Validation(*arguments).go(); }; });
}

}  // namespace oriel::cli
