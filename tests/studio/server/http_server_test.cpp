#include "studio/server/http_server.h"

#include "studio/server/listening_socket.h"
#include "studio/server/page_files.h"
#include "tests/studio/server/raw_request.h"

#include <atomic>
#include <chrono>
#include <mutex>
#include <new>
#include <regex>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

using namespace oriel::studio;
using oriel::test::answer_to;
using oriel::test::body_in;
using oriel::test::RawClient;
using oriel::test::status_in;

namespace {

const std::string kToken = "0123456789abcdef0123456789abcdef";
/// More than the system keeps for a client that does not read.
constexpr std::size_t kLongAnswer = 64U << 20U;

/// A server with a session that repeats what it was asked, on a port that the system chooses.
class TestServer {
 public:
  explicit TestServer(HttpLimits limits = {})
      : server_(
            socket_.descriptor(), {socket_.port(), kToken},
            [this](auto verb, auto body) { return answer(verb, body); }, limits),
        thread_([this] { server_.run(); }) {
    // The accepting thread is there once something is answered, and can be stopped then.
    CHECK(status_in(ask("GET", "/", "", "")) == 403);
  }
  ~TestServer() {
    server_.stop();
    thread_.join();
  }

  [[nodiscard]] int port() const { return socket_.port(); }
  [[nodiscard]] int asked() const { return asked_; }

  /// The answer to a request with more headers: lines that end in \r\n.
  [[nodiscard]] std::string ask(const std::string& method, const std::string& target,
                                const std::string& headers, const std::string& body) const {
    return answer_to(port(), fmt::format("{} {} HTTP/1.1\r\nHost: 127.0.0.1:{}\r\n{}\r\n{}", method,
                                         target, port(), headers, body));
  }

  /// A request as the page makes it.
  [[nodiscard]] std::string post(const std::string& verb, const std::string& body,
                                 const std::string& more = {}) const {
    return ask("POST", "/api/" + verb,
               fmt::format("X-Oriel-Token: {}\r\nContent-Type: application/json\r\n"
                           "Content-Length: {}\r\n{}",
                           kToken, body.size(), more),
               body);
  }

 private:
  Reply answer(std::string_view verb, std::string_view body) {
    ++asked_;
    if (verb == "memory") throw std::bad_alloc();
    if (verb == "fault") throw std::runtime_error("<b>a fault</b>");
    if (verb == "long") return {200, std::string(kLongAnswer, 'a')};
    if (verb == "slow") std::this_thread::sleep_for(std::chrono::milliseconds(100));
    const nlohmann::ordered_json json{{"verb", verb}, {"body", body}};
    return {200, json.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace)};
  }

  std::atomic<int> asked_ = 0;
  ListeningSocket socket_{0};
  HttpServer server_;
  std::thread thread_;
};

std::string policy_in(const std::string& answer) {
  static const std::regex line("\r\nContent-Security-Policy: ([^\r]*)\r\n");
  std::smatch match;
  return std::regex_search(answer, match, line) ? match[1].str() : std::string();
}

}  // namespace

