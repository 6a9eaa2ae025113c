#include "oriel/rules.h"

#include "kernel/base/text/slug.h"
#include "oriel/label.h"
#include "oriel/picture.h"
#include "oriel/read.h"
#include "oriel/segment.h"
#include "oriel/write.h"

#include <filesystem>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

/// Those that tests are about are measured as they are, not fitted to noise.
LabelOptions options_of_tests() {
  LabelOptions options;
  options.fits_noise = false;
  return options;
}

Checked<std::vector<DescribedBuilding>> described_buildings(const std::string& path) {
  Checked<std::vector<DescribedBuilding>> found;
  found.value.emplace();
  try {
    auto file = read(path);
    found.issues = std::move(file.issues);
    for (const Document& document : file.value.value_or(std::vector<Document>()))
      for (const Building& building : document.buildings) {
        PipelineResult result = segment(building, options_of_tests());
        found.issues.insert(found.issues.end(), result.issues.begin(), result.issues.end());
        if (result.is_done())
          found.value->push_back(
              {std::move(result.description.table), std::move(result.description.graph)});
      }
  } catch (const InputError& error) {
    found.issues.push_back(error.issue());
  }
  return found;
}

/// "a door is wide: w.1 is unknown, expected window (and 2 more)".
std::string caption_of(const RuleTestResult& test) {
  const std::size_t more = test.failures.size() - 1;
  return fmt::format("{}: {}{}", test.name, test.failures.front(),
                     more == 0 ? "" : fmt::format(" (and {} more)", more));
}

}  // namespace

Checked<RuleTestReport> run_rule_tests(const std::string& path) {
  return run_rule_tests(path, described_buildings);
}

Checked<std::string> picture_of(const RuleTestReport& report, const RuleTestResult& test) try {
  auto file = read(test.building);
  if (!file.value) return {std::nullopt, std::move(file.issues)};
  PicturePanel panel{.caption = caption_of(test)};
  for (const auto& feature : test.unexpected) panel.marks[feature] = PictureMark::wrong;
  for (const Document& document : *file.value)
    for (const Building& building : document.buildings)
      append_building(panel.mesh, building,
                      label(building, *report.pack, options_of_tests()).output);
  return picture({std::move(panel)}, PictureFormat::svg);
} catch (const InputError& error) {
  return {std::nullopt, {error.issue()}};
}

std::string picture_name_of(const RuleTestReport& report, const RuleTestResult& test) {
  constexpr std::size_t kLongestName = 120;
  const auto pack = std::filesystem::path(report.file).stem().stem();  // without .test.yaml
  return slug_of(pack.string() + "-" + test.name).substr(0, kLongestName);
}

}  // namespace oriel
