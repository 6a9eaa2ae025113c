#include <filesystem>
#include <fstream>
#include <map>
#include <regex>
#include <set>
#include <string>

#include <doctest/doctest.h>

namespace {

namespace fs = std::filesystem;

/// What the command includes besides its own files and the headers of oriel/, and why. Stages are
/// none of it: work on buildings is done by the front door.
const std::map<std::string, std::string> kAllowed{
    {"kernel/base/issue.h", "what is reported, with its code"},
    {"kernel/base/log.h", "the loggers that command and library share"},
    {"kernel/base/sha256.h", "hashes of inputs, outputs and shards"},
    {"kernel/io/cityjson/carried_labels.h", "view shows the labels that a file carries"},
    {"kernel/io/cityjson/cityjson_collector.h", "lines of a stream become one file"},
    {"kernel/io/cityjson/cityjson_splitter.h", "a file becomes lines of a stream"},
    {"kernel/io/cityjson/stream_header.h",
     "headers of streams are compared; split --grid: where a feature lies"},
    {"kernel/io/document.h", "the records that the library reads"},
    {"kernel/io/files/output_file.h", "files appear when they are whole"},
    {"kernel/io/files/partial_files.h", "outputs of a run that is resumed"},
    {"kernel/io/records/feature_records.h", "which names are files of records; CSV of scores"},
    {"kernel/io/records/operation_log.h", "the log of a series"},
    {"kernel/io/records/stage_json.h", "segment --json and repair --report"},
    {"kernel/model/building.h", "a value"},
    {"kernel/model/labelled_building.h", "a value"},
    {"kernel/model/polygon_owners.h", "which features a polygon of a page lies in"},
    {"kernel/model/version.h", "--version, status files and pages"},
};

/// The headers that a folder's sources include between quotes, each with a file that does.
std::map<std::string, std::string> included_by(const fs::path& folder) {
  std::map<std::string, std::string> included;
  const std::regex line("^#include \"([^\"]+)\".*");
  for (const auto& entry : fs::recursive_directory_iterator(folder)) {
    if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
    std::ifstream file(entry.path());
    std::smatch match;
    for (std::string text; std::getline(file, text);)
      if (std::regex_match(text, match, line)) included.emplace(match[1], entry.path().string());
  }
  return included;
}

bool is_of_the_door(const std::string& header) {
  return header.starts_with("oriel/") && header.find('/', 6) == std::string::npos;
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
}