TEST_SUITE("studio/server") {
  TEST_CASE("a verb comes to the session and its answer goes to the page") {
    const TestServer server;
    const std::string answer = server.post("state", R"({"a":"é"})");
    CHECK(status_in(answer) == 200);
    const auto json = nlohmann::json::parse(body_in(answer));
    CHECK(json["verb"] == "state");
    CHECK(json["body"] == R"({"a":"é"})");
    CHECK(status_in(server.post("__proto__", "{}")) == 200);
    CHECK(server.asked() == 2);
  }

  TEST_CASE("what is refused does not come to the session") {
    const TestServer server;
    const std::string json = "Content-Type: application/json\r\nContent-Length: 2\r\n",
                      good = "X-Oriel-Token: " + kToken + "\r\n" + json;
    CHECK(status_in(server.ask("POST", "/api/state", json, "{}")) == 403);
    CHECK(status_in(server.ask("POST", "/api/state?token=" + kToken, json, "{}")) == 403);
    CHECK(status_in(server.ask("POST", "/api/state", good + "X-Oriel-Token: 0\r\n", "{}")) == 403);
    CHECK(status_in(server.ask("POST", "/api/state", good + "Host: localhost:1\r\n", "{}")) == 403);
    CHECK(status_in(server.post("state", "{}", "Origin: http://evil.example\r\n")) == 403);
    CHECK(status_in(server.post("state", "{}", "Sec-Fetch-Site: cross-site\r\n")) == 403);
    CHECK(status_in(server.ask("GET", "/api/state", good, "{}")) == 405);
    CHECK(server.ask("GET", "/api/state", good, "{}").find("\r\nAllow: POST\r\n") !=
          std::string::npos);
    CHECK(status_in(server.ask("OPTIONS", "/api/state", good, "")) == 405);
    CHECK(status_in(server.post("../state", "{}")) == 404);
    CHECK(status_in(server.post("%2e%2e/state", "{}")) == 404);
    CHECK(status_in(server.post("state", "{}", "Transfer-Encoding: chunked\r\n")) == 411);
    CHECK(status_in(server.post("state", "{}", "Content-Encoding: gzip\r\n")) == 415);
    CHECK(status_in(server.post("state", "{}", "Range: bytes=0-1,0-1\r\n")) == 400);
    CHECK(server.asked() == 0);
  }

  TEST_CASE("files outside of the page are not there") {
    const TestServer server;
    for (const char* path : {"/../../../../etc/passwd", "/%2e%2e/%2e%2e/etc/passwd", "/etc/passwd",
                             "//etc/passwd", "/..%2fetc%2fpasswd", "/page.html%00.js"}) {
      CAPTURE(path);
      const std::string answer = server.ask("GET", path + ("?token=" + kToken), "", "");
      CHECK(status_in(answer) == 404);
      CHECK(answer.find("root:") == std::string::npos);
    }
  }

  TEST_CASE("a body that is too long is read away and refused") {
    const TestServer server;
    CHECK(status_in(server.post("state", std::string(kMostBodyBytes + 1, 'a'))) == 413);
    CHECK(server.asked() == 0);
  }

  TEST_CASE("what is no request of HTTP gets a status and the server goes on") {
    const TestServer server;
    CHECK(status_in(answer_to(server.port(), "\r\n\r\n")) == 400);
    CHECK(status_in(answer_to(server.port(), "GARBAGE\r\n\r\n")) == 400);
    CHECK(status_in(answer_to(server.port(), "GET / HTTP/9.9\r\n\r\n")) == 400);
    CHECK(status_in(server.ask("GET", "/" + std::string(9000, 'a'), "", "")) == 414);
    CHECK(status_in(server.ask("GET", "/" + std::string(8000, '('), "", "")) == 404);
    CHECK(answer_to(server.port(), "GET / HT", true).find("token") == std::string::npos);
    const std::string half =
        "POST /api/state HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(server.port()) +
        "\r\nX-Oriel-Token: " + kToken +
        "\r\nContent-Type: application/json\r\nContent-Length: 20\r\n\r\n{";
    CHECK(status_in(answer_to(server.port(), half, true)) != 200);
    CHECK(server.asked() == 0);
    CHECK(status_in(server.post("state", "{}")) == 200);
  }

  TEST_CASE("a body that was refused unread is not taken for a request") {
    const TestServer server;
    const std::string inner =
        "POST /api/state HTTP/1.1\r\nHost: 127.0.0.1:" + std::to_string(server.port()) +
        "\r\nX-Oriel-Token: " + kToken +
        "\r\nContent-Type: application/json\r\nContent-Length: 2\r\n\r\n{}";
    const std::string answer =
        server.ask("POST", "/api/state", "Content-Type: text/plain\r\n", inner);
    CHECK(status_in(answer) == 403);
    CHECK(answer.find("HTTP/1.1", 1) == std::string::npos);
    CHECK(server.asked() == 0);
  }

  TEST_CASE("every answer says what the page may load and that nobody keeps it") {
    const TestServer server;
    for (const std::string& answer :
         {server.ask("GET", "/?token=" + kToken, "", ""), server.ask("GET", "/", "", ""),
          server.ask("GET", "/nothing", "", ""), server.post("state", "{}")}) {
      CHECK(policy_in(answer).starts_with("default-src 'none'; script-src 'self'"));
      CHECK(policy_in(answer).find("unsafe") == std::string::npos);
      for (const char* line :
           {"\r\nCache-Control: no-store\r\n", "\r\nX-Content-Type-Options: nosniff\r\n",
            "\r\nReferrer-Policy: no-referrer\r\n", "\r\nConnection: close\r\n"})
        CHECK(answer.find(line) != std::string::npos);
    }
  }

  TEST_CASE("the page has the nonce of its policy and another one each time") {
    const TestServer server;
    std::set<std::string> policies;
    for (int i = 0; i < 3; ++i) {
      const std::string answer = server.ask("GET", "/?token=" + kToken, "", "");
      CHECK(status_in(answer) == 200);
      CHECK(body_in(answer).starts_with("<!doctype html>"));
      CHECK(body_in(answer).find("@NONCE@") == std::string::npos);
      policies.insert(policy_in(answer));
    }
    CHECK(policies.size() == 3);
  }

  TEST_CASE("scripts and styles come as they were built in and are not compressed") {
    const TestServer server;
    for (const char* file : {"studio.js", "studio.css", "licences.txt"}) {
      const std::string answer =
          server.ask("GET", std::string("/") + file, "Accept-Encoding: br, gzip\r\n", "");
      const std::string_view text = page_file(file);
      CHECK(status_in(answer) == (text.empty() ? 404 : 200));
      if (!text.empty()) CHECK((body_in(answer) == text));
    }
    CHECK(status_in(server.ask("HEAD", "/?token=" + kToken, "", "")) == 200);
    CHECK(body_in(server.ask("HEAD", "/?token=" + kToken, "", "")).empty());
    CHECK(server.post("state", "{}", "Accept-Encoding: br, gzip\r\n").find("Content-Encoding") ==
          std::string::npos);
  }

  TEST_CASE("an exception of a verb is an answer and the server goes on") {
    const TestServer server;
    const std::string memory = server.post("memory", "{}"), fault = server.post("fault", "{}");
    CHECK(status_in(memory) == 503);
    CHECK(nlohmann::json::parse(body_in(memory))["code"] == "E507");
    CHECK(status_in(fault) == 500);
    CHECK(nlohmann::json::parse(body_in(fault))["code"] == "E901");
    CHECK(fault.find("EXCEPTION_WHAT") == std::string::npos);
    CHECK(status_in(server.post("state", "{}")) == 200);
  }

  TEST_CASE("slow verbs do not wait for each other") {
    const TestServer server;
    const auto begin = std::chrono::steady_clock::now();
    std::atomic<int> good = 0;
    {
      std::vector<std::thread> pages;
      for (int i = 0; i < 16; ++i)
        pages.emplace_back([&] { good += status_in(server.post("slow", "{}")) == 200 ? 1 : 0; });
      for (std::thread& page : pages) page.join();
    }
    CHECK(good == 16);
    CHECK(std::chrono::steady_clock::now() - begin < std::chrono::milliseconds(1200));
  }

  TEST_CASE("a client that sends its head or its body too slowly is closed") {
    const auto limit = std::chrono::milliseconds(150);
    const TestServer server({.head = limit, .body = limit});
    const std::string body = fmt::format(
        "POST /api/state HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nX-Oriel-Token: {}\r\n"
        "Content-Type: application/json\r\nContent-Length: 1000\r\n\r\n",
        server.port(), kToken);
    // The last one sends nothing at all.
    for (const std::string& begin : {std::string("GET /"), body, std::string()}) {
      CAPTURE(begin);
      RawClient client(server.port());
      client.send(begin);
      std::atomic<bool> is_closed = false;
      std::thread dripping([&] {
        while (!is_closed && !begin.empty()) {
          client.send("a");
          std::this_thread::sleep_for(std::chrono::milliseconds(20));
        }
      });
      const auto from = std::chrono::steady_clock::now();
      CHECK(client.read().empty());
      const auto time = std::chrono::steady_clock::now() - from;
      is_closed = true;
      dripping.join();
      CHECK(time > limit / 2);
      CHECK(time < std::chrono::seconds(2));
    }
    CHECK(server.asked() == 0);
  }

  TEST_CASE("a client that does not read its answer or goes on sending is closed") {
    const auto limit = std::chrono::milliseconds(60);
    const TestServer server({.answer = limit, .rest = limit});
    RawClient sending(server.port());
    sending.send("GARBAGE\r\n\r\n");
    CHECK(status_in(sending.read()) == 400);
    std::this_thread::sleep_for(3 * limit);
    sending.send("a");
    sending.send("a");
    CHECK(sending.is_refused());
    RawClient deaf(server.port());
    deaf.send(
        fmt::format("POST /api/long HTTP/1.1\r\nHost: 127.0.0.1:{}\r\nX-Oriel-Token: {}\r\n"
                    "Content-Type: application/json\r\nContent-Length: 0\r\n\r\n",
                    server.port(), kToken));
    while (server.asked() == 0) std::this_thread::yield();
    std::this_thread::sleep_for(10 * limit);
    CHECK(deaf.read().size() < kLongAnswer);
  }

  TEST_CASE("a head that is too long is refused") {
    const TestServer server;
    CHECK(status_in(server.ask("GET", "/", "X-A: " + std::string(60000, 'a') + "\r\n", "")) == 403);
    CHECK(status_in(server.ask("GET", "/", "X-A: " + std::string(1U << 20U, 'a'), "")) == 431);
  }

  TEST_CASE("one connection more than there may be closes the oldest that is waited for") {
    const TestServer server({.connections = 4});
    std::string slow;
    std::thread page([&] { slow = server.post("slow", "{}"); });
    while (server.asked() == 0) std::this_thread::yield();
    std::vector<RawClient> clients;
    for (int i = 0; i < 9; ++i) clients.emplace_back(server.port()).send("GET / HTTP/1.1\r\n");
    CHECK(clients[0].read().empty());
    clients[8].send("\r\n");
    CHECK(status_in(clients[8].read()) == 403);
    page.join();
    CHECK(status_in(slow) == 200);
  }

  TEST_CASE("a port that is taken is not shared") {
    const ListeningSocket first(0);
    CHECK(first.port() > 0);
    CHECK_THROWS_AS(ListeningSocket(first.port()), std::system_error);
  }
}
