#include "tests/cli/command.h"
#include "tests/studio/lsp/lsp_client.h"

#include <string>
#include <vector>

using namespace oriel::test;

namespace {

/// The bodies in the bytes that a server has written.
std::vector<Json> bodies_in(const std::string& bytes) {
  std::vector<Json> bodies;
  for (std::size_t at = 0; at < bytes.size();) {
    const std::string begin = "Content-Length: ";
    REQUIRE(bytes.compare(at, begin.size(), begin) == 0);
    const std::size_t end = bytes.find("\r\n\r\n", at);
    REQUIRE(end != std::string::npos);
    const std::size_t length = std::stoul(bytes.substr(at + begin.size()));
    bodies.push_back(Json::parse(bytes.substr(end + 4, length)));
    at = end + 4 + length;
  }
  return bodies;
}

}  // namespace

TEST_SUITE("studio/lsp") {
  TEST_CASE("the command answers a session of bytes and ends as the protocol says") {
    const std::string session =
        framed(R"({"jsonrpc":"2.0","id":1,"method":"initialize","params":{"capabilities":{}}})") +
        framed(R"({"jsonrpc":"2.0","method":"initialized","params":{}})") +
        framed(
            R"({"jsonrpc":"2.0","method":"textDocument/didOpen","params":{"textDocument":{"uri":"file:///a.yaml","languageId":"yaml","version":1,"text":"schema: oriel/1\npack: {name: a, version: 1.0.0}\nextends: residential\nrules:\n  - {id: a.b, label: dormr, require: [width > $parapet]}\n"}}})") +
        framed(
            R"({"jsonrpc":"2.0","id":2,"method":"textDocument/completion","params":{"textDocument":{"uri":"file:///a.yaml"},"position":{"line":4,"character":48}}})") +
        framed(
            R"({"jsonrpc":"2.0","id":3,"method":"textDocument/hover","params":{"textDocument":{"uri":"file:///a.yaml"},"position":{"line":4,"character":40}}})") +
        framed(R"({"jsonrpc":"2.0","id":4,"method":"shutdown"})") +
        framed(R"({"jsonrpc":"2.0","method":"exit"})");
    const Outcome ended = run({"rules", "lsp", "--stdio"}, {.in = session});
    CHECK(ended.exit == 0);
    CHECK(ended.err.empty());
    const auto bodies = bodies_in(ended.out);
    REQUIRE(bodies.size() == 5);
    CHECK(bodies[0]["result"]["serverInfo"]["name"] == "oriel");
    const Json& finding = bodies[1]["params"]["diagnostics"][0];
    CHECK(finding["code"] == "R205");
    CHECK(finding["message"] == "unknown class 'dormr'; did you mean 'dormer'?");
    CHECK(finding["range"]["start"] == Json{{"line", 4}, {"character", 21}});
    CHECK(finding["range"]["end"] == Json{{"line", 4}, {"character", 26}});
    CHECK(bodies[2]["result"]["items"].size() > 20);
    CHECK(bodies[3]["result"]["contents"]["value"].get<std::string>().starts_with(
        "width: attribute"));
    CHECK(bodies[4] == Json{{"jsonrpc", "2.0"}, {"id", 4}, {"result", nullptr}});
  }

  TEST_CASE("the command ends with 1 where the protocol is not kept to the end") {
    CHECK(run({"rules", "lsp"}, {.in = ""}).exit == 1);
    CHECK(run({"rules", "lsp"}, {.in = framed(R"({"jsonrpc":"2.0","method":"exit"})")}).exit == 1);
    CHECK(run({"rules", "lsp"}, {.in = "Content-Length: 70\r\n\r\n{"}).exit == 1);
    CHECK(run({"rules", "lsp", "pack.yaml"}).exit == 2);
  }
}
