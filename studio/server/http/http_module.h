#pragma once

#include "studio/server/request_check.h"
#include "studio/session/session.h"

#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace oriel::studio {

/// What is answered to a request before its body is read.
struct AnswerPlan {
  /// The Content-Security-Policy of the answer, whatever that is.
  std::string policy;
  /// Why it is refused. Of a verb the body is read first.
  std::optional<Reply> refusal;
  /// With status 405: the methods that there are.
  std::string allowed;
  bool is_verb = false;
  /// Of a file that is given: its type and its text.
  std::string type;
  std::shared_ptr<const std::string> text;
};

/// What the HTTP module asks of the program that loaded it; it calls nothing else of oriel. Called
/// from many threads.
class HttpSite {
 public:
  HttpSite() = default;
  HttpSite(const HttpSite&) = delete;
  HttpSite& operator=(const HttpSite&) = delete;
  virtual ~HttpSite() = default;

  /// True if the path is that of a verb.
  [[nodiscard]] virtual bool is_verb(std::string_view path) const = 0;
  [[nodiscard]] virtual AnswerPlan plan(const RequestHead& head) const = 0;
  /// The answer to a verb that may be asked.
  [[nodiscard]] virtual Reply answer(std::string_view path, std::string_view body) const = 0;
  /// What is said where the server itself refuses a request.
  [[nodiscard]] virtual Reply error(int status, std::string_view sentence) const = 0;
  /// What is said where an answer failed.
  [[nodiscard]] virtual Reply fault(const std::exception_ptr& fault) const = 0;
  /// A line of the log.
  virtual void log_refusal(std::string_view method, std::string_view path, int status) const = 0;
};

/// The server of the module.
class HttpPart {
 public:
  HttpPart() = default;
  HttpPart(const HttpPart&) = delete;
  HttpPart& operator=(const HttpPart&) = delete;
  virtual ~HttpPart() = default;

  virtual void run() = 0;
  virtual void stop() = 0;
};

/// What the module exports: `oriel_open_http`, a server on a socket that listens already, of a site
/// that must outlive it; and `oriel_http_version`, a text: the version of oriel that it is part of.
using OpenHttp = HttpPart* (*)(int listening, const HttpSite& site);

}  // namespace oriel::studio
