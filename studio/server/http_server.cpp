#include "studio/server/http_server.h"

#include "kernel/base/code.h"
#include "kernel/base/issue.h"
#include "kernel/base/log.h"
#include "kernel/base/own_fault.h"
#include "studio/server/page_files.h"
#include "studio/server/token.h"

#include <exception>
#include <fcntl.h>
#include <iterator>
#include <limits>
#include <list>
#include <string>
#include <utility>

#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/post.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/thread_pool.hpp>
#include <boost/beast/core/flat_buffer.hpp>
#include <boost/beast/core/tcp_stream.hpp>
#include <boost/beast/http/parser.hpp>
#include <boost/beast/http/read.hpp>
#include <boost/beast/http/string_body.hpp>
#include <boost/beast/http/write.hpp>
#include <fmt/format.h>

namespace oriel::studio {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
namespace http = beast::http;
using asio::ip::tcp;
using beast::error_code;
using HttpRequest = http::request<http::string_body>;

/// Slow verbs block their threads: so many at the same time leave some for quick ones.
constexpr std::size_t kThreads = 32;
/// Browsers send the cookies of all ports of this machine.
constexpr std::uint32_t kMaxHeadBytes = 64U << 10U;
constexpr std::size_t kMaxTargetBytes = 8U << 10U;

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

/// A header that stands there once; two are as wrong as a wrong one.
std::optional<std::string> header_of(const HttpRequest& request, const char* name) {
  const auto [from, to] = request.equal_range(name);
  if (from == to) return std::nullopt;
  return std::next(from) == to ? from->value().to_string() : std::string();
}

/// Nothing that is served has an escape in its address: none is decoded.
RequestHead head_of(const HttpRequest& request) {
  const std::string target = request.target().to_string();
  const std::size_t end = target.find('?');
  RequestHead head{request.method_string().to_string(),  target.substr(0, end),
                   header_of(request, "Host"),           header_of(request, "Origin"),
                   header_of(request, "Sec-Fetch-Site"), header_of(request, "X-Oriel-Token"),
                   header_of(request, "Content-Type"),   header_of(request, "Content-Length"),
                   request.count("Range") > 0,           request.count("Transfer-Encoding") > 0,
                   request.count("Content-Encoding") > 0};
  constexpr std::string_view kToken = "token=";
  if (head.token || verb_of(head.path) || end == std::string::npos) return head;
  for (std::size_t at = end; at != std::string::npos; at = target.find('&', at + 1))
    if (target.compare(at + 1, kToken.size(), kToken) == 0) {
      const std::size_t value = at + 1 + kToken.size();
      head.token = target.substr(value, target.find('&', value) - value);
      break;
    }
  return head;
}

Reply reply_to_unreadable(error_code fault) {
  if (fault == http::error::header_limit)
    return error_reply(431, "the head of the request is too long");
  // Beside a length, which says the opposite.
  if (fault == http::error::bad_transfer_encoding)
    return error_reply(411, "the request comes in pieces");
  return error_reply(400, fault == http::error::partial_message
                              ? "the request ends too early"
                              : "the request cannot be understood");
}

Reply reply_to_fault(const std::exception& fault) {
  const Issue issue = own_fault(fault);
  log("studio").write(LogLevel::error, fault.what());
  return error_reply(issue.code == Code::E507 ? 503 : 500, issue.sentence, to_string(issue.code));
}

}  // namespace

class HttpServer::Inside {
 public:
  Inside(int listening, ServedAt served, VerbAnswer answer, HttpLimits limits)
      : served_(std::move(served)),
        answer_(std::move(answer)),
        limits_(limits),
        acceptor_(network_, tcp::v4(), ::fcntl(listening, F_DUPFD_CLOEXEC, 0)) {
    accept();
  }

  void run() { network_.run(); }
  void stop() { network_.stop(); }

 private:
  class Connection;

  void accept();
  void close_oldest();

  ServedAt served_;
  VerbAnswer answer_;
  HttpLimits limits_;
  std::size_t open_ = 0;
  std::list<Connection*> waited_for_;  ///< those whose clients are to send or to read
  asio::io_context network_{1};
  tcp::acceptor acceptor_;
  asio::steady_timer pause_{network_};
  asio::thread_pool verbs_{kThreads};
};

/// A connection with its one request: it reads the head, then the body of a verb, then answers, and
/// ends when the client has read that. What it waits for keeps it. All but verbs are in the thread
/// of the network.
class HttpServer::Inside::Connection : public std::enable_shared_from_this<Connection> {
 public:
  Connection(Inside& server, tcp::socket socket) : server_(server), stream_(std::move(socket)) {
    ++server_.open_;
    wait_for_client();
  }
  ~Connection() {
    --server_.open_;
    stop_waiting();
  }
  Connection(const Connection&) = delete;
  Connection& operator=(const Connection&) = delete;

  void begin() {
    parser_.header_limit(kMaxHeadBytes);
    parser_.body_limit(std::numeric_limits<std::uint64_t>::max());  // refusal_of() bounds it
    stream_.expires_after(server_.limits_.head);
    http::async_read_header(
        stream_, buffer_, parser_,
        [self = shared_from_this()](error_code fault, std::size_t) { self->take_head(fault); });
  }

  void close() {
    stop_waiting();
    stream_.close();
  }

