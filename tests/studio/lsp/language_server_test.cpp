#include "tests/studio/lsp/lsp_client.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

using namespace oriel;
using namespace oriel::test;

namespace {

const std::string kUri = "file:///nowhere/town%20hall.yaml";
const std::string kText =
    "schema: oriel/1\n"
    "pack: {name: town, version: 1.0.0}\n"
    "params:\n"
    "  sill: {value: 0.9 m, range: 0.6 m .. 1.1 m, why: \xF0\x9F\x8F\xA0 as high as a table}\n"
    "classes:\n"
    "  window:   {}\n"
    "rules:\n"
    "  - id: window.high\n"
    "    label: window\n"
    "    require: [sense = hole and base_height >= $sill]\n"
    "emit:\n"
    "  window: {type: Window}\n";

bool has_label(const Json& items, const std::string& label) {
  return std::ranges::any_of(items, [&](const Json& item) { return item["label"] == label; });
}

Json change_of(int version, const Json& changes) {
  return {{"textDocument", {{"uri", kUri}, {"version", version}}}, {"contentChanges", changes}};
}

Json change_at(int line, int from, int to, const std::string& text) {
  return {{"range",
           {{"start", {{"line", line}, {"character", from}}},
            {"end", {{"line", line}, {"character", to}}}}},
          {"text", text}};
}

std::string replaced_blanks(std::string path) {
  for (std::size_t at = path.find(' '); at != std::string::npos; at = path.find(' '))
    path.replace(at, 1, "%20");
  return path;
}

int error_code(const Json& answer) {
  CAPTURE(answer.dump());
  REQUIRE(answer.contains("error"));
  CHECK_FALSE(answer["error"]["message"].get<std::string>().empty());
  return answer["error"]["code"].get<int>();
}

}  // namespace

