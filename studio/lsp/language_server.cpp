#include "studio/lsp/language_server.h"

#include "io/files/output_file.h"
#include "oriel/rules.h"
#include "studio/lsp/documents.h"
#include "studio/lsp/file_uri.h"
#include "studio/lsp/json_value.h"
#include "studio/lsp/message_stream.h"
#include "studio/lsp/protocol_json.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <optional>
#include <set>
#include <stdexcept>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel::studio {

namespace {

/// Error codes of JSON-RPC and of the Language Server Protocol.
enum class RpcCode {
  parse_error = -32700,
  invalid_request = -32600,
  method_not_found = -32601,
  invalid_params = -32602,
  internal_error = -32603,
  not_initialized = -32002,
  request_failed = -32803
};

/// Why a request is answered with an error.
class RpcError : public std::runtime_error {
 public:
  RpcError(RpcCode code, const std::string& sentence) : std::runtime_error(sentence), code_(code) {}
  [[nodiscard]] RpcCode code() const { return code_; }

 private:
  RpcCode code_;
};

/// The folders that a client works in.
class WorkspaceFolders {
 public:
  /// Those of the params of `initialize`: `workspaceFolders`, else `rootUri`, else `rootPath`.
  void open(const JsonValue& params);
  /// Of the notification `workspace/didChangeWorkspaceFolders`.
  void change(const JsonValue& params);

  /// The YAML files in the folder of `file`, sorted, if that is one of these folders or below:
  /// packs extend others of their own folder only.
  [[nodiscard]] std::vector<std::string> yaml_files_beside(const std::string& file) const;

 private:
  void add(const std::string& uri);

  std::vector<std::string> folders_;
};

namespace fs = std::filesystem;

bool is_yaml(const fs::path& file) {
  return file.extension() == ".yaml" || file.extension() == ".yml";
}

bool is_below(const fs::path& folder, const fs::path& of) {
  const fs::path way = folder.lexically_normal().lexically_relative(of.lexically_normal());
  return !way.empty() && *way.begin() != "..";
}

void WorkspaceFolders::add(const std::string& uri) {
  std::string folder = path_of_uri(uri);
  if (!folder.empty() && std::ranges::find(folders_, folder) == folders_.end())
    folders_.push_back(std::move(folder));
}

void WorkspaceFolders::open(const JsonValue& params) {
  if (!params.is_object()) return;
  const auto text = [&](const char* key) {
    const auto found = params.find(key);
    return found != params.end() && found->is_string() ? found->get<std::string>() : "";
  };
  if (const auto list = params.find("workspaceFolders"); list != params.end() && list->is_array())
    for (const JsonValue& folder : *list) add(folder.at("uri").get<std::string>());
  else if (const std::string uri = text("rootUri"); !uri.empty())
    add(uri);
  else if (const std::string path = text("rootPath"); !path.empty())
    add(uri_of_path(path));
}

void WorkspaceFolders::change(const JsonValue& params) {
  const JsonValue& event = params.at("event");
  for (const JsonValue& folder : event.at("removed"))
    std::erase(folders_, path_of_uri(folder.at("uri").get<std::string>()));
  for (const JsonValue& folder : event.at("added")) add(folder.at("uri").get<std::string>());
}

std::vector<std::string> WorkspaceFolders::yaml_files_beside(const std::string& file) const {
  std::vector<std::string> files;
  const fs::path folder = fs::path(file).parent_path();
  if (std::ranges::none_of(folders_, [&](const std::string& f) { return is_below(folder, f); }))
    return files;
  std::error_code problem;
  fs::directory_iterator at(folder, problem);
  for (const fs::directory_iterator end; !problem && at != end; at.increment(problem)) {
    std::error_code ignored;
    if (is_yaml(at->path()) && at->is_regular_file(ignored)) files.push_back(at->path().string());
  }
  std::ranges::sort(files);
  return files;
}

/// Findings wait for so long a pause of the client.
constexpr std::chrono::milliseconds kPause{80};
/// A client that never pauses gets them after so long.
constexpr std::chrono::milliseconds kLongestWait{1000};

class LanguageServer {
 public:
  LanguageServer(int in, int out, const LanguageServerOptions& options)
      : stream_(in, out), options_(&options) {}

  int run() {
    while (!exit_code_) step();
    return *exit_code_;
  }

 private:
  using Clock = std::chrono::steady_clock;
  enum class Phase { before, running, after };

