#include "oriel/explain.h"
#include "oriel/label.h"
#include "oriel/write.h"
#include "tests/fuzz/support/bodies.h"
#include "tests/fuzz/support/pack.h"
#include "tests/fuzz/support/promises.h"
#include "tests/fuzz/support/retold.h"
#include "tests/fuzz/targets.h"
#include "tests/support/changed.h"

#include <string>
#include <vector>

namespace oriel::fuzz {

namespace {

PipelineResult labelled(const Building& building, bool ignores_semantics = false) {
  LabelOptions options;
  options.measures_surfaces = true;
  options.ignores_semantics = ignores_semantics;
  PipelineResult result = oriel::label(building, default_pack(), options);
  promise_no_fault(result.issues);
  promise(result.is_done() || has_errors(result.issues), "labels or an error");
  if (result.is_done())
    promise(result.interpretation.verdicts.size() == result.segmentation->features.size(),
            "each feature has a verdict");
  return result;
}

void check_records(const Building& building, const PipelineResult& result) {
  (void)FeatureRecordWriter::text(RecordFormat::csv, feature_records(building, result));
  if (result.is_done()) (void)explain_features(result, default_pack());
  if (result.has_surfaces()) (void)explain_surfaces(building, result, default_pack());
}

/// What was written, read and labelled again, has the labels that are in it. Names of surfaces
/// delimit imprints, so they are not looked at: there were none before.
void check_emitted(const Document& document, const PipelineResult& result) {
  OutputRecord output;
  add(result.output, output);
  const auto again = document_of(write(document, output));
  promise(again.has_value(), "a labelled file can be read");
  const PipelineResult twice = labelled(again->buildings[0], true);
  promise(result.is_done() == twice.is_done(), "a labelled file can be labelled");
  promise(labels_of(result) == labels_of(twice), "a labelled file gets the labels that are in it",
          joined(labels_of(result)) + " / " + joined(labels_of(twice)));
}

void check_retold(const PipelineResult& result, const Building& other, const char* how) {
  const PipelineResult again = labelled(other);
  promise(labels_of(again) == labels_of(result),
          "a valid body told differently has the same labels",
          std::string(how) + ": " + joined(labels_of(result)) + " / " + joined(labels_of(again)));
}

/// Of the features that cuts and rings show: triangles have no outlines of flush openings.
std::vector<std::string> labels_but_of_imprints(const PipelineResult& result) {
  std::vector<std::string> labels = labels_of(result);
  std::erase_if(labels, [](const std::string& label) { return label.starts_with("imprint"); });
  return labels;
}

void check_in_triangles(const PipelineResult& result, const Building& building) {
  const auto labels = labels_but_of_imprints(result);
  const auto again = labels_but_of_imprints(labelled(cut_into_triangles(building)));
  promise(labels == again, "a valid body in triangles has the same labels",
          joined(labels) + " / " + joined(again));
}

}  // namespace

/// label, with reasons and records. Turning, moving, shuffling and cutting into triangles must
/// change no label on bodies that are valid and exact.
void labels(std::string_view input) {
  ByteSource bytes(input);
  const double scale_m = bytes.flag() ? kUnit_m : 0.001;
  const Body body = changed_body(bytes);
  const auto document = document_of(cityjson_of(body.building, scale_m));
  if (!document) return;
  const PipelineResult result = labelled(document->buildings[0]);
  check_records(document->buildings[0], result);
  check_emitted(*document, result);
  if (!body.is_valid) return;
  const PipelineResult exact = labelled(body.building);
  check_retold(exact, turned_by_right_angle(body.building), "turned");
  check_retold(exact, moved_by_metres(body.building), "moved");
  check_retold(exact, test::shuffled(body.building, 1), "shuffled");
  check_in_triangles(exact, body.building);
}

}  // namespace oriel::fuzz
