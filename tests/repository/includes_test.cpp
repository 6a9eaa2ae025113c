#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <vector>

#include <doctest/doctest.h>

namespace {

namespace fs = std::filesystem;

/// What the command includes besides its own files and the headers of oriel/, and why. Stages are
/// none of it: work on buildings is done by the front door.
const std::map<std::string, std::string> kAllowed{
    {"interpret/language/suggest.h", "commands and options that are misspelt"},
    {"kernel/base/text/counted.h", "counts with the right form of their noun"},
    {"kernel/base/issue.h", "what is reported, with its code"},
    {"kernel/base/log.h", "the loggers that command and library share"},
    {"kernel/base/own_fault.h", "what an exception that nobody expects is reported as"},
    {"kernel/base/text/printable.h", "words of files cannot command a terminal"},
    {"kernel/base/sha256.h", "hashes of inputs, outputs and shards"},
    {"kernel/io/cityjson/carried_labels.h", "view shows the labels that a file carries"},
    {"kernel/io/cityjson/cityjson_collector.h", "lines of a stream become one file"},
    {"kernel/io/cityjson/cityjson_splitter.h", "a file becomes lines of a stream"},
    {"kernel/io/cityjson/stream_header.h",
     "headers of streams are compared; ids of shards; split --grid: where a feature lies"},
    {"kernel/io/cityjson/id_set.h", "merge finds ids that occur twice"},
    {"kernel/io/cityjson/cityjson_source.h", "validate numbers the geometries of an object"},
    {"kernel/io/json/json_check.h", "status files and lists of shards"},
    {"kernel/io/document.h", "the records that the library reads"},
    {"kernel/io/files/file_lock.h", "a journal has one writer"},
    {"kernel/io/files/format.h", "which files of a folder are buildings; names of outputs"},
    {"kernel/io/files/output_file.h", "files appear when they are whole"},
    {"kernel/io/files/partial_files.h", "outputs of a run that is resumed"},
    {"kernel/io/records/feature_records.h", "which names are files of records; CSV of scores"},
    {"kernel/io/records/log_seal.h", "the log of a series has checks"},
    {"kernel/io/records/operation_log.h", "the log of a series"},
    {"kernel/io/records/stage_json.h", "segment --json and repair --report"},
    {"kernel/model/building.h", "a value"},
    {"kernel/model/labelled_building.h", "a value"},
    {"kernel/model/polygon_owners.h", "which features a polygon of a page lies in"},
    {"kernel/model/version.h", "--version, status files and pages"},
    {"studio/server/browser.h", "the studio's page is opened"},
    {"studio/lsp/language_server.h", "rules lsp"},
    {"studio/server/page_files.h", "view writes the studio's page without its editor"},
    {"studio/server/serve.h", "the studio"},
    {"studio/session/plain_sentence.h", "view says the studio's sentences"},
    {"studio/session/storeys.h", "view cuts storeys open as the studio does"},
};

/// What the sessions of the studio include besides the front door, and why.
const std::map<std::string, std::string> kAllowedInStudio{
    {"interpret/experiment/parallel.h", "shares of the work"},
    {"kernel/base/code.h", "codes of refusals"},
    {"kernel/base/text/counted.h", "counts with the right form of their noun"},
    {"kernel/base/ids.h", "numbers of features"},
    {"kernel/base/issue.h", "what is reported, with its code"},
    {"kernel/base/sha256.h", "whether a file is still the one that was opened"},
    {"kernel/base/own_fault.h", "what an exception that nobody expects is reported as"},
    {"kernel/io/document.h", "the records that the library reads"},
    {"kernel/io/files/file_lock.h", "one studio at a time saves"},
    {"kernel/io/files/output_file.h", "packs and corrections appear when they are whole"},
    {"kernel/model/building.h", "a value"},
    {"kernel/model/description/attributes.h", "attributes are listed with unit and meaning"},
    {"kernel/model/interpretation.h", "a value"},
    {"kernel/model/polygon_owners.h", "which features a polygon lies in"},
    {"kernel/model/segmentation.h", "a value"},
    {"kernel/model/version.h", "the version in `state`"},
};

/// What a file includes, between quotes or angles.
std::set<std::string> includes_of(const fs::path& path) {
  std::set<std::string> included;
  const std::regex line("^#include [\"<]([^\">]+)[\">].*");
  std::ifstream file(path);
  std::smatch match;
  for (std::string text; std::getline(file, text);)
    if (std::regex_match(text, match, line)) included.insert(match[1]);
  return included;
}

/// A header of the project, or what one is made from.
bool is_ours(const std::string& header) {
  const fs::path path = fs::path(ORIEL_SOURCE_DIR) / header;
  return fs::exists(path) || fs::exists(path.string() + ".in");
}

/// The headers of the project that a folder's sources include, each with a file that does.
std::map<std::string, std::string> included_by(const fs::path& folder) {
  std::map<std::string, std::string> included;
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
    for (const std::string& header : includes_of(entry.path()))
      if (is_ours(header)) included.emplace(header, entry.path().string());
  }
  return included;
}

