#pragma once

#include "studio/session/session.h"

#include <chrono>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

namespace oriel::test {

using nlohmann::json;

inline std::string sample_file(const std::string& name) {
  return std::string(ORIEL_SOURCE_DIR) + "/examples/samples/" + name;
}

/// The sample houses that the tests of the studio open, with their truth.
inline studio::SessionOptions sample_options() {
  studio::SessionOptions options;
  options.corrections.clear();
  for (const char* name : {"house", "l-house"}) {
    options.files.push_back(sample_file(std::string(name) + ".stripped.city.json"));
    options.truth.push_back(sample_file(std::string(name) + ".truth.json"));
  }
  return options;
}

/// A session that is asked as the page asks it.
class StudioBench {
 public:
  explicit StudioBench(studio::SessionOptions options = sample_options())
      : session_(std::move(options)) {
    while (true) {
      const json loading = ask("state", json::object())["loading"];
      if (loading["done"] == loading["all"]) break;
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
  }

  [[nodiscard]] studio::Reply reply(std::string_view verb, const std::string& body) {
    return session_.answer(verb, body);
  }

  /// What a good request is answered.
  json ask(std::string_view verb, const json& body) {
    const studio::Reply reply = session_.answer(verb, body.dump());
    REQUIRE_MESSAGE(reply.status == 200, verb, ": ", reply.json);
    return json::parse(reply.json);
  }

  /// What a good request of a verb that gives bytes is answered.
  std::string bytes(std::string_view verb, const json& body) {
    studio::Reply reply = session_.answer(verb, body.dump());
    REQUIRE_MESSAGE(reply.status == 200, verb, ": ", reply.json);
    CHECK(reply.json.empty());
    return std::move(reply.bytes);
  }

  /// The status of one that is refused, and its sentence.
  std::pair<int, std::string> refusal(std::string_view verb, const std::string& body) {
    const studio::Reply reply = session_.answer(verb, body);
    CHECK(reply.status != 200);
    return {reply.status, json::parse(reply.json)["error"].get<std::string>()};
  }

  json pack(const std::string& text, json more = json::object()) {
    more["text"] = text;
    more["version"] = ++version_;
    if (!more.contains("since")) more["since"] = number_;
    json answer = ask("pack", more);
    if (answer.contains("number")) number_ = answer["number"];
    return answer;
  }

  /// The text of the pack that the session was opened with.
  std::string pack_text() { return ask("state", json::object())["pack"]["text"]; }

 private:
  studio::Session session_;
  int version_ = 0;
  /// Of the answer before, as the page keeps it.
  std::uint64_t number_ = 0;
};

/// A folder of its own for a test, gone in the end.
class StudioFolder {
 public:
  explicit StudioFolder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / ("oriel-studio-" + name)) {
    std::filesystem::remove_all(path_);
    std::filesystem::create_directories(path_);
  }
  ~StudioFolder() { std::filesystem::remove_all(path_); }
  StudioFolder(const StudioFolder&) = delete;
  StudioFolder& operator=(const StudioFolder&) = delete;

  [[nodiscard]] std::string path() const { return path_.string(); }
  [[nodiscard]] std::string file(const std::string& name) const { return (path_ / name).string(); }
  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ifstream in(path_ / name, std::ios::binary);
    std::stringstream all;
    all << in.rdbuf();
    return all.str();
  }

 private:
  std::filesystem::path path_;
};

inline std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  REQUIRE_MESSAGE(at != std::string::npos, what);
  return text.replace(at, what.size(), by);
}

}  // namespace oriel::test
