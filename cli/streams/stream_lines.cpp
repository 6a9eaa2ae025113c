#include "cli/streams/stream_lines.h"

#include "kernel/io/cityjson/cityjson_splitter.h"
#include "kernel/io/writer.h"

#include <algorithm>
#include <unordered_set>
#include <utility>

namespace oriel::cli {

/// The first record is a whole file, or a header, which may have buildings, too.
void StreamLines::take_apart(const Document& document,
                             const std::vector<PipelineResult>& lines) const {
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
      visitor_.feature(splitter.feature(i));
  }
}

void StreamLines::add(const Document& document, const std::vector<PipelineResult>& lines) {
  if (std::exchange(is_first_, false)) return take_apart(document, lines);
  if (const std::string_view line = source_line(document); !line.empty())
    return visitor_.feature(std::string(line) + '\n');
  const std::string line = write_cityjson(document, {});
  if (!line.empty()) visitor_.feature(line);  // CityGML: empty for a Building with a fault
}

}  // namespace oriel::cli
