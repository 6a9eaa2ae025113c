#include "cli/terminal/logging.h"

#include "cli/terminal/last_words.h"
#include "cli/terminal/option_values.h"
#include "kernel/base/text/printable.h"

#include <chrono>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <nlohmann/json.hpp>
#include <spdlog/formatter.h>
#include <spdlog/sinks/stdout_sinks.h>
#include <spdlog/spdlog.h>

namespace oriel::cli {

namespace {

using spdlog::details::log_msg;

constexpr const char* kFindings = "findings";
constexpr const char* kProgress = "progress";
constexpr const char* kRun = "run";
constexpr std::array kRooms{"kernel", "interpret", "generalise", "oriel", "studio"};

bool is_json = false;

bool has_colours() {
  const char* no_colour = std::getenv("NO_COLOR");
  return isatty(STDERR_FILENO) != 0 && (no_colour == nullptr || *no_colour == '\0');
}

std::string_view view(spdlog::string_view_t text) { return {text.data(), text.size()}; }

void append(spdlog::memory_buf_t& line, std::string_view text) {
  line.append(text.data(), text.data() + text.size());
}

/// What a finding begins with in text.
std::string head_of_finding(spdlog::level::level_enum level, bool has_colours) {
  const bool is_error = level >= spdlog::level::err, is_warning = level == spdlog::level::warn;
  const char* word = is_error ? "error" : is_warning ? "warning" : "note";
  const char* colour = is_error ? "\033[31m" : is_warning ? "\033[33m" : "\033[36m";
  return has_colours ? fmt::format("{}{}\033[0m: ", colour, word) : fmt::format("{}: ", word);
}

/// Lines for a reader.
class TextFormatter final : public spdlog::formatter {
 public:
  void format(const log_msg& message, spdlog::memory_buf_t& line) override {
    const std::string_view logger = view(message.logger_name);
    if (logger == kFindings)
      append(line, head_of_finding(message.level, has_colours_));
    else if (logger != kRun && logger != kProgress)
      append(line,
             fmt::format("[{}] {}: ", view(spdlog::level::to_string_view(message.level)), logger));
    const bool is_of_room = logger != kFindings && logger != kRun && logger != kProgress;
    const std::string_view text = view(message.payload);
    append(line, is_of_room ? printable(text) : printable_lines(text));
    append(line, "\n");
  }

  [[nodiscard]] std::unique_ptr<spdlog::formatter> clone() const override {
    return std::make_unique<TextFormatter>(*this);
  }

 private:
  bool has_colours_ = has_colours();
};

/// A JSON object a line, for programs. Findings and progress are objects already: their members
/// follow.
class JsonFormatter final : public spdlog::formatter {
 public:
  void format(const log_msg& message, spdlog::memory_buf_t& line) override {
    using nlohmann::ordered_json;
    const std::string_view logger = view(message.logger_name), text = view(message.payload);
    ordered_json object{{"time", utc(message.time)},
                        {"level", view(spdlog::level::to_string_view(message.level))},
                        {"logger", logger}};
    if (logger == kFindings || logger == kProgress)
      object.update(ordered_json::parse(text));
    else
      object["message"] = text;
    append(line, object.dump(-1, ' ', false, ordered_json::error_handler_t::replace) + "\n");
  }

  [[nodiscard]] std::unique_ptr<spdlog::formatter> clone() const override {
    return std::make_unique<JsonFormatter>();
  }

