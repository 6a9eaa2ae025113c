#include "io/records/truth.h"

#include "oriel/score.h"
#include "tests/fuzz/support/scratch_file.h"
#include "tests/fuzz/targets.h"

namespace oriel::fuzz {

namespace {

/// The truth against itself, found by somebody who found all of it.
void score_all(const std::vector<GroundTruth>& truths) {
  LabelsAndTruth all;
  std::vector<FeatureRecord> found;
  for (const GroundTruth& truth : truths) {
    add(truth, all);
    for (const TruthObject& object : truth.objects) {
      FeatureRecord& record = found.emplace_back();
      record.building = truth.building;
      record.id = object.id;
      record.label = object.label;
      record.score = 1;
      const Vec3 min = object.aabb.min, max = object.aabb.max;
      record.aabb_m = {min.x, min.y, min.z, max.x, max.y, max.z};
      record.source_polygons = object.faces;
    }
  }
  add(std::move(found), all);
  (void)score_by_building(all);
  (void)precision_recall_curve(all);
}

}  // namespace

/// The same bytes as one file and as one a line.
void truth(std::string_view bytes) {
  static const ScratchFile file("a.json"), lines("a.jsonl");
  for (const ScratchFile* one : {&file, &lines}) {
    try {
      const auto truths = read_truths(one->write(bytes));
      promise(truths.value || has_errors(truths.issues), "truth has a value or an error");
      for (const Issue& issue : truths.issues) (void)to_string(issue);
      if (truths.value) score_all(*truths.value);
    } catch (const InputError& error) {
      (void)to_string(error.issue());
    }
  }
}

}  // namespace oriel::fuzz