  using Answer = JsonValue (LanguageServer::*)(const JsonValue&);
  struct Method {
    std::string_view name;
    Answer answer;
  };

  void step();
  [[nodiscard]] std::optional<std::chrono::milliseconds> patience() const;
  void take(const std::string& body);
  void take_notification(const std::string& method, const JsonValue& params);
  void answer(const JsonValue& id, const std::string& method, const JsonValue& params);
  [[nodiscard]] JsonValue result_of(const std::string& method, const JsonValue& params);

  void send(const JsonValue& message);
  void send_error(const JsonValue& id, RpcCode code, const std::string& sentence);
  void publish_findings();
  void publish(const std::string& uri, std::optional<std::int64_t> version, JsonValue findings);

  // Requests.
  JsonValue initialize(const JsonValue& params);
  JsonValue shutdown(const JsonValue& params);
  JsonValue complete(const JsonValue& params);
  JsonValue hover(const JsonValue& params);
  JsonValue definition(const JsonValue& params);
  JsonValue symbols(const JsonValue& params);
  JsonValue format(const JsonValue& params);
  JsonValue prepare_rename(const JsonValue& params);
  JsonValue rename(const JsonValue& params);
  JsonValue fixes(const JsonValue& params);

  // Notifications.
  void open(const JsonValue& params);
  void change(const JsonValue& params);
  void close(const JsonValue& params);

  struct AskedPlace {
    const EditedPack* pack = nullptr;
    std::string uri;
    std::size_t offset = 0;
  };
  /// The document of a request, and the place in it if one is asked about.
  AskedPlace asked(const JsonValue& params, bool has_position);
  [[nodiscard]] std::vector<std::string> packs_beside(const std::string& file) const;
  [[nodiscard]] std::string uri_of(const DefinitionPlace& place, const std::string& here) const;