 private:
  /// 2026-01-31T23:59:59.999Z
  static std::string utc(spdlog::log_clock::time_point time) {
    const std::time_t seconds = spdlog::log_clock::to_time_t(time);
    const auto ms =
        std::chrono::duration_cast<std::chrono::milliseconds>(time.time_since_epoch()).count();
    std::tm parts{};
    ::gmtime_r(&seconds, &parts);
    std::array<char, 32> text{};
    std::strftime(text.data(), text.size(), "%Y-%m-%dT%H:%M:%S", &parts);
    return fmt::format("{}.{:03}Z", text.data(), ms % 1000);
  }
};

/// With --log-json a finding is an object of its parts.
std::string json_of(const Issue& issue) {
  nlohmann::ordered_json object{{"code", to_string(issue.code)}, {"message", issue.sentence}};
  const auto add = [&](const char* name, const std::string& text) {
    if (!text.empty()) object[name] = text;
  };
  add("file", issue.place.file);
  if (issue.place.line > 0) object["line"] = issue.place.line;
  if (issue.place.column > 0) object["column"] = issue.place.column;
  add("building", issue.place.building);
  add("feature", issue.place.feature);
  return object.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

spdlog::level::level_enum level_of(const std::string& name,
                                   spdlog::level::level_enum without_name) {
  return name.empty() ? without_name : spdlog::level::from_str(name);
}

}  // namespace

void add_log_arguments(CLI::App& command, LogOptions& options) {
  // Groups of options are nameless subcommands to CLI11.
  const auto below =
      command.get_subcommands([](const CLI::App* one) { return !one->get_name().empty(); });
  for (CLI::App* one : below) add_log_arguments(*one, options);
  if (!below.empty()) return;
  command
      .add_option("--log-level", options.level,
                  "What to log on stderr (default: findings and summaries)")
      ->check(one_of({"trace", "debug", "info", "warn", "error", "off"}))
      ->group("Logging");
  command.add_flag("--log-json", options.is_json, "Log one JSON object per line")->group("Logging");
}

void set_up_logging(const LogOptions& options) {
  is_json = options.is_json;
  const auto sink = std::make_shared<spdlog::sinks::stderr_sink_mt>();
  if (is_json)
    sink->set_formatter(std::make_unique<JsonFormatter>());
  else
    sink->set_formatter(std::make_unique<TextFormatter>());
  const auto add = [&](const char* name, spdlog::level::level_enum level) {
    const auto logger = std::make_shared<spdlog::logger>(name, sink);
    logger->set_level(level);
    spdlog::drop(name);
    spdlog::register_logger(logger);
  };
  for (const char* name : {kFindings, kProgress, kRun})
    add(name, level_of(options.level, spdlog::level::info));
  for (const char* name : kRooms) add(name, level_of(options.level, spdlog::level::warn));
}

bool logs_json() { return is_json; }

Log findings_log() { return log(kFindings); }
Log progress_log() { return log(kProgress); }
Log run_log() { return log(kRun); }

void Report::add(const std::vector<Issue>& issues) {
  bool is_kept = false;
  for (const Issue& issue : issues) is_kept = add_one(issue) || is_kept;
  if (is_kept) keep_sums_as_last_words();
}

void Report::add(const Issue& issue) {
  if (add_one(issue)) keep_sums_as_last_words();
}

bool Report::add_one(const Issue& issue) {
  if (issue.severity == Severity::error) ++errors_[to_string(issue.code)];
  const bool lists_all = is_verbose_ || logs_json() || findings_log().is_on(LogLevel::debug);
  const bool is_kept = !lists_all && sums_.keep(issue);
  if (!is_kept) write(issue);
  return is_kept;
}

void Report::keep_sums_as_last_words() const {
  std::string lines = isatty(STDERR_FILENO) != 0 ? "\r\033[K" : "";  // in place of a bar
  const std::size_t before = lines.size();
  for (const Issue& issue : sums_.so_far()) {
    const bool is_error = issue.severity == Severity::error;
    if (!findings_log().is_on(is_error ? LogLevel::error : LogLevel::warning)) continue;
    lines += head_of_finding(is_error ? spdlog::level::err : spdlog::level::warn, has_colours()) +
             printable_lines(to_string(issue)) + "\n";
  }
  if (lines.size() > before) keep_last_words(std::move(lines));
}

void Report::finish() {
  bool is_summed = false;
  for (const Issue& issue : sums_.take()) {
    is_summed = is_summed || issue.place.building.empty();
    write(issue);
  }
  if (is_summed)
    run_log().info("findings about several buildings are summed by code; --verbose lists all");
  keep_last_words({});
}

/// Words that cannot be said any more for want of memory are no reason to end by a signal.
Report::~Report() {
  try {
    finish();
  } catch (...) {
    return;
  }
}

void Report::write(const Issue& issue) const {
  LogLevel level = is_verbose_ ? LogLevel::info : LogLevel::debug;
  if (issue.severity == Severity::warning) level = LogLevel::warning;
  if (issue.severity == Severity::error) level = LogLevel::error;
  const Log log = findings_log();
  if (log.is_on(level)) log.write(level, logs_json() ? json_of(issue) : to_string(issue));
}

}  // namespace oriel::cli
