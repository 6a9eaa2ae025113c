#include "studio/server/http_server.h"

#include "kernel/base/code.h"
#include "kernel/base/log.h"
#include "studio/server/page_files.h"
#include "studio/server/token.h"

#include <exception>
#include <httplib.h>
#include <new>
#include <string>
#include <unistd.h>
#include <utility>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

/// Slow verbs block their threads: so many at the same time leave some for quick ones.
constexpr std::size_t kThreads = 32;

// With the character set these are none of the types that cpp-httplib would compress.
constexpr const char* kJson = "application/json; charset=utf-8";
constexpr const char* kBytes = "application/octet-stream";

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

httplib::Headers common_headers() {
  return {{"Cache-Control", "no-store"},
          {"Referrer-Policy", "no-referrer"},
          {"X-Content-Type-Options", "nosniff"},
          {"Cross-Origin-Resource-Policy", "same-origin"},
          {"Cross-Origin-Opener-Policy", "same-origin"}};
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

/// A header that stands there once; two are as wrong as a wrong one.
std::optional<std::string> header_of(const httplib::Request& request, const char* name) {
  const auto [from, to] = request.headers.equal_range(name);
  if (from == to) return std::nullopt;
  return std::next(from) == to ? from->second : std::string();
}

RequestHead head_of(const httplib::Request& request) {
  RequestHead head{request.method,
                   request.path,
                   header_of(request, "Host"),
                   header_of(request, "Origin"),
                   header_of(request, "Sec-Fetch-Site"),
                   header_of(request, "X-Oriel-Token"),
                   header_of(request, "Content-Type"),
                   header_of(request, "Content-Length"),
                   request.has_header("Range"),
                   request.has_header("Transfer-Encoding"),
                   request.has_header("Content-Encoding")};
  if (!head.token && !verb_of(head.path) && request.has_param("token"))
    head.token = request.get_param_value("token");
  return head;
}

void set(httplib::Response& response, Reply reply) {
  response.status = reply.status;
  const bool is_json = reply.bytes.empty();
  response.body = std::move(is_json ? reply.json : reply.bytes);
  response.set_header("Content-Type", is_json ? kJson : kBytes);
}

/// What is written by a provider is not compressed.
void set_text(httplib::Response& response, std::shared_ptr<const std::string> text,
              const char* type) {
  response.status = 200;
  const std::size_t size = text->size();
  response.set_content_provider(
      size, type, [text = std::move(text)](std::size_t from, std::size_t count, auto& sink) {
        return sink.write(text->data() + from, count);
      });
}

/// The path only: the rest of an address may have the token.
void log_refusal(const httplib::Request& request, const httplib::Response& response) {
  log("studio").write(LogLevel::warning,
                      fmt::format("refused: method={} path={} status={}", request.method,
                                  request.path.substr(0, 200), response.status));
}

}  // namespace

/// The server takes a socket that was opened elsewhere.
class HttpServer::Inside : public httplib::Server {
 public:
  Inside(int listening, ServedAt served, VerbAnswer answer)
      : served_(std::move(served)), answer_(std::move(answer)) {
    svr_sock_ = ::dup(listening);
    new_task_queue = [] { return new httplib::ThreadPool(kThreads); };
    // A body that was refused unread is then not taken for the next request, and connections that
    // browsers keep open hold no thread.
    set_keep_alive_max_count(1);
    set_default_headers(common_headers());
    set_pre_routing_handler([this](const auto& request, auto& response) {
      return give_file(request, response) ? HandlerResponse::Handled : HandlerResponse::Unhandled;
    });
    Post("/api/.*",
         [this](const httplib::Request& request, httplib::Response& response,
                const httplib::ContentReader& read) { give_answer(request, response, read); });
    set_error_handler(HandlerWithResponse([](const auto&, auto& response) {
      if (response.body.empty())
        set(response, error_reply(response.status, httplib_words(response.status)));
      return HandlerResponse::Handled;
    }));
    set_exception_handler([](const auto&, auto& response, std::exception_ptr fault) {
      set(response, reply_of(fault));
    });
    set_logger([](const auto& request, const auto& response) {
      if (response.status >= 400 && response.status != 409) log_refusal(request, response);
    });
  }

 private:
  /// True if the request is answered: all but verbs that may be asked.
  bool give_file(const httplib::Request& request, httplib::Response& response) {
    const RequestHead head = head_of(request);
    auto refusal = refusal_of(head, served_);
    const std::string nonce = random_token();
    response.set_header("Content-Security-Policy", policy(nonce));
    if (refusal) {
      if (refusal->status == 405)
        response.set_header("Allow", verb_of(head.path) ? "POST" : "GET, HEAD");
      // The body is read first (give_answer): a connection that ends unread may lose the answer.
      const bool has_end = head.content_length && !head.has_transfer_encoding;
      if (head.method == "POST" && verb_of(head.path) && has_end) return false;
      set(response, std::move(*refusal));
      return true;
    }
    if (verb_of(head.path)) return false;
    const std::string_view file = file_of(head.path);
    std::string text(page_file(file));
    if (file == "page.html") {
      if (text.empty()) text = kMissingPage;
      text = with_all(std::move(text), "@NONCE@", nonce);
    }
    if (text.empty())
      set(response, error_reply(404, "this program was built without that part of the page"));
    else
      set_text(response, std::make_shared<const std::string>(std::move(text)), type_of(file));
    return true;
  }

  void give_answer(const httplib::Request& request, httplib::Response& response,
                   const httplib::ContentReader& read) {
    const RequestHead head = head_of(request);
    auto refusal = refusal_of(head, served_);
    std::string body;
    const bool is_whole = read([&](const char* data, std::size_t size) {
      if (body.size() + size > kMostBodyBytes) return false;
      if (!refusal) body.append(data, size);
      return true;
    });
    if (refusal)
      set(response, std::move(*refusal));
    else if (!is_whole)
      set(response, error_reply(400, "the request ends too early"));
    else
      set(response, answer_(*verb_of(head.path), body));
  }

  static std::string_view httplib_words(int status) {
    switch (status) {
      case 404:
        return "there is nothing here";
      case 413:
        return "the request is too long";
      case 414:
        return "the address is too long";
      default:
        return "the request cannot be understood";
    }
  }

  static Reply reply_of(const std::exception_ptr& fault) {
    try {
      std::rethrow_exception(fault);
    } catch (const std::bad_alloc&) {
      return error_reply(503, "there is not enough memory for this", to_string(Code::E507));
    } catch (const std::exception& exception) {
      log("studio").write(LogLevel::error, exception.what());
      return error_reply(500, std::string("a fault of oriel's own: ") + exception.what(),
                         to_string(Code::E901));
    }
  }

  ServedAt served_;
  VerbAnswer answer_;
};

HttpServer::HttpServer(int listening, ServedAt served, VerbAnswer answer)
    : inside_(std::make_unique<Inside>(listening, std::move(served), std::move(answer))) {}

HttpServer::~HttpServer() = default;

void HttpServer::run() { inside_->listen_after_bind(); }

void HttpServer::stop() { inside_->stop(); }

}  // namespace oriel::studio
