#include "cli/commands.h"
#include "cli/report.h"
#include "kernel/model/issue.h"
#include "kernel/model/version.h"

#include <cstdio>
#include <exception>

#include <CLI/CLI.hpp>

namespace {

using namespace oriel::cli;

int exit_with(ExitCode code) { return static_cast<int>(code); }

int run(int argc, char** argv) {
  CLI::App app(
      "oriel finds the parts of 3D buildings, names them by rules and redraws the building for a "
      "scale.",
      "oriel");
  app.set_version_flag("--version", oriel::kVersion);
  app.require_subcommand(1);
  Action action;
  add_segment(app, action);
  add_label(app, action);
  add_generalise(app, action);
  add_explain(app, action);
  add_score(app, action);
  add_rules(app, action);
  try {
    app.parse(argc, argv);
    return exit_with(action());
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? 0 : exit_with(ExitCode::usage);
  }
}

}  // namespace

int main(int argc, char** argv) {
  Report report(true);
  try {
    return run(argc, argv);
  } catch (const oriel::InputError& error) {
    report.tell(error.issue());
    return exit_with(ExitCode::input);
  } catch (const oriel::OutputError& error) {
    report.tell(error.issue());
    return exit_with(ExitCode::output);
  } catch (const std::exception& fault) {
    oriel::Issue issue;
    issue.code = "E901";
    issue.sentence = std::string("a fault of oriel's own: ") + fault.what();
    report.tell(issue);
    return exit_with(ExitCode::internal);
  }
}
