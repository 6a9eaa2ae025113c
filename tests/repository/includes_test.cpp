#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include <doctest/doctest.h>

namespace {

namespace fs = std::filesystem;

/// What the command includes besides its own files and the headers of oriel/, and why. Stages are
/// none of it: work on buildings is done by the front door.
const std::map<std::string, std::string> kAllowed{
    {"kernel/base/text/suggest.h", "commands and options that are misspelt"},
    {"kernel/base/text/counted.h", "counts with the right form of their noun"},
    {"kernel/base/issue.h", "what is reported, with its code"},
    {"kernel/base/log.h", "the loggers that command and library share"},
    {"kernel/base/own_fault.h", "what an exception that nobody expects is reported as"},
    {"kernel/base/text/printable.h", "words of files cannot command a terminal"},
    {"kernel/base/sha256.h", "hashes of inputs, outputs and shards"},
    {"io/cityjson/carried_labels.h", "view shows the labels that a file carries"},
    {"io/cityjson/cityjson_collector.h", "lines of a stream become one file"},
    {"io/cityjson/cityjson_splitter.h", "a file becomes lines of a stream"},
    {"io/cityjson/stream_header.h",
     "headers of streams are compared; ids of shards; split --grid: where a feature lies"},
    {"io/cityjson/id_set.h", "merge finds ids that occur twice"},
    {"io/cityjson/cityjson_source.h", "validate numbers the geometries of an object"},
    {"io/json/json_check.h", "status files and lists of shards"},
    {"io/document.h", "the records that the library reads"},
    {"io/files/file_lock.h", "a journal has one writer"},
    {"io/files/format.h", "which files of a folder are buildings; names of outputs"},
    {"io/files/output_file.h", "files appear when they are whole"},
    {"io/files/partial_files.h", "outputs of a run that is resumed"},
    {"io/records/feature_records.h", "which names are files of records; CSV of scores"},
    {"io/records/log_seal.h", "the log of a series has checks"},
    {"io/records/operation_log.h", "the log of a series"},
    {"io/records/stage_json.h", "segment --json and repair --report"},
    {"model/building.h", "a value"},
    {"model/labelled_building.h", "a value"},
    {"model/version.h", "--version, status files and pages"},
    {"experiments/experiment.h", "the command experiment"},
    {"studio/server/browser.h", "the studio's page is opened"},
    {"studio/lsp/language_server.h", "rules lsp"},
    {"studio/server/page_files.h", "view writes the studio's page without its editor"},
    {"studio/session/recording.h", "with the replies of a session"},
    {"studio/server/serve.h", "the studio"},
};

/// What the sessions of the studio include besides the front door, and why.
const std::map<std::string, std::string> kAllowedInStudio{
    {"kernel/base/parallel.h", "shares of the work"},
    {"kernel/base/code.h", "codes of refusals"},
    {"kernel/base/text/counted.h", "counts with the right form of their noun"},
    {"kernel/base/issue.h", "what is reported, with its code"},
    {"kernel/base/sha256.h", "whether a file is still the one that was opened"},
    {"kernel/base/own_fault.h", "what an exception that nobody expects is reported as"},
    {"io/cityjson/carried_labels.h", "recordings have the labels that a file carries"},
    {"io/document.h", "the records that the library reads"},
    {"io/files/file_lock.h", "one studio at a time saves"},
    {"io/tiles/earth.h", "files of one reference system are told, however it is written"},
    {"io/files/output_file.h", "packs and corrections appear when they are whole"},
    {"model/building.h", "a value"},
    {"model/description/attributes.h", "attributes are listed with unit and meaning"},
    {"model/polygon_owners.h", "which features a polygon lies in"},
    {"model/version.h", "the version in `state`"},
};

/// What each room may include besides itself: what lies below it, and no other leaf.
const std::map<std::string, std::set<std::string>> kBelow{
    {"kernel/base", {}},
    {"model", {"kernel/base"}},
    {"kernel", {"kernel/base", "model"}},
    {"io", {"kernel/base", "model", "kernel"}},
    {"interpret", {"kernel/base", "model", "kernel"}},
    {"generalise", {"kernel/base", "model", "kernel", "interpret"}},
    {"oriel", {"kernel/base", "model", "kernel", "io", "interpret", "generalise"}},
    {"experiments", {"kernel/base", "model", "kernel", "io", "interpret", "oriel"}},
    {"studio", {"kernel/base", "model", "io", "interpret", "oriel"}},
    {"cli", {"kernel/base", "model", "io", "oriel", "experiments", "studio"}},
    {"python", {"oriel"}}};

std::string room_of(const std::string& path) {
  return path.starts_with("kernel/base/") ? "kernel/base" : path.substr(0, path.find('/'));
}

/// True if a file may include a header.
bool is_downward(const std::string& file, const std::string& header) {
  const std::string from = room_of(file);
  const std::string to = room_of(header);
  return from == to || kBelow.at(from).contains(to);
}

/// The room that alone may include a header of the namespace detail: in the kernel each folder is
/// one.
std::string home_of(const std::string& path) {
  const bool is_in_kernel = path.starts_with("kernel/");
  return path.substr(0, path.find('/', is_in_kernel ? std::string_view("kernel/").size() : 0));
}

/// What a file includes, between quotes or angles.
std::set<std::string> includes_of(const fs::path& path) {
  std::set<std::string> included;
  constexpr std::string_view kInclude = "#include ";
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);)
    if (line.starts_with(kInclude))
      included.insert(
          line.substr(kInclude.size() + 1, line.find_last_of("\">") - kInclude.size() - 1));
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

