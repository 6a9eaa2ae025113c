#include "cli/batch/run.h"
#include "cli/commands/commands.h"
#include "cli/commands/options.h"
#include "cli/output/destination.h"
#include "cli/pipeline/mended_line.h"
#include "cli/pipeline/written_proof.h"
#include "cli/terminal/logging.h"
#include "kernel/io/files/output_file.h"
#include "kernel/io/records/repair_json.h"
#include "kernel/model/version.h"

#include <algorithm>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

namespace oriel::cli {

namespace {

struct Arguments : LineArguments {
  std::string out;
  std::string to;
  std::string report;
};

/// Facets that oriel made close what the data leave open: a ClosureSurface where the building has
/// semantics.
void label_caps(const Building& building, LabelledBuilding& repaired) {
  if (std::ranges::all_of(building.polygons, [](const Polygon& p) { return p.hint.empty(); }))
    return;
  for (const Facet& facet : repaired.geometry->facets) {
    repaired.surface_of_polygon.push_back(facet.polygons.empty() ? 0 : -1);
    if (facet.polygons.empty() && repaired.surfaces.empty())
      repaired.surfaces.push_back({"ClosureSurface", -1, {}});
  }
}

/// The building with its solid in the place of its polygons, and counts of what was repaired.
LabelledBuilding repaired_building(const Building& building, const OnLine& line,
                                   bool keeps_semantics, int digits) {
  LabelledBuilding repaired;
  repaired.building = building.id;
  repaired.geometry = line.solid;
  repaired.digits = digits;
  repaired.keeps_semantics = keeps_semantics;
  if (keeps_semantics) label_caps(building, repaired);
  const auto add_count = [&](const char* name, std::size_t count) {
    if (count > 0) repaired.attributes.emplace_back(name, static_cast<std::int64_t>(count));
  };
  repaired.attributes.emplace_back("oriel_version", std::string(kVersion));
  add_count("oriel_repair_duplicates", line.repair.duplicates.size());
  add_count("oriel_repair_dangling", line.repair.dangling.size());
  add_count("oriel_repair_inner", line.repair.inner.size());
  add_count("oriel_repair_caps", line.repair.caps.size());
  return repaired;
}

/// What was done to a building, in words.
std::string summary_of(const Building& building, const OnLine& line) {
  const RepairReport& report = line.repair;
  if (!report.was_needed)
    return fmt::format("{}: {}", building.id,
                       line.solid ? "closed already" : "could not be repaired");
  if (!line.solid)
    return fmt::format("{}: stays open, {} open edges", building.id, report.open_edges.size());
  double closed_m2 = 0;
  for (const Cap& cap : report.caps) closed_m2 += cap.area_m2;
  return fmt::format(
      "{}: repaired: {} doubles dropped, {} vertices put into edges, {} polygons cut at contacts, "
      "{} edges of more than two "
      "polygons, {} polygons turned round, {} dangling sheets ({:.2f} m2) and {} inner faces "
      "({:.2f} m2) left out, {} holes closed ({:.2f} m2), {} detached shells, {} cavities",
      building.id, report.duplicates.size(), report.t_vertices, report.cut, report.crowded_edges,
      report.turned, report.dangling.size(), report.dangling_area_m2, report.inner.size(),
      report.inner_area_m2, report.caps.size(), closed_m2, report.detached_shells, report.cavities);
}

class Repairer {
 public:
  Repairer(const Arguments& arguments, Run& run)
      : arguments_(arguments),
        run_(run),
        destination_(arguments.out, arguments.to, arguments.inputs,
                     arguments.read_options().format) {}

