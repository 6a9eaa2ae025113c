#include "io/records/truth.h"
#include "tests/support/boxes.h"
#include "tests/support/corpus.h"
#include "tests/support/generated.h"
#include "tests/support/segmented.h"

#include <map>
#include <ranges>

#include <doctest/doctest.h>

namespace oriel {
namespace {

/// Whether a feature has this box at IoU 0.8, the boxes as they are, in the input's coordinates.
bool has_feature_in(const test::Segmented& s, const Box& box) {
  return std::ranges::any_of(s.segmentation.features, [&](const Feature& f) {
    return test::iou_of(f.box.moved(s.building.frame.origin_m), box) >= 0.8;
  });
}

/// Objects of a class, and how many of them a feature has the box of.
struct Recall {
  int objects = 0, found = 0;
};

/// Looks for every object that is in the shell (openings: and recessed) among all features of its
/// building.
void count(const test::Segmented& s, const GroundTruth& truth,
           std::map<std::string, Recall>& recalls) {
  for (const TruthObject& object : truth.objects) {
    if (object.faces.empty() || object.is_detectable == false) continue;
    const Box box = object.feature_aabb.value_or(object.aabb);
    Recall& recall = recalls[object.label];
    ++recall.objects;
    recall.found += has_feature_in(s, box) ? 1 : 0;
  }
}

TEST_SUITE("kernel/segment") {
  TEST_CASE("every recessed window and door and chimney and dormer of random3dcity is a feature") {
    ORIEL_NEEDS_SHARED(shared);
    std::map<std::string, Recall> recalls;
    for (const std::string& file :
         test::files_in(shared / "data" / "random3dcity", ".truth.json")) {
      const GroundTruth truth = read_truth(file).value.value();
      Reader reader(file.substr(0, file.size() - std::string(".truth.json").size()) +
                    ".stripped.city.json");
      const test::Segmented s = test::segmented(reader.next()->value->buildings.at(0));
      CHECK(std::ranges::none_of(s.segmentation.cells, [](const Cell& cell) {
        return cell.flag == LeafFlag::cycle || cell.flag == LeafFlag::budget;
      }));
      count(s, truth, recalls);
    }
    for (const char* label : {"window", "door", "chimney", "dormer"}) {
      CAPTURE(std::string(label));
      CHECK(recalls[label].objects > 20);
      CHECK(recalls[label].found == recalls[label].objects);
      MESSAGE(std::string(label) << ": " << recalls[label].found << " of "
                                 << recalls[label].objects);
    }
  }

  TEST_CASE("of chimneys across a ridge and on an apex 99 in 100 are features") {
    using generator::ChimneyPlace;
    for (const ChimneyPlace place : {ChimneyPlace::ridge, ChimneyPlace::apex}) {
      generator::Options options;
      options.seed = 4;
      options.chimney = place;
      if (place == ChimneyPlace::apex) options.roof = generator::RoofKind::hip;
      Recall recall;
      for (int i = 0; i < 120; ++i) {
        const test::Generated house = test::generated(options, i);
        const auto is_chimney = [](const auto& object) {
          return object.first == generator::Class::chimney;
        };
        if (std::ranges::none_of(house.objects, is_chimney)) continue;
        const test::Segmented s = test::segmented(house.building);
        for (const auto& [kind, box] : std::views::filter(house.objects, is_chimney)) {
          ++recall.objects;
          recall.found += has_feature_in(s, box) ? 1 : 0;
        }
      }
      CAPTURE(place == ChimneyPlace::ridge);
      CHECK(recall.objects > 20);
      CHECK(100 * recall.found >= 99 * recall.objects);
      MESSAGE(recall.found << " of " << recall.objects);
    }
  }
}

}  // namespace
}  // namespace oriel
