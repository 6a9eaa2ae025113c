#include "studio/server/http/http_server.h"

#include "kernel/base/code.h"
#include "kernel/base/issue.h"
#include "kernel/base/log.h"
#include "kernel/base/own_fault.h"
#include "kernel/model/version.h"
#include "studio/server/http/http_module.h"
#include "studio/server/page_files.h"
#include "studio/server/token.h"

#include <array>
#include <dlfcn.h>
#include <filesystem>
#include <string>
#include <system_error>
#include <utility>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

constexpr std::string_view kMissingPage =
    "<!doctype html><html lang=\"en\"><meta charset=\"utf-8\"><title>oriel studio</title>"
    "<p>This program was built without the page of the studio.</p></html>";

/// Pages and scripts come from here, connections go here; styles that the editor makes carry the
/// page's nonce.
std::string policy(const std::string& nonce) {
  return fmt::format(
      "default-src 'none'; script-src 'self' 'nonce-{0}'; style-src 'self' 'nonce-{0}'; "
      "connect-src 'self'; "
      "img-src 'self' data: blob:; base-uri 'none'; form-action 'none'; frame-ancestors 'none'",
      nonce);
}

std::string with_all(std::string text, std::string_view mark, const std::string& value) {
  for (std::size_t at = text.find(mark); at != std::string::npos;
       at = text.find(mark, at + value.size()))
    text.replace(at, mark.size(), value);
  return text;
}

const char* type_of(std::string_view file) {
  if (file.ends_with(".html")) return "text/html; charset=utf-8";
  if (file.ends_with(".css")) return "text/css; charset=utf-8";
  return file.ends_with(".js") ? "text/javascript; charset=utf-8" : "text/plain; charset=utf-8";
}

/// What the studio serves.
class StudioSite final : public HttpSite {
 public:
  StudioSite(ServedAt served, VerbAnswer answer)
      : served_(std::move(served)), answer_(std::move(answer)) {}

  [[nodiscard]] bool is_verb(std::string_view path) const override {
    return verb_of(path).has_value();
  }

  [[nodiscard]] AnswerPlan plan(const RequestHead& head) const override {
    const std::string nonce = random_token();
    AnswerPlan plan;
    plan.policy = policy(nonce);
    plan.refusal = refusal_of(head, served_);
    plan.is_verb = is_verb(head.path);
    if (plan.refusal && plan.refusal->status == 405)
      plan.allowed = plan.is_verb ? "POST" : "GET, HEAD";
    if (!plan.refusal && !plan.is_verb) add_file(head.path, nonce, plan);
    return plan;
  }

  [[nodiscard]] Reply answer(std::string_view path, std::string_view body) const override {
    return answer_(*verb_of(path), body);
  }

  [[nodiscard]] Reply error(int status, std::string_view sentence) const override {
    return error_reply(status, sentence);
  }

  [[nodiscard]] Reply fault(const std::exception_ptr& fault) const override {
    try {
      std::rethrow_exception(fault);
    } catch (const std::exception& exception) {
      const Issue issue = own_fault(exception);
      log("studio").write(LogLevel::error, exception.what());
      return error_reply(issue.code == Code::E507 ? 503 : 500, issue.sentence,
                         to_string(issue.code));
    }
  }

  /// The path only: the rest of an address may have the token.
  void log_refusal(std::string_view method, std::string_view path, int status) const override {
    log("studio").write(LogLevel::warning, fmt::format("refused: method={} path={} status={}",
                                                       method, path.substr(0, 200), status));
  }

 private:
  static void add_file(std::string_view path, const std::string& nonce, AnswerPlan& plan) {
    const std::string_view file = file_of(path);
    std::string text(page_file(file));
    if (file == "page.html") {
      if (text.empty()) text = kMissingPage;
      text = with_all(std::move(text), "@NONCE@", nonce);
    }
    if (text.empty()) {
      plan.refusal = error_reply(404, "this program was built without that part of the page");
      return;
    }
    plan.type = type_of(file);
    plan.text = std::make_shared<const std::string>(std::move(text));
  }

  ServedAt served_;
  VerbAnswer answer_;
};

[[noreturn]] void refuse_module(const std::string& file, const std::string& why) {
  Issue issue;
  issue.code = Code::E101;
  issue.sentence =
      "the part of oriel that serves its studio cannot be loaded: " + why + "; install oriel again";
  issue.place.file = file;
  throw InputError(std::move(issue));
}

/// Where the module of this program is: as installed, else as built.
std::string module_file() {
  std::error_code problem;
  const auto folder = std::filesystem::read_symlink("/proc/self/exe", problem).parent_path();
  std::string file;
  for (const char* place : {ORIEL_HTTP_INSTALLED, ORIEL_HTTP_BUILT}) {
    const auto found = (folder / place).lexically_normal();
    if (file.empty()) file = found.string();
    if (std::filesystem::exists(found, problem)) return found.string();
  }
  return file;
}

OpenHttp open_of_module() {
  const std::string file = module_file();
  std::error_code problem;
  if (!std::filesystem::exists(file, problem)) refuse_module(file, "there is no such file");
  void* module = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* open = module == nullptr ? nullptr : ::dlsym(module, "oriel_open_http");
  if (open == nullptr) refuse_module(file, ::dlerror());
  const auto* of = static_cast<const char*>(::dlsym(module, "oriel_http_version"));
  if (of == nullptr || std::string_view(of) != kVersion)
    refuse_module(file, "it is of another version of oriel");
  return reinterpret_cast<OpenHttp>(open);
}

/// Loaded once, until the program ends.
OpenHttp loaded() {
  static const OpenHttp open = open_of_module();
  return open;
}

}  // namespace

class HttpServer::Inside {
 public:
  Inside(int listening, ServedAt served, VerbAnswer answer)
      : site_(std::move(served), std::move(answer)), part_(loaded()(listening, site_)) {}

  HttpPart& part() { return *part_; }

 private:
  StudioSite site_;
  std::unique_ptr<HttpPart> part_;
};

void HttpServer::load_module() { loaded(); }

HttpServer::HttpServer(int listening, ServedAt served, VerbAnswer answer)
    : inside_(std::make_unique<Inside>(listening, std::move(served), std::move(answer))) {}

HttpServer::~HttpServer() = default;

void HttpServer::run() { inside_->part().run(); }

void HttpServer::stop() { inside_->part().stop(); }

}  // namespace oriel::studio
