#include "oriel/read.h"

#include <iterator>
#include <utility>

namespace oriel {

Checked<std::vector<Document>> read(const std::string& path, const ReadOptions& options) {
  Checked<std::vector<Document>> all;
  Reader reader(path, options);
  while (auto record = reader.next()) {
    all.issues.insert(all.issues.end(), std::make_move_iterator(record->issues.begin()),
                      std::make_move_iterator(record->issues.end()));
    if (!record->value) continue;
    if (!all.value) all.value.emplace();
    all.value->push_back(std::move(*record->value));
  }
  return all;
}

}  // namespace oriel