/// The front door is what oriel/oriel.h gives, and nothing else of its folders.
bool is_of_the_door(const std::string& header) {
  static const std::set<std::string> door =
      includes_of(fs::path(ORIEL_SOURCE_DIR) / "oriel/oriel.h");
  return header == "oriel/oriel.h" || (header.starts_with("oriel/") && door.contains(header));
}

}  // namespace

TEST_SUITE("repository") {
  TEST_CASE("the command calls the front door and no stage") {
    const auto included = included_by(fs::path(ORIEL_SOURCE_DIR) / "cli");
    std::set<std::string> others;
    for (const auto& [header, file] : included) {
      if (header.starts_with("cli/") || is_of_the_door(header)) continue;
      others.insert(header);
      CHECK_MESSAGE(kAllowed.contains(header), file, " includes ", header);
    }
    for (const auto& [header, why] : kAllowed)
      CHECK_MESSAGE(others.contains(header), "nothing includes ", header, " any more");
    CHECK(included.size() > kAllowed.size());
  }

  TEST_CASE("the sessions of the studio call the front door and no stage") {
    const auto included = included_by(fs::path(ORIEL_SOURCE_DIR) / "studio/session");
    CHECK(included.size() > kAllowedInStudio.size());
    for (const auto& [header, file] : included)
      CHECK_MESSAGE((header.starts_with("studio/") || is_of_the_door(header) ||
                     kAllowedInStudio.contains(header)),
                    file, " includes ", header);
    for (const auto& [header, why] : kAllowedInStudio)
      CHECK_MESSAGE(included.contains(header), "nothing includes ", header, " any more");
  }

  TEST_CASE("the Python module calls the front door only") {
    const auto included = included_by(fs::path(ORIEL_SOURCE_DIR) / "python");
    CHECK(included.size() > 5);
    for (const auto& [header, file] : included)
      CHECK_MESSAGE((header.starts_with("python/") || is_of_the_door(header)), file, " includes ",
                    header);
  }

  // Its classes have other members there: the library is compiled with definitions of its own.
  TEST_CASE("no test includes simdjson, itself or by way of other headers") {
    const fs::path sources(ORIEL_SOURCE_DIR);
    auto by = included_by(sources / "tests");
    std::vector<std::string> waiting;
    for (const auto& [header, file] : by) waiting.push_back(header);
    REQUIRE(waiting.size() > 100);
    while (!waiting.empty()) {
      const std::string header = waiting.back();
      waiting.pop_back();
      for (const std::string& next : includes_of(sources / header)) {
        CHECK_MESSAGE(next != "simdjson.h", header, " is included by ", by[header]);
        if (is_ours(next) && by.emplace(next, header).second) waiting.push_back(next);
      }
    }
  }
}
