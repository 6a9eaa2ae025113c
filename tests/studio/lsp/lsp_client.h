#pragma once

#include "studio/editing/edited_pack.h"
#include "studio/lsp/language_server.h"
#include "studio/lsp/message_stream.h"

#include <array>
#include <chrono>
#include <deque>
#include <string>
#include <thread>
#include <unistd.h>
#include <utility>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace oriel::test {

using Json = nlohmann::json;

/// A header and a body as the protocol has them.
inline std::string framed(const std::string& body) {
  return "Content-Length: " + std::to_string(body.size()) + "\r\n\r\n" + body;
}

/// A client of a server that runs in a thread, on pipes.
class LspClient {
 public:
  explicit LspClient(studio::LanguageServerOptions options = {"0", "https://docs", ""})
      : options_(std::move(options)) {
    REQUIRE(::pipe(to_server_.data()) == 0);
    REQUIRE(::pipe(from_server_.data()) == 0);
    stream_ = studio::MessageStream(from_server_[0], to_server_[1]);
    server_ = std::thread([this] {
      exit_code_ = studio::serve_language(to_server_[0], from_server_[1], options_);
      ::close(from_server_[1]);
    });
  }
  ~LspClient() { end(); }
  LspClient(const LspClient&) = delete;
  LspClient& operator=(const LspClient&) = delete;

  /// Closes the pipe, and gives what the server ended with.
  int end() {
    if (!server_.joinable()) return exit_code_;
    ::close(to_server_[1]);
    server_.join();
    for (const int file : {to_server_[0], from_server_[0]}) ::close(file);
    return exit_code_;
  }

  void send_bytes(const std::string& bytes) {
    REQUIRE(::write(to_server_[1], bytes.data(), bytes.size()) ==
            static_cast<ssize_t>(bytes.size()));
  }
  void notify(const std::string& method, const Json& params) {
    send_bytes(framed(Json{{"jsonrpc", "2.0"}, {"method", method}, {"params", params}}.dump()));
  }

  /// The answer to a request, `result` or `error` in it; what comes before waits for heard().
  Json request(const std::string& method, const Json& params = Json::object()) {
    const int id = ++requests_;
    send_bytes(framed(
        Json{{"jsonrpc", "2.0"}, {"id", id}, {"method", method}, {"params", params}}.dump()));
    while (true) {
      Json message = next_from_server();
      if (message.contains("id") && message["id"] == id) return message;
      notifications_.push_back(std::move(message));
    }
  }
  Json result(const std::string& method, const Json& params = Json::object()) {
    const Json answer = request(method, params);
    CAPTURE(answer.dump());
    REQUIRE(answer.contains("result"));
    return answer["result"];
  }

  /// The next message that is no answer.
  Json heard() {
    if (notifications_.empty()) return next_from_server();
    Json first = notifications_.front();
    notifications_.pop_front();
    return first;
  }

  void start() {
    (void)result("initialize",
                 {{"capabilities",
                   {{"textDocument",
                     {{"documentSymbol", {{"hierarchicalDocumentSymbolSupport", true}}},
                      {"publishDiagnostics", {{"codeDescriptionSupport", true}}}}}}}});
    notify("initialized", Json::object());
  }
  /// The findings of a document that is opened.
  Json open(const std::string& uri, const std::string& text) {
    notify(
        "textDocument/didOpen",
        {{"textDocument", {{"uri", uri}, {"languageId", "yaml"}, {"version", 1}, {"text", text}}}});
    const Json published = heard();
    REQUIRE(published["method"] == "textDocument/publishDiagnostics");
    CHECK(published["params"]["uri"] == uri);
    return published["params"]["diagnostics"];
  }

 private:
  Json next_from_server() {
    const auto read = stream_.read(std::chrono::seconds(20));
    REQUIRE(read.outcome == studio::MessageStream::ReadOutcome::message);
    return Json::parse(read.body);
  }

  studio::LanguageServerOptions options_;
  std::array<int, 2> to_server_{};
  std::array<int, 2> from_server_{};
  studio::MessageStream stream_{-1, -1};
  std::thread server_;
  int exit_code_ = -1;
  int requests_ = 0;
  std::deque<Json> notifications_;
};

inline Json at(const std::string& uri, int line, int character) {
  return {{"textDocument", {{"uri", uri}}},
          {"position", {{"line", line}, {"character", character}}}};
}

/// The text after the edits of a document, each of one line or over lines.
inline std::string edited(const std::string& text, const Json& edits) {
  const TextPlaces places(text);
  std::vector<TextEdit> changes;
  const auto offset = [&](const Json& position) {
    return places.offset({position["line"].get<int>() + 1, position["character"].get<int>() + 1});
  };
  for (const Json& edit : edits)
    changes.push_back({{offset(edit["range"]["start"]), offset(edit["range"]["end"])},
                       edit["newText"].get<std::string>()});
  return with_edits(text, changes);
}

}  // namespace oriel::test
