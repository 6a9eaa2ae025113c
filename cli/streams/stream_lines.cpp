#include "cli/streams/stream_lines.h"

#include "io/cityjson/cityjson_splitter.h"
#include "io/cityjson/stream_header.h"
#include "oriel/write.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

namespace oriel::cli {

/// The first record is a whole file, or a header, which may have buildings, too.
void StreamLines::take_apart(const Document& document, const std::vector<PipelineResult>& lines) {
  std::unordered_set<std::string> selected, buildings;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    buildings.insert(document.buildings[i].id);
    if (!lines[i].is_passed_over) selected.insert(document.buildings[i].id);
  }
  const CityJsonSplitter splitter(document);
  visitor_.header(splitter.header());
  for (std::size_t i = 0; i < splitter.size(); ++i) {
    const std::vector<std::string> ids = splitter.ids(i);
    const auto is_selected = [&](const std::string& id) { return selected.contains(id); };
    const auto is_building = [&](const std::string& id) { return buildings.contains(id); };
    if (selection_.is_all() || std::ranges::any_of(ids, is_selected) ||
        (std::ranges::none_of(ids, is_building) &&
         selection_.takes_feature(ids[0], splitter.type(i))))
      give(splitter.feature(i));
  }
}

void StreamLines::give(const std::string& line) {
  ++features_;
  visitor_.feature(line);
}

void StreamLines::add(const Document& document, const std::vector<PipelineResult>& lines) {
  if (std::exchange(is_first_, false)) return take_apart(document, lines);
  if (const std::string_view line = source_line(document); !line.empty())
    return give(std::string(line) + '\n');
  const std::string line = write(document, OutputRecord{});
  if (!line.empty()) give(line);  // CityGML: empty for a Building with a fault
}

std::optional<Issue> CommonHeader::check(const std::string& header, const std::string& input) {
  const bool is_file = of_ == Of::file;
  const std::string facts = is_file ? file_facts(header) : stream_header_facts(header);
  if (facts_.empty()) {
    facts_ = facts;
    input_ = input;
  }
  if (facts == facts_) return std::nullopt;
  Issue issue;
  issue.code = Code::E116;
  issue.sentence = fmt::format("has the header {}, but {} has {}: they cannot share a {}", facts,
                               input_, facts_, is_file ? "file" : "stream");
  issue.place.file = input;
  return issue;
}

}  // namespace oriel::cli
