#include "cli/commands/commands.h"
#include "cli/terminal/file_advice.h"
#include "cli/terminal/last_words.h"
#include "cli/terminal/logging.h"
#include "cli/terminal/print_out.h"
#include "cli/terminal/usage_advice.h"
#include "cli/version/version_text.h"
#include "io/files/output_file.h"
#include "kernel/base/issue.h"
#include "kernel/base/own_fault.h"
#include "kernel/base/text/printable.h"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <sstream>
#include <system_error>

#include <CLI/CLI.hpp>

namespace {

using namespace oriel::cli;

/// The handler is reset when it is called, so the signal that it raises ends the program.
extern "C" void end_by(int signal) {
  oriel::remove_temporary_files();
  say_last_words();
  std::raise(signal);
}

/// From now on signals that end the program (Ctrl-C, a closed pipe or terminal) first delete the
/// temporary files of outputs that are not done, and report what was summed so far. The program
/// still ends by the signal: its exit code is 128 + its number. A file that grows beyond its limit
/// becomes a failed write.
void clean_up_on_signals() {
  std::signal(SIGXFSZ,
              SIG_IGN);  // a file beyond `ulimit -f` is an error of writing, as on a full disk
  for (const int signal : {SIGHUP, SIGINT, SIGPIPE, SIGQUIT, SIGTERM, SIGXCPU}) {
    struct sigaction old {};
    ::sigaction(signal, nullptr, &old);
    if (old.sa_handler == SIG_IGN) continue;  // nohup, a shell's background job
    struct sigaction action {};
    action.sa_handler = end_by;
    action.sa_flags = SA_RESETHAND;
    ::sigaction(signal, &action, nullptr);
  }
}

/// Prints the help that was asked for; or says what is wrong with the arguments, in which names of
/// files may stand. True if it was help.
bool explain_usage(const CLI::App& app, const CLI::Error& error) {
  if (error.get_exit_code() == 0) {
    std::ostringstream out;
    app.exit(error, out, out);
    print_out(out.str());
    return true;
  }
  std::string sentence = usage_advice(app);
  if (sentence.empty()) sentence = usage_sentence(app, error);
  std::cerr << oriel::printable_lines(sentence + "\n" + pointer_to_help(app) + "\n");
  return false;
}

int exit_with(ExitCode code) { return static_cast<int>(code); }

/// What was printed is not lost in silence on a full disk.
void finish_stdout() {
  errno = 0;
  if (std::fflush(stdout) == 0 && std::ferror(stdout) == 0 && std::cout.flush()) return;
  oriel::Issue issue;
  issue.code = oriel::Code::E601;
  const int number = errno != 0 ? errno : print_failure();
  // What failed may have failed long ago, and the reason is gone.
  const std::string reason =
      number == 0 ? "not all of it arrived" : std::generic_category().message(number);
  issue.sentence = "cannot be written: " + reason;
  issue.place.file = "stdout";
  throw oriel::OutputError(std::move(issue));
}

int run(int argc, char** argv) {
  CLI::App app(
      "oriel finds the parts of 3D buildings, labels them by rules and redraws the buildings for a "
      "map scale.",
      "oriel");
  app.set_version_flag("--version", version_text());
  app.require_subcommand(1);
  Action action;
  add_cat(app, action);
  add_collect(app, action);
  add_segment(app, action);
  add_label(app, action);
  add_generalise(app, action);
  add_repair(app, action);
  add_explain(app, action);
  add_interpret(app, action);
  add_learn(app, action);
  add_diff(app, action);
  add_score(app, action);
  add_validate(app, action);
  add_view(app, action);
  add_tiles(app, action);
  add_studio(app, action);
  add_split(app, action);
  add_merge(app, action);
  add_rules(app, action);
  add_experiment(app, action);
  add_completion(app, action);
  LogOptions logging;
  add_log_arguments(app, logging);
  try {
    app.parse(argc, argv);
    set_up_logging(logging);
    const ExitCode code = action();
    finish_stdout();
    return exit_with(code);
  } catch (const CLI::ParseError& error) {
    const bool is_help = explain_usage(app, error);
    finish_stdout();
    return exit_with(is_help ? ExitCode::clean : ExitCode::usage);
  }
}

int guarded_main(int argc, char** argv) {
  set_up_logging({});
  Report report(true);
  try {
    return run(argc, argv);
  } catch (const oriel::InputError& error) {
    report.add(with_file_advice(error.issue()));
    return exit_with(ExitCode::input);
  } catch (const oriel::OutputError& error) {
    report.add(with_file_advice(error.issue()));
    return exit_with(ExitCode::output);
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& fault) {
    report.add(oriel::own_fault(fault));
    return exit_with(ExitCode::internal);
  }
}

}  // namespace

/// Words about a failure need memory, too.
int main(int argc, char** argv) {
  begin_to_throw_without_memory();
  clean_up_on_signals();
  try {
    return guarded_main(argc, argv);
  } catch (const std::bad_alloc&) {
    end_without_memory();
  }
}