/// True if a header's names are those of one room.
bool is_detail(const std::string& header) {
  std::ifstream file(fs::path(ORIEL_SOURCE_DIR) / header);
  for (std::string line; std::getline(file, line);)
    if (line == "namespace oriel::detail {") return true;
  return false;
}

/// The front door is what oriel/oriel.h gives, and nothing else of its folders.
bool is_of_the_door(const std::string& header) {
  static const std::set<std::string> door =
      includes_of(fs::path(ORIEL_SOURCE_DIR) / "oriel/oriel.h");
  return header == "oriel/oriel.h" || (header.starts_with("oriel/") && door.contains(header));
}

}  // namespace

TEST_SUITE("repository") {
  TEST_CASE("no room includes what lies above it") {
    // In this order each includes only earlier ones: the graph has no cycle.
    std::set<std::string> earlier;
    for (const char* room : {"kernel/base", "model", "kernel", "io", "interpret", "generalise",
                             "oriel", "experiments", "studio", "cli", "python"}) {
      CAPTURE(room);
      CHECK(std::ranges::includes(earlier, kBelow.at(room)));
      earlier.insert(room);
    }
    CHECK(earlier.size() == kBelow.size());
    CHECK_FALSE(is_downward("model/solid.h", "io/reader.h"));
    CHECK_FALSE(is_downward("kernel/base/issue.h", "kernel/segment/segment.h"));
    CHECK_FALSE(is_downward("oriel/label.h", "experiments/experiment.h"));
    const fs::path sources(ORIEL_SOURCE_DIR);
    int looked_at = 0;
    for (const auto& [room, below] : kBelow)
      for (const auto& entry : fs::recursive_directory_iterator(sources / room)) {
        const std::string file = fs::relative(entry.path(), sources).string();
        if (!entry.is_regular_file() || room_of(file) != room) continue;
        if (!file.ends_with(".h") && !file.ends_with(".cpp")) continue;
        ++looked_at;
        for (const std::string& header : includes_of(entry.path()))
          if (is_ours(header)) CHECK_MESSAGE(is_downward(file, header), file, " includes ", header);
      }
    CHECK(looked_at > 900);
  }

  TEST_CASE("io alone knows how a label is spelt in files") {
    const fs::path sources(ORIEL_SOURCE_DIR);
    const std::regex spelt(
        "oriel_label|\"oriel_(id|name|subclass|score|rule|groups|parts|why|codelist|party_wall|"
        "exposed|faces)\"");
    std::set<std::string> rooms;
    for (const auto& [room, below] : kBelow)
      for (const auto& entry : fs::recursive_directory_iterator(sources / room)) {
        if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
        std::ifstream file(entry.path());
        const std::string text{std::istreambuf_iterator<char>(file), {}};
        if (std::regex_search(text, spelt)) rooms.insert(room);
      }
    CHECK(rooms == std::set<std::string>{"io"});
  }

  TEST_CASE("what is detail is included in its own room only") {
    const fs::path sources(ORIEL_SOURCE_DIR);
    CHECK(home_of("kernel/segment/cuts/patch.h") == "kernel/segment");
    CHECK(home_of("io/files/input.h") == "io");
    std::set<std::string> details;
    for (const auto& [room, below] : kBelow)
      for (const auto& [header, file] : included_by(sources / room))
        if (is_detail(header)) details.insert(header);
    CHECK(details.size() > 100);
    for (const auto& [room, below] : kBelow)
      for (const auto& entry : fs::recursive_directory_iterator(sources / room)) {
        if (entry.path().extension() != ".h" && entry.path().extension() != ".cpp") continue;
        const std::string file = fs::relative(entry.path(), sources).string();
        for (const std::string& header : includes_of(entry.path()))
          CHECK_MESSAGE((!details.contains(header) || home_of(header) == home_of(file)), file,
                        " includes ", header);
      }
  }

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
