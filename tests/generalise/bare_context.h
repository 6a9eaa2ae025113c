#pragma once

#include "generalise/context.h"

#include <functional>
#include <utility>

namespace oriel::test {

/// To redraw a solid of which no more is known than its segmentation. Refers to both.
inline RedrawContext bare_context(const Solid& solid, const Segmentation& segmentation) {
  static const Building building;
  static const LabelledBuilding labelled;
  static const FeatureTable table("house", 0);
  static const Interpretation interpretation;
  return {building, labelled, solid, segmentation, table, interpretation};
}

/// A judge that asks a function.
class JudgeBy : public SolidJudge {
 public:
  explicit JudgeBy(std::function<Fitness(const Solid&)> fitness_of)
      : fitness_of_(std::move(fitness_of)) {}

  Fitness fitness_of(const Solid& solid) override { return fitness_of_(solid); }

 private:
  std::function<Fitness(const Solid&)> fitness_of_;
};

/// To it all that is closed is valid.
inline SolidJudge& any_closed() {
  static JudgeBy judge(
      [](const Solid& solid) { return is_closed(solid) ? Fitness::valid : Fitness::unfit; });
  return judge;
}

}  // namespace oriel::test
