#include "studio/server/http/http_module.h"

#include <exception>
#include <httplib.h>
#include <iterator>
#include <string>
#include <string_view>
#include <unistd.h>
#include <utility>

namespace oriel::studio {

namespace {

/// Slow verbs block their threads: so many at the same time leave some for quick ones.
constexpr std::size_t kThreads = 32;

// With the character set these are none of the types that cpp-httplib would compress.
constexpr const char* kJson = "application/json; charset=utf-8";
constexpr const char* kBytes = "application/octet-stream";

httplib::Headers common_headers() {
  return {{"Cache-Control", "no-store"},
          {"Referrer-Policy", "no-referrer"},
          {"X-Content-Type-Options", "nosniff"},
          {"Cross-Origin-Resource-Policy", "same-origin"},
          {"Cross-Origin-Opener-Policy", "same-origin"}};
}

/// A header that stands there once; two are as wrong as a wrong one.
std::optional<std::string> header_of(const httplib::Request& request, const char* name) {
  const auto [from, to] = request.headers.equal_range(name);
  if (from == to) return std::nullopt;
  return std::next(from) == to ? from->second : std::string();
}

RequestHead head_of(const httplib::Request& request, const HttpSite& site) {
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
  if (!head.token && !site.is_verb(head.path) && request.has_param("token"))
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
              const std::string& type) {
  response.status = 200;
  const std::size_t size = text->size();
  response.set_content_provider(
      size, type.c_str(),
      [text = std::move(text)](std::size_t from, std::size_t count, auto& sink) {
        return sink.write(text->data() + from, count);
      });
}

/// The server takes a socket that was opened elsewhere.
class SocketServer : public httplib::Server, public HttpPart {
 public:
  SocketServer(int listening, const HttpSite& site) : site_(site) {
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
    set_error_handler(HandlerWithResponse([this](const auto&, auto& response) {
      if (response.body.empty())
        set(response, site_.error(response.status, httplib_words(response.status)));
      return HandlerResponse::Handled;
    }));
    set_exception_handler([this](const auto&, auto& response, std::exception_ptr fault) {
      set(response, site_.fault(fault));
    });
    set_logger([this](const auto& request, const auto& response) {
      if (response.status >= 400 && response.status != 409)
        site_.log_refusal(request.method, request.path, response.status);
    });
  }

  void run() override { listen_after_bind(); }
  void stop() override { httplib::Server::stop(); }

 private:
  /// True if the request is answered: all but verbs that may be asked.
  bool give_file(const httplib::Request& request, httplib::Response& response) {
    const RequestHead head = head_of(request, site_);
    AnswerPlan plan = site_.plan(head);
    response.set_header("Content-Security-Policy", plan.policy);
    if (plan.refusal) {
      if (!plan.allowed.empty()) response.set_header("Allow", plan.allowed);
      // The body is read first (give_answer): a connection that ends unread may lose the answer.
      const bool has_end = head.content_length && !head.has_transfer_encoding;
      if (head.method == "POST" && plan.is_verb && has_end) return false;
      set(response, std::move(*plan.refusal));
      return true;
    }
    if (plan.is_verb) return false;
    set_text(response, std::move(plan.text), plan.type);
    return true;
  }

  void give_answer(const httplib::Request& request, httplib::Response& response,
                   const httplib::ContentReader& read) {
    auto refusal = site_.plan(head_of(request, site_)).refusal;
    std::string body;
    const bool is_whole = read([&](const char* data, std::size_t size) {
      if (body.size() + size > kMostBodyBytes) return false;
      if (!refusal) body.append(data, size);
      return true;
    });
    if (refusal)
      set(response, std::move(*refusal));
    else if (!is_whole)
      set(response, site_.error(400, "the request ends too early"));
    else
      set(response, site_.answer(request.path, body));
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

  const HttpSite& site_;
};

}  // namespace

}  // namespace oriel::studio

extern "C" {

extern const char oriel_http_version[];
const char oriel_http_version[] = ORIEL_HTTP_VERSION;

oriel::studio::HttpPart* oriel_open_http(int listening, const oriel::studio::HttpSite& site) {
  return new oriel::studio::SocketServer(listening, site);
}
}