  ExitCode go() {
    Run::Visitor visitor;
    visitor.begin = [&](std::size_t input) {
      destination_.begin(input, !run_.is_last_run());
      if (run_.is_last_run() && !report_ && !arguments_.report.empty())
        report_ = std::make_unique<OutputFile>(arguments_.report);
    };
    visitor.record = [&](const Document& document, std::vector<OnLine>& lines) {
      run_.timings().measure(Stage::write, [&] { add(document, lines); });
    };
    visitor.end = [&](std::size_t) {
      has_ended_ = true;
      run_.timings().measure(Stage::write, [&] { destination_.end(); });
    };
    visitor.commit = [&] {
      if (report_ && has_ended_) report_->commit();
    };
    const ExitCode code = run_.go(visitor);
    run_.tell_summary(fmt::format("closed ({} repaired, {} found closed)", repaired_, closed_), {});
    return code;
  }

 private:
  /// A solid that would not be valid when it is read again is none.
  void prove(const Document& document, const Building& building, OnLine& line,
             std::vector<LabelledBuilding>& solids) {
    if (!line.solid) return;
    WrittenProof proof = prove_written(document, building, *line.solid);
    if (proof.fault && arguments_.crossings == "cut") {
      if (auto mended =
              mended_solid(arguments_, document, building, arguments_.tolerances, run_.timings())) {
        line.solid = std::move(mended->line.solid);
        line.repair = std::move(mended->line.repair);
        proof = {mended->digits, {}, {}};
      }
    }
    if (proof.fault) {
      line.solid.reset();
      line.issues.push_back(*proof.fault);
      run_.set_aside(*proof.fault);
      return;
    }
    solids.push_back(
        repaired_building(building, line, !arguments_.ignores_semantics, proof.digits));
  }

  void add(const Document& document, std::vector<OnLine>& lines) {
    std::vector<LabelledBuilding> solids;
    for (std::size_t i = 0; i < lines.size(); ++i) {
      const Building& building = document.buildings[i];
      OnLine& line = lines[i];
      prove(document, building, line, solids);
      if (!run_.is_last_run()) continue;
      if (line.solid) ++(line.repair.was_needed ? repaired_ : closed_);
      if (arguments_.is_verbose) run_log().write(LogLevel::info, summary_of(building, line));
      if (report_)
        report_->append(repair_json(building, line.solid.has_value(), line.repair, line.issues));
    }
    destination_.add(document, solids, {});
  }

  const Arguments& arguments_;
  Run& run_;
  Destination destination_;
  std::unique_ptr<OutputFile> report_;
  bool has_ended_ = false;  ///< an input did
  int repaired_ = 0, closed_ = 0;
};

ExitCode work(const Arguments& arguments) {
  Report report(arguments.is_verbose);
  Run run(arguments, nullptr, report);
  return Repairer(arguments, run).go();
}

}  // namespace

void add_repair(CLI::App& app, Action& action) {
  auto arguments = std::make_shared<Arguments>();
  arguments->ends_at_solid = true;
  arguments->crossings = "cut";
  CLI::App* command = app.add_subcommand(
      "repair", "Make valid solids of buildings: closed, oriented, with plane faces");
  add_input_arguments(*command, *arguments, true);
  command
      ->add_option("-o,--output", arguments->out,
                   "File, - for stdout, or a folder (with a / at its end) for several inputs")
      ->required();
  command->add_option("--to", arguments->to, "Format to write (default: by the name of the output)")
      ->check(CLI::IsMember({"cityjson", "cityjsonseq", "obj", "off", "stl"}));
  command->add_flag("--ignore-semantics", arguments->ignores_semantics,
                    "Write the solids without the semantics that the polygons had");
  command->add_option("--report", arguments->report,
                      "Write what was done to this file: one JSON object per building and line");
  add_solid_arguments(*command, *arguments);
  add_run_arguments(*command, *arguments);
  command->footer(
      "Buildings that stay open are written unchanged, and the exit code is 3.\n"
      "Example:\n  oriel repair house.city.json -o repaired.city.json\n"
      "  oriel repair city/*.city.json -o repaired/ --close any --report repairs.jsonl");
  command->callback([arguments, &action] { action = [arguments] { return work(*arguments); }; });
}

}  // namespace oriel::cli
