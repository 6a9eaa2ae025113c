#include "studio/session/learning/sample_store.h"

#include <utility>

namespace oriel::studio {

namespace {

Sample sample_of(const OpenBuilding& open) {
  const Description& description = open.segmented.description;
  Sample sample{{description.table, description.graph}, {}, {}};
  for (const PlacedFeature& feature : open.features) sample.boxes.push_back(feature.box);
  return sample;
}

}  // namespace

SampleList samples_of(const BuildingList& buildings) {
  SampleList list;
  for (std::size_t number = 0; number < buildings.size(); ++number) {
    if (!buildings[number] || !buildings[number]->segmented.is_done()) continue;
    list.samples.push_back(sample_of(*buildings[number]));
    list.numbers.push_back(number);
  }
  return list;
}

std::shared_ptr<const SampleList> SampleStore::with_truth(const BuildingList& buildings,
                                                          const TruthOfSession& truth) {
  const std::lock_guard lock(mutex_);
  if (list_ && truth_number_ == truth.number && buildings_ == buildings) return list_;
  auto list = std::make_shared<SampleList>();
  for (std::size_t number = 0; number < buildings.size(); ++number) {
    if (!buildings[number] || !buildings[number]->segmented.is_done()) continue;
    auto objects = truth.of(*buildings[number]);
    if (!objects) continue;
    list->samples.push_back(sample_of(*buildings[number]));
    list->samples.back().truth = std::move(*objects);
    list->numbers.push_back(number);
  }
  truth_number_ = truth.number;
  buildings_ = buildings;
  list_ = std::move(list);
  return list_;
}

}  // namespace oriel::studio
