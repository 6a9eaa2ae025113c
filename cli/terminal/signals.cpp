#include "cli/terminal/signals.h"

#include "kernel/io/files/output_file.h"

#include <csignal>

namespace oriel::cli {

namespace {

/// The handler is reset when it is called, so the signal that it raises ends the program.
extern "C" void end_by(int signal) {
  oriel::remove_temporary_files();
  std::raise(signal);
}

}  // namespace

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

}  // namespace oriel::cli
