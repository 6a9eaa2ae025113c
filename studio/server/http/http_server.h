#pragma once

#include "studio/server/request_check.h"
#include "studio/session/session.h"

#include <functional>
#include <memory>
#include <string_view>

namespace oriel::studio {

/// Answers a verb; called from many threads.
using VerbAnswer = std::function<Reply(std::string_view verb, std::string_view body)>;

/// The studio's HTTP, on a socket that listens already: the files of the page, and
/// `POST /api/VERB`. Answers carry a Content-Security-Policy that lets the page load nothing from
/// elsewhere, and are kept by no cache. What is refused (refusal_of) or fails is a line on level
/// warning of the log "studio". A connection carries one request.
///
/// cpp-httplib loads libraries that take time whenever a program starts, so it stands in a module
/// that is loaded here.
class HttpServer {
 public:
  /// Throws InputError E101 if the module is missing, or of another version of oriel.
  static void load_module();

  /// Loads the module, too.
  HttpServer(int listening, ServedAt served, VerbAnswer answer);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// Serves until stop() is called from another thread, or the socket fails.
  void run();
  void stop();

 private:
  class Inside;
  std::unique_ptr<Inside> inside_;
};

}  // namespace oriel::studio
