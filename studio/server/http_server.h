#pragma once

#include "studio/server/request_check.h"
#include "studio/session/session.h"

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <string_view>

namespace oriel::studio {

/// Answers a verb; called from many threads.
using VerbAnswer = std::function<Reply(std::string_view verb, std::string_view body)>;

/// Bounds on what clients take up. Each time is a total: a byte now and then does not prolong it.
struct HttpLimits {
  /// From the connection to the end of the request's head; idle connections have no longer.
  std::chrono::milliseconds head{5000};
  std::chrono::milliseconds body{10000};
  std::chrono::milliseconds answer{60000};
  /// For what a client still sends after its answer.
  std::chrono::milliseconds rest{2000};
  /// One connection more closes the oldest whose client is waited for.
  std::size_t connections = 256;
};

/// The studio's HTTP, on a socket that listens already: the files of the page, and
/// `POST /api/VERB`. Answers carry a Content-Security-Policy that lets the page load nothing from
/// elsewhere, and are kept by no cache. What is refused (refusal_of) or fails is a line on level
/// warning of the log "studio". A connection carries one request. The thread of run() waits for all
/// clients; verbs have threads of their own, so that neither waits for the other.
class HttpServer {
 public:
  HttpServer(int listening, ServedAt served, VerbAnswer answer, HttpLimits limits = {});
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// Serves until stop() is called from another thread.
  void run();
  void stop();

 private:
  class Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace oriel::studio
