#include "oriel/corrections.h"

#include "tests/fuzz/support/scratch_file.h"
#include "tests/fuzz/targets.h"

namespace oriel::fuzz {

/// Followed on the two features of one building; as truth they are right.
void corrections(std::string_view bytes) {
  static const ScratchFile file("c.jsonl");
  try {
    auto read = read_corrections(file.write(bytes));
    for (const Issue& issue : read.issues) (void)to_string(issue);
    promise(read.value.has_value(), "a file of corrections has a value");
    for (Issue& issue : drop_unknown_classes(*read.value, {"door", "window"}))
      (void)to_string(issue);
    const std::vector<PlacedFeature> features = {{"f1", {{0, 0, 0}, {1, 1, 1}}},
                                                 {"f2", {{4, 0, 0}, {5, 0, 1}}}};
    const Corrections all(*read.value);
    std::vector<Issue> issues = all.unknown_buildings({"house"});
    const auto corrected = all.find("house", features, issues);
    for (const Issue& issue : issues) (void)to_string(issue);
    std::vector<Prediction> predictions;
    for (const auto& [feature, correction] : corrected)
      predictions.push_back(
          {"house", features[feature].id, correction->label, features[feature].box});
    const auto truth = objects_of_corrections("house", features, corrected, {});
    for (const auto& [label, counts] : score(predictions, truth).classes)
      promise(counts.false_positives == 0 && counts.false_negatives == 0,
              "what is corrected is right");
  } catch (const InputError& error) {
    (void)to_string(error.issue());
  }
}

}  // namespace oriel::fuzz
