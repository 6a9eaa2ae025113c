#pragma once

#include "oriel/learn.h"
#include "studio/session/labels/labelled_buildings.h"

#include <cstddef>
#include <memory>
#include <mutex>
#include <vector>

namespace oriel::studio {

/// The buildings as rules are measured on them; it never changes.
struct SampleList {
  std::vector<Sample> samples;
  /// By sample the number of its building.
  std::vector<std::size_t> numbers;
};

/// Buildings as samples, made when they are asked for first. May be used by several threads.
class SampleStore {
 public:
  /// Those that files or corrections say something of.
  std::shared_ptr<const SampleList> with_truth(const BuildingList& buildings,
                                               const TruthOfSession& truth);

 private:
  std::mutex mutex_;
  std::shared_ptr<const SampleList> list_;
  std::uint64_t truth_number_ = 0;
  BuildingList buildings_;
};

/// All that were segmented, without truth.
SampleList samples_of(const BuildingList& buildings);

}  // namespace oriel::studio