TEST_SUITE("studio/lsp") {
  TEST_CASE("a whole session is answered") {
    LspClient client;
    client.start();
    CHECK(client.open(kUri, kText).empty());

    const Json hover = client.result("textDocument/hover", at(kUri, 9, 48));
    CHECK(hover["contents"]["value"].get<std::string>().starts_with("sill: param, 0.9 m"));
    CHECK(hover["range"]["start"]["character"] == 47);
    const Json definition = client.result("textDocument/definition", at(kUri, 8, 13));
    CHECK(definition["uri"] == kUri);
    CHECK(definition["range"]["start"]["line"] == 5);
    const Json completion = client.result("textDocument/completion", at(kUri, 9, 33));
    CHECK(completion["isIncomplete"] == false);
    CHECK(has_label(completion["items"], "base_height"));
    CHECK(client.result("textDocument/prepareRename", at(kUri, 9, 48))["placeholder"] == "sill");
    Json rename = at(kUri, 9, 48);
    rename["newName"] = "parapet";
    const Json changes = client.result("textDocument/rename", rename)["changes"][kUri];
    const std::string renamed = edited(kText, changes);
    CHECK(renamed.find("  parapet: {value") != std::string::npos);
    CHECK(renamed.find("$parapet]") != std::string::npos);
    const Json formatted = client.result("textDocument/formatting",
                                         {{"textDocument", {{"uri", kUri}}}, {"options", Json()}});
    CHECK(edited(kText, formatted) == EditedPack(kText, "town.yaml").format().value);
    const Json symbols =
        client.result("textDocument/documentSymbol", {{"textDocument", {{"uri", kUri}}}});
    CHECK(symbols[0]["name"] == "pack");
    CHECK(std::ranges::any_of(symbols, [](const Json& symbol) {
      return symbol["name"] == "rules" && symbol["children"][0]["name"] == "window.high";
    }));
    CHECK(client.result("shutdown").is_null());
    client.notify("exit", Json());
    CHECK(client.end() == 0);
  }

  TEST_CASE("findings come with code and link and a fix") {
    LspClient client;
    client.start();
    std::string text = kText;
    text.replace(text.find("base_height"), 11, "base_hight");
    const Json findings = client.open(kUri, text);
    REQUIRE(findings.size() == 1);
    CHECK(findings[0]["code"] == "R204");
    CHECK(findings[0]["severity"] == 1);
    CHECK(findings[0]["codeDescription"]["href"] == "https://docs/rules.md#r204-unknown-attribute");
    CHECK(findings[0]["range"]["end"]["character"].get<int>() -
              findings[0]["range"]["start"]["character"].get<int>() ==
          10);
    const Json actions =
        client.result("textDocument/codeAction", {{"textDocument", {{"uri", kUri}}},
                                                  {"range", findings[0]["range"]},
                                                  {"context", {{"diagnostics", findings}}}});
    REQUIRE(actions.size() == 1);
    CHECK(actions[0]["kind"] == "quickfix");
    CHECK(edited(text, actions[0]["edit"]["changes"][kUri]) == kText);
  }

  TEST_CASE("changes are taken up in order and only the newest text has its findings told") {
    LspClient client;
    client.start();
    client.open(kUri, kText);
    // The house before the place counts two units of UTF-16, and four bytes.
    client.notify(
        "textDocument/didChange",
        change_of(2, Json::array({change_at(3, 54, 56, "so"), change_at(5, 2, 8, "door")})));
    for (int version = 3; version < 12; ++version)
      client.notify("textDocument/didChange",
                    change_of(version, Json::array({change_at(5, 2, 6, "gate")})));
    client.notify("textDocument/didChange",
                  change_of(12, Json::array({change_at(5, 2, 6, "windo")})));
    const Json published = client.heard();
    CHECK(published["params"]["version"] == 12);
    const Json& findings = published["params"]["diagnostics"];
    REQUIRE_FALSE(findings.empty());
    CHECK(findings[0]["message"] == "unknown class 'window'; did you mean 'windo'?");
    const Json hover = client.result("textDocument/hover", at(kUri, 3, 3));
    CHECK(hover["contents"]["value"].get<std::string>().ends_with(
        "\xF0\x9F\x8F\xA0 so high as a table"));
    client.notify("textDocument/didChange", change_of(13, Json::array({{{"text", kText}}})));
    CHECK(client.heard()["params"]["diagnostics"].empty());
    client.notify("textDocument/didClose", {{"textDocument", {{"uri", kUri}}}});
    CHECK(client.heard()["params"]["diagnostics"].empty());
  }

  TEST_CASE("a name of a built-in pack leads into a copy of it") {
    const std::filesystem::path folder =
        std::filesystem::temp_directory_path() / "oriel_language_server_test";
    std::filesystem::remove_all(folder);
    LspClient client({"0", "", (folder / "packs").string()});
    client.start();
    client.open(kUri,
                "schema: oriel/1\npack: {name: a, version: 1.0.0}\nextends: residential\n"
                "emit: {chimney: {type: BuildingInstallation}}\n");
    const Json place = client.result("textDocument/definition", at(kUri, 3, 9));
    CHECK(place["uri"] == "file://" + (folder / "packs/residential.yaml").string());
    std::ifstream file(folder / "packs/residential.yaml");
    std::string line;
    for (int i = 0; i <= place["range"]["start"]["line"].get<int>(); ++i) std::getline(file, line);
    CHECK(line.starts_with("  chimney:"));
    std::filesystem::remove_all(folder);
  }

  TEST_CASE("YAML that is no pack is left alone") {
    LspClient client;
    client.start();
    const std::string uri = "file:///nowhere/compose.yaml";
    CHECK(client.open(uri, "services:\n  web: {image: [}\nvolumes: {}\nnetworks: {}\n").empty());
    CHECK(client.result("textDocument/completion", at(uri, 1, 2)).is_null());
    CHECK_FALSE(client.open(kUri, "").empty());
    CHECK(has_label(client.result("textDocument/completion", at(kUri, 0, 0))["items"], "schema"));
  }

  TEST_CASE("what cannot be answered has the error code of the protocol") {
    LspClient client;
    CHECK(error_code(client.request("textDocument/hover", at(kUri, 0, 0))) == -32002);
    client.start();
    CHECK(error_code(client.request("textDocument/nothing")) == -32601);
    CHECK(error_code(client.request("textDocument/hover", at(kUri, 0, 0))) == -32602);
    CHECK(error_code(client.request("textDocument/hover", {{"textDocument", 7}})) == -32602);
    CHECK(error_code(client.request("initialize")) == -32600);
    client.open(kUri, kText);
    CHECK(error_code(client.request("textDocument/hover", {{"textDocument", {{"uri", kUri}}}})) ==
          -32602);
    Json rename = at(kUri, 9, 48);
    rename["newName"] = "two words";
    CHECK(error_code(client.request("textDocument/rename", rename)) == -32803);
    CHECK(client.result("textDocument/hover", at(kUri, 4000000, 99)).is_null());
    CHECK(client.result("textDocument/prepareRename", at(kUri, 0, 1)).is_null());
    client.notify("textDocument/didChange", {{"textDocument", {{"uri", kUri}}}});
    client.notify("workspace/didChangeConfiguration", Json::array());
    client.notify("$/cancelRequest", {{"id", 1}});
    CHECK(client.result("shutdown").is_null());
    CHECK(error_code(client.request("textDocument/hover", at(kUri, 0, 0))) == -32600);
  }

  TEST_CASE("what is no message is answered and the next one is taken") {
    LspClient client;
    client.start();
    for (const auto& [bytes, code] : std::vector<std::pair<std::string, int>>{
             {framed("{"), -32700},
             {framed("\"\xFF\""), -32700},
             {framed(""), -32700},
             {framed(std::string(100000, '[')), -32700},
             {framed("[]"), -32600},
             {framed("7"), -32600},
             {framed("{}"), -32600},
             {framed(R"({"id": {}, "method": "shutdown"})"), -32600},
             {framed(R"({"id": 1, "method": 2})"), -32600},
             {"Content-Type: none\r\n\r\n", -32700},
             {"Content-Length: -5\r\n\r\n", -32700},
             {"Content-Length: 99999999999999999999999\r\n\r\n", -32700}}) {
      client.send_bytes(bytes);
      CHECK(error_code(client.heard()) == code);
    }
    // A length may stand in any case, besides other headers.
    const std::string body = R"({"jsonrpc": "2.0", "id": "last", "method": "shutdown"})";
    client.send_bytes("Content-Type: application/vscode-jsonrpc\ncontent-length:" +
                      std::to_string(body.size()) + "\n\n" + body);
    CHECK(client.heard()["id"] == "last");
  }

  TEST_CASE("a client that goes without a word ends the server with 1") {
    LspClient silent;
    CHECK(silent.end() == 1);
    LspClient hasty;
    hasty.start();
    hasty.notify("exit", Json());
    CHECK(hasty.end() == 1);
  }

  TEST_CASE("any bytes and any changes leave the server at work") {
    LspClient client;
    client.start();
    client.open(kUri, kText);
    for (int round = 0; round < 40; ++round) {
      const int line = round % 13;
      client.notify(
          "textDocument/didChange",
          change_of(round, Json::array({change_at(line, round % 7, round % 11,
                                                  std::string(1, "{[\"'$#: -"[round % 9]))})));
      for (const char* method : {"completion", "hover", "definition", "prepareRename"})
        CHECK(client.request(std::string("textDocument/") + method, at(kUri, line, round % 17))
                  .contains("result"));
    }
    CHECK(client.result("shutdown").is_null());
  }

  TEST_CASE("a name is changed in all packs that stand upon its pack") {
    namespace fs = std::filesystem;
    const fs::path folder = fs::temp_directory_path() / "oriel lsp folders";
    fs::remove_all(folder);
    fs::create_directories(folder / "packs");
    const std::string upon = "schema: oriel/1\nextends: ";
    const std::string header = "pack: {name: t, version: 1.0.0}\n";
    const std::string city =
        upon + "town.yaml\n" + header + "params: {sill: {value: 1 m}}   # not $sills\n";
    const std::string village =
        upon + "city.yaml\n" + header + "rules:\n  - {id: w, label: window, require: a > $sill}\n";
    const std::string village_test =
        "tests_for: village.yaml\ntests:\n  - {params: {sill: 0.8 m}}\n";
    const std::string stranger = "schema: oriel/1\n" + header + "params: {sill: {value: 1 m}}\n";
    const auto write = [&](const std::string& name, const std::string& text) {
      std::ofstream(folder / name) << text;
    };
    write("packs/town.yaml", kText);
    write("packs/city.yaml", city);
    write("packs/village.yaml", "schema: oriel/1\n");
    write("packs/village.test.yaml", village_test);
    write("packs/stranger.yaml", stranger);
    write("packs/broken.yaml", "extends: [town.yaml\n");
    const auto uri = [&](const std::string& name) {
      return "file://" + replaced_blanks((folder / name).string());
    };
    LspClient client;
    (void)client.result("initialize",
                        {{"capabilities", Json::object()},
                         {"workspaceFolders", {{{"uri", uri("packs")}, {"name", "packs"}}}}});
    client.open(uri("packs/town.yaml"), kText);
    // As the editor has it, not as it is on the disk.
    client.open(uri("packs/village.yaml"), village);
    const auto rename = [&](const std::string& name) {
      Json request = at(uri("packs/town.yaml"), 9, 48);
      request["newName"] = name;
      return client.request("textDocument/rename", request);
    };
    const Json changes = rename("parapet")["result"]["changes"];
    REQUIRE(changes.contains(uri("packs/city.yaml")));
    REQUIRE(changes.contains(uri("packs/village.yaml")));
    CHECK(changes.contains(uri("packs/town.yaml")));
    CHECK_FALSE(changes.contains(uri("packs/stranger.yaml")));
    CHECK(edited(city, changes[uri("packs/city.yaml")])
              .find("{parapet: {value: 1 m}}   # not $sills") != std::string::npos);
    CHECK(edited(village, changes[uri("packs/village.yaml")]).find("a > $parapet") !=
          std::string::npos);
    CHECK(changes.size() <= 4);
    // Folders come and go.
    client.notify(
        "workspace/didChangeWorkspaceFolders",
        {{"event",
          {{"removed", {{{"uri", uri("packs")}, {"name", "packs"}}}}, {"added", Json::array()}}}});
    CHECK(rename("parapet")["result"]["changes"].size() == 2);
    client.notify(
        "workspace/didChangeWorkspaceFolders",
        {{"event",
          {{"added", {{{"uri", uri("packs")}, {"name", "packs"}}}}, {"removed", Json::array()}}}});
    write("packs/city.yaml", city + "macros: {low: a < 1 m}\n");
    write("packs/tall.yaml", upon + "town.yaml\n" + header + "params: {parapet: {value: 1 m}}\n");
    const Json refused = rename("parapet");
    CHECK(error_code(refused) == -32803);
    CHECK(refused["error"]["message"].get<std::string>().find("tall.yaml") != std::string::npos);
    client.end();
    fs::remove_all(folder);
  }
}
