// CLI11: the command line. Trap: its own exit codes start at 100; oriel's code for wrong arguments
// is 2.
#include <cstdio>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>

/// The exit code of `oriel label` with these arguments.
int run(std::vector<const char*> arguments) {
  arguments.insert(arguments.begin(), "oriel");
  CLI::App app{"Names the parts of buildings"};
  app.require_subcommand(1);
  CLI::App* label = app.add_subcommand("label", "label a building");
  std::string input;
  int threads = 1;
  label->add_option("BUILDING", input)->required();
  label->add_option("-j,--threads", threads)->check(CLI::Range(1, 256));
  try {
    app.parse(static_cast<int>(arguments.size()), arguments.data());
  } catch (const CLI::CallForHelp& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& error) {
    std::printf("CLI11 would exit with %d: %s\n", error.get_exit_code(), error.what());
    return 2;
  }
  std::printf("label %s with %d threads\n", input.c_str(), threads);
  return 0;
}

int main() {
  const bool is_right = run({"label", "house.city.json", "-j", "4"}) == 0;
  const bool is_wrong = run({"label", "house.city.json", "-j", "0"}) == 2 && run({"lable"}) == 2;
  return is_right && is_wrong ? 0 : 1;
}