  MessageStream stream_;
  const LanguageServerOptions* options_;
  OpenDocuments documents_;
  WorkspaceFolders folders_;
  Phase phase_ = Phase::before;
  bool knows_trees_ = false;
  bool knows_links_ = false;
  std::optional<int> exit_code_;
  std::optional<Clock::time_point> dirty_since_;
};

std::optional<std::chrono::milliseconds> LanguageServer::patience() const {
  if (!documents_.has_dirty()) return std::nullopt;
  if (!dirty_since_) return kPause;
  const auto waited =
      std::chrono::duration_cast<std::chrono::milliseconds>(Clock::now() - *dirty_since_);
  return std::clamp(kLongestWait - waited, std::chrono::milliseconds{0}, kPause);
}

/// Takes what comes next; if that is a pause, the newest texts are what findings are of.
void LanguageServer::step() {
  if (!documents_.has_dirty())
    dirty_since_.reset();
  else if (!dirty_since_)
    dirty_since_ = Clock::now();
  if (patience() == std::chrono::milliseconds{0}) return publish_findings();
  const MessageStream::Read read = stream_.read(patience());
  switch (read.outcome) {
    case MessageStream::ReadOutcome::message:
      return take(read.body);
    case MessageStream::ReadOutcome::unreadable:
      return send_error(nullptr, RpcCode::parse_error, read.body);
    case MessageStream::ReadOutcome::silence:
      return publish_findings();
    case MessageStream::ReadOutcome::end:
      exit_code_ = 1;
  }
}

void LanguageServer::take(const std::string& body) {
  const JsonValue message = JsonValue::parse(body, nullptr, false);
  if (message.is_discarded())
    return send_error(nullptr, RpcCode::parse_error, "this is not JSON in UTF-8");
  const bool is_object = message.is_object();
  const JsonValue id = is_object ? message.value("id", JsonValue()) : JsonValue();
  const bool has_id = is_object && message.contains("id");
  const bool has_method = is_object && message.contains("method") && message["method"].is_string();
  const bool is_answer = is_object && !message.contains("method") && has_id &&
                         (message.contains("result") || message.contains("error"));
  if (is_answer) return;  // nothing is asked of clients
  const bool is_id = id.is_number_integer() || id.is_string();
  if (!has_method || (has_id && !is_id))
    return send_error(is_id ? id : JsonValue(), RpcCode::invalid_request,
                      "a request is an object with 'method', a text, and 'id', a number or a text");
  const std::string method = message["method"].get<std::string>();
  const JsonValue params = message.value("params", JsonValue::object());
  if (has_id)
    answer(id, method, params);
  else
    take_notification(method, params);
}

/// Notifications have no answer: what is wrong with one is passed over.
void LanguageServer::take_notification(const std::string& method, const JsonValue& params) {
  if (method == "exit") {
    exit_code_ = phase_ == Phase::after ? 0 : 1;
    return;
  }
  if (phase_ != Phase::running) return;
  try {
    if (method == "textDocument/didOpen") open(params);
    if (method == "textDocument/didChange") change(params);
    if (method == "textDocument/didClose") close(params);
    if (method == "workspace/didChangeWorkspaceFolders") folders_.change(params);
  } catch (const JsonValue::exception&) {
    return;
  }
}

void LanguageServer::answer(const JsonValue& id, const std::string& method,
                            const JsonValue& params) {
  try {
    JsonValue reply{{"jsonrpc", "2.0"}, {"id", id}};
    reply["result"] = result_of(method, params);
    send(reply);
  } catch (const RpcError& error) {
    send_error(id, error.code(), error.what());
  } catch (const JsonValue::exception&) {
    send_error(id, RpcCode::invalid_params, fmt::format("the params are not those of {}", method));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& problem) {
    send_error(id, RpcCode::internal_error, problem.what());
  }
}

JsonValue LanguageServer::result_of(const std::string& method, const JsonValue& params) {
  static constexpr std::array kMethods = {
      Method{"initialize", &LanguageServer::initialize},
      Method{"shutdown", &LanguageServer::shutdown},
      Method{"textDocument/completion", &LanguageServer::complete},
      Method{"textDocument/hover", &LanguageServer::hover},
      Method{"textDocument/definition", &LanguageServer::definition},
      Method{"textDocument/documentSymbol", &LanguageServer::symbols},
      Method{"textDocument/formatting", &LanguageServer::format},
      Method{"textDocument/prepareRename", &LanguageServer::prepare_rename},
      Method{"textDocument/rename", &LanguageServer::rename},
      Method{"textDocument/codeAction", &LanguageServer::fixes}};
  const bool is_first = method == "initialize";
  if (phase_ == Phase::before && !is_first)
    throw RpcError(RpcCode::not_initialized, "'initialize' comes first");
  if (phase_ == Phase::after || (phase_ == Phase::running && is_first))
    throw RpcError(RpcCode::invalid_request,
                   is_first ? "'initialize' comes once" : "after 'shutdown' only 'exit' comes");
  const auto* known = std::ranges::find(kMethods, method, &Method::name);
  if (known == kMethods.end())
    throw RpcError(RpcCode::method_not_found, fmt::format("there is no method '{}'", method));
  const bool is_of_document = method.starts_with("textDocument/");
  if (is_of_document && !is_of_oriel(*asked(params, false).pack)) return nullptr;
  return (this->*known->answer)(params);
}

void LanguageServer::send(const JsonValue& message) {
  const bool is_heard =
      stream_.write(message.dump(-1, ' ', false, JsonValue::error_handler_t::replace));
  if (!is_heard) exit_code_ = 1;
}

void LanguageServer::send_error(const JsonValue& id, RpcCode code, const std::string& sentence) {
  send({{"jsonrpc", "2.0"},
        {"id", id},
        {"error", {{"code", static_cast<int>(code)}, {"message", sentence}}}});
}

void LanguageServer::publish(const std::string& uri, std::optional<std::int64_t> version,
                             JsonValue findings) {
  JsonValue params{{"uri", uri}};
  if (version) params["version"] = *version;
  params["diagnostics"] = std::move(findings);
  send({{"jsonrpc", "2.0"},
        {"method", "textDocument/publishDiagnostics"},
        {"params", std::move(params)}});
}

void LanguageServer::publish_findings() {
  dirty_since_.reset();
  for (OpenDocument* document : documents_.dirty()) {
    const EditedPack& pack = documents_.pack_of(*document);
    JsonValue findings = JsonValue::array();
    if (is_of_oriel(pack))
      for (const TextFinding& finding : pack.findings())
        findings.push_back(
            diagnostic_json(pack, finding, knows_links_ ? options_->docs_url : std::string()));
    document->is_dirty = false;
    publish(document->uri, document->version, std::move(findings));
  }
}

/// The value at a path of members; null if there is none.
JsonValue member_at(const JsonValue& json, std::initializer_list<const char*> path) {
  const JsonValue* at = &json;
  for (const char* key : path) {
    if (!at->is_object() || !at->contains(key)) return nullptr;
    at = &(*at)[key];
  }
  return *at;
}

JsonValue LanguageServer::initialize(const JsonValue& params) {
  const JsonValue text = member_at(params, {"capabilities", "textDocument"});
  knows_trees_ = member_at(text, {"documentSymbol", "hierarchicalDocumentSymbolSupport"}) == true;
  knows_links_ = member_at(text, {"publishDiagnostics", "codeDescriptionSupport"}) == true;
  folders_.open(params);
  phase_ = Phase::running;
  return {{"capabilities",
           {{"positionEncoding", "utf-16"},
            {"textDocumentSync", {{"openClose", true}, {"change", 2}}},
            {"completionProvider", {{"triggerCharacters", {"$", ".", "(", " "}}}},
            {"hoverProvider", true},
            {"definitionProvider", true},
            {"documentSymbolProvider", true},
            {"documentFormattingProvider", true},
            {"renameProvider", {{"prepareProvider", true}}},
            {"codeActionProvider", {{"codeActionKinds", {"quickfix"}}}},
            {"workspace",
             {{"workspaceFolders", {{"supported", true}, {"changeNotifications", true}}}}}}},
          {"serverInfo", {{"name", "oriel"}, {"version", options_->version}}}};
}

JsonValue LanguageServer::shutdown(const JsonValue& /*params*/) {
  phase_ = Phase::after;
  return nullptr;
}

LanguageServer::AskedPlace LanguageServer::asked(const JsonValue& params, bool has_position) {
  AskedPlace asked;
  asked.uri = params.at("textDocument").at("uri").get<std::string>();
  OpenDocument* document = documents_.find(asked.uri);
  if (document == nullptr)
    throw RpcError(RpcCode::invalid_params, fmt::format("'{}' is not open", asked.uri));
  asked.pack = &documents_.pack_of(*document);
  if (has_position)
    asked.offset = asked.pack->places().offset(place_of_position(params.at("position")));
  return asked;
}

JsonValue LanguageServer::complete(const JsonValue& params) {
  const AskedPlace at = asked(params, true);
  return completion_json(*at.pack, at.offset);
}

JsonValue LanguageServer::hover(const JsonValue& params) {
  const AskedPlace at = asked(params, true);
  const auto hover = at.pack->hover(at.offset);
  if (!hover) return nullptr;
  return {{"contents", {{"kind", "plaintext"}, {"value", hover->text}}},
          {"range", protocol_range(at.pack->places(), hover->where)}};
}

/// A built-in pack has no file: what leads there leads into a copy of it.
std::string LanguageServer::uri_of(const DefinitionPlace& place, const std::string& here) const {
  if (place.is_here) return here;
  if (!place.is_built_in) return uri_of_path(place.file);
  const std::string name = std::filesystem::path(place.file).stem().string();
  const auto text = embedded_pack(name);
  if (options_->copies.empty() || !text) return "";
  const std::filesystem::path copy = std::filesystem::path(options_->copies) / place.file;
  std::error_code problem;
  std::filesystem::create_directories(options_->copies, problem);
  if (problem) return "";
  try {
    write_file(copy.string(), std::string(*text));
  } catch (const OutputError&) {
    return "";
  }
  return uri_of_path(copy.string());
}

JsonValue LanguageServer::definition(const JsonValue& params) {
  const AskedPlace at = asked(params, true);
  const auto place = at.pack->definition(at.offset);
  const std::string uri = place ? uri_of(*place, at.uri) : "";
  if (uri.empty()) return nullptr;
  return {{"uri", uri},
          {"range", {{"start", position_json(place->begin)}, {"end", position_json(place->end)}}}};
}

JsonValue LanguageServer::symbols(const JsonValue& params) {
  const AskedPlace at = asked(params, false);
  return symbols_json(*at.pack, at.uri, knows_trees_);
}

/// A pack with errors stays as it is: its findings are shown already.
JsonValue LanguageServer::format(const JsonValue& params) {
  const AskedPlace at = asked(params, false);
  const auto formatted = at.pack->format();
  if (!formatted.value) return JsonValue::array();
  return edits_json(at.pack->places(), changed_lines(at.pack->text(), *formatted.value));
}

JsonValue LanguageServer::prepare_rename(const JsonValue& params) {
  const AskedPlace at = asked(params, true);
  const auto where = at.pack->renameable(at.offset);
  if (!where) return nullptr;
  return {{"range", protocol_range(at.pack->places(), *where)},
          {"placeholder", at.pack->text().substr(where->begin, where->end - where->begin)}};
}

/// Those that are open, and those in its folder, if the client works there.
std::vector<std::string> LanguageServer::packs_beside(const std::string& file) const {
  std::vector<std::string> files = folders_.yaml_files_beside(file);
  for (const std::string& uri : documents_.uris()) files.push_back(path_of_uri(uri));
  std::ranges::sort(files);
  files.erase(std::unique(files.begin(), files.end()), files.end());
  return files;
}

JsonValue LanguageServer::rename(const JsonValue& params) {
  const AskedPlace at = asked(params, true);
  const Renaming renaming = at.pack->rename(at.offset, params.at("newName").get<std::string>(),
                                            packs_beside(at.pack->file()));
  if (!renaming.refusal.empty()) throw RpcError(RpcCode::request_failed, renaming.refusal);
  JsonValue changes = JsonValue::object();
  for (const FileEdits& file : renaming.files) {
    const std::string uri = file.file == at.pack->file() ? at.uri : uri_of_path(file.file);
    changes[uri] = edits_json(TextPlaces(file.text), file.edits);
  }
  return {{"changes", std::move(changes)}};
}

JsonValue LanguageServer::fixes(const JsonValue& params) {
  const AskedPlace at = asked(params, false);
  const TextPlaces& places = at.pack->places();
  const JsonValue& range = params.at("range");
  const std::size_t begin = places.offset(place_of_position(range.at("start")));
  const std::size_t end = places.offset(place_of_position(range.at("end")));
  const JsonValue only = member_at(params, {"context", "only"});
  const auto is_asked = [](const JsonValue& kind) { return kind == "quickfix" || kind == ""; };
  JsonValue actions = JsonValue::array();
  if (only.is_array() && std::ranges::none_of(only, is_asked)) return actions;
  for (const TextFinding& finding : at.pack->findings()) {
    if (finding.where.begin > end || finding.where.end < begin) continue;
    for (const QuickFix& fix : finding.fixes) {
      JsonValue edits;
      edits[at.uri] = edits_json(places, fix.edits);
      actions.push_back({{"title", fix.title},
                         {"kind", "quickfix"},
                         {"diagnostics", JsonValue::array({diagnostic_json(
                                             *at.pack, finding,
                                             knows_links_ ? options_->docs_url : std::string())})},
                         {"isPreferred", true},
                         {"edit", {{"changes", std::move(edits)}}}});
    }
  }
  return actions;
}

std::optional<std::int64_t> version_in(const JsonValue& document) {
  const JsonValue version = member_at(document, {"version"});
  return version.is_number_integer() ? std::optional(version.get<std::int64_t>()) : std::nullopt;
}

void LanguageServer::open(const JsonValue& params) {
  const JsonValue& document = params.at("textDocument");
  documents_.open(document.at("uri").get<std::string>(), version_in(document),
                  document.at("text").get<std::string>());
  publish_findings();
}

void LanguageServer::change(const JsonValue& params) {
  const JsonValue& document = params.at("textDocument");
  std::vector<DocumentChange> changes;
  for (const JsonValue& content : params.at("contentChanges")) {
    DocumentChange& change = changes.emplace_back();
    change.text = content.at("text").get<std::string>();
    if (!content.contains("range")) continue;
    const JsonValue& range = content["range"];
    change.range = {place_of_position(range.at("start")), place_of_position(range.at("end"))};
  }
  documents_.change(document.at("uri").get<std::string>(), version_in(document), changes);
}

/// What an editor shows of a closed document goes.
void LanguageServer::close(const JsonValue& params) {
  const std::string uri = params.at("textDocument").at("uri").get<std::string>();
  if (documents_.close(uri)) publish(uri, std::nullopt, JsonValue::array());
}

}  // namespace

int serve_language(int in, int out, const LanguageServerOptions& options) {
  return LanguageServer(in, out, options).run();
}

std::string folder_of_copies() {
  const auto variable = [](const char* name) {
    const char* value = std::getenv(name);
    return std::string(value == nullptr ? "" : value);
  };
  const std::string cache = variable("XDG_CACHE_HOME");
  if (cache.starts_with('/')) return cache + "/oriel/packs";
  const std::string home = variable("HOME");
  return home.starts_with('/') ? home + "/.cache/oriel/packs" : "";
}

}  // namespace oriel::studio