 private:
  void wait_for_client() { place_ = server_.waited_for_.insert(server_.waited_for_.end(), this); }

  void stop_waiting() {
    if (place_) server_.waited_for_.erase(*std::exchange(place_, std::nullopt));
  }

  void take_head(error_code fault) {
    head_ = head_of(parser_.get());
    if (fault) return refuse_unreadable(fault);
    if (parser_.get().target().size() > kMaxTargetBytes)
      return send(error_reply(414, "the address is too long"));
    if (auto refusal = refusal_of(head_, server_.served_)) return send(std::move(*refusal));
    if (!verb_of(head_.path)) return send_file(file_of(head_.path));
    stream_.expires_after(server_.limits_.body);
    http::async_read(stream_, buffer_, parser_,
                     [self = shared_from_this()](error_code problem, std::size_t) {
                       problem ? self->refuse_unreadable(problem) : self->ask();
                     });
  }

  /// To a client that is gone, too late or closed for another nothing is said.
  void refuse_unreadable(error_code fault) {
    const error_code none = http::error::end_of_stream;
    if (fault.category() == none.category() && fault != none) send(reply_to_unreadable(fault));
  }

  void ask() {
    stop_waiting();
    asio::post(server_.verbs_, [self = shared_from_this()]() mutable {
      Reply reply;
      try {
        reply = self->server_.answer_(*verb_of(self->head_.path), self->parser_.get().body());
      } catch (const std::exception& fault) {
        reply = reply_to_fault(fault);
      }
      asio::io_context& network = self->server_.network_;
      asio::post(network, [self = std::move(self), reply = std::move(reply)]() mutable {
        self->wait_for_client();
        self->send(std::move(reply));
      });
    });
  }

  void send(Reply reply) {
    if (reply.status >= 400 && reply.status != 409)  // the path only: the rest may have the token
      log("studio").write(LogLevel::warning,
                          fmt::format("refused: method={} path={} status={}", head_.method,
                                      head_.path.substr(0, 200), reply.status));
    const bool is_json = reply.bytes.empty();
    if (reply.status == 405)
      response_.set(http::field::allow, verb_of(head_.path) ? "POST" : "GET, HEAD");
    send(reply.status, std::move(is_json ? reply.json : reply.bytes),
         is_json ? "application/json; charset=utf-8" : "application/octet-stream");
  }

  void send_file(std::string_view file) {
    std::string text(page_file(file));
    if (file == "page.html")
      text =
          with_all(text.empty() ? std::string(kMissingPage) : std::move(text), "@NONCE@", nonce_);
    if (text.empty())
      return send(error_reply(404, "this program was built without that part of the page"));
    send(200, std::move(text), type_of(file));
  }

  void send(int status, std::string text, const char* type) {
    response_.result(static_cast<unsigned>(status));
    response_.keep_alive(false);
    response_.set(http::field::content_type, type);
    response_.set("Content-Security-Policy", policy(nonce_));
    response_.set("Cache-Control", "no-store");
    response_.set("Referrer-Policy", "no-referrer");
    response_.set("X-Content-Type-Options", "nosniff");
    response_.set("Cross-Origin-Resource-Policy", "same-origin");
    response_.set("Cross-Origin-Opener-Policy", "same-origin");
    response_.content_length(text.size());
    if (head_.method != "HEAD") response_.body() = std::move(text);
    stream_.expires_after(server_.limits_.answer);
    http::async_write(stream_, response_,
                      [self = shared_from_this()](error_code fault, std::size_t) {
                        if (!fault) self->end();
                      });
  }

  /// A connection that is closed with bytes unread may lose its answer.
  void end() {
    error_code ignored;
    stream_.socket().shutdown(tcp::socket::shutdown_send, ignored);
    stream_.expires_after(server_.limits_.rest);
    read_away();
  }

  void read_away() {
    buffer_.clear();
    stream_.async_read_some(buffer_.prepare(kMaxHeadBytes),
                            [self = shared_from_this()](error_code fault, std::size_t) {
                              if (!fault) self->read_away();
                            });
  }

  Inside& server_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  http::request_parser<http::string_body> parser_;
  http::response<http::string_body> response_;
  RequestHead head_;
  std::string nonce_ = random_token();
  std::optional<std::list<Connection*>::iterator> place_;  ///< in waited_for_
};

void HttpServer::Inside::accept() {
  acceptor_.async_accept([this](error_code fault, tcp::socket socket) {
    if (!fault) std::make_shared<Connection>(*this, std::move(socket))->begin();
    if (fault || open_ > limits_.connections) close_oldest();
    if (!fault) return accept();
    // The process or the system has no descriptor left.
    pause_.expires_after(std::chrono::milliseconds(10));
    pause_.async_wait([this](error_code) { accept(); });
  });
}

void HttpServer::Inside::close_oldest() {
  if (!waited_for_.empty()) waited_for_.front()->close();
}

HttpServer::HttpServer(int listening, ServedAt served, VerbAnswer answer, HttpLimits limits)
    : inside_(std::make_unique<Inside>(listening, std::move(served), std::move(answer), limits)) {}

HttpServer::~HttpServer() = default;

void HttpServer::run() { inside_->run(); }

void HttpServer::stop() { inside_->stop(); }

}  // namespace oriel::studio
