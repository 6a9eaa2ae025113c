#include "oriel/rules.h"

#include "io/reader.h"
#include "oriel/segment.h"

#include <utility>

namespace oriel {

namespace {

void describe_all(const Document& document, Checked<std::vector<DescribedBuilding>>& found) {
  PipelineOptions options;
  options.fits_noise = false;
  for (const Building& building : document.buildings) {
    PipelineResult result = segment(building, options);
    found.issues.insert(found.issues.end(), result.issues.begin(), result.issues.end());
    if (result.is_done())
      found.value->push_back(
          {std::move(result.description.table), std::move(result.description.graph)});
  }
}

Checked<std::vector<DescribedBuilding>> described_buildings(const std::string& path) {
  Checked<std::vector<DescribedBuilding>> found;
  found.value.emplace();
  try {
    Reader reader(path, {});
    while (const auto record = reader.next()) {
      found.issues.insert(found.issues.end(), record->issues.begin(), record->issues.end());
      if (record->value)
        describe_all(*record->value, found);
      else if (reader.format() != Format::cityjson_seq)
        break;
    }
  } catch (const InputError& error) {
    found.issues.push_back(error.issue());
  }
  return found;
}

}  // namespace

Checked<RuleTestReport> run_rule_tests(const std::string& path) {
  return run_rule_tests(path, described_buildings);
}

}  // namespace oriel
