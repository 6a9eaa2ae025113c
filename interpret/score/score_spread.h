#pragma once

#include "interpret/score/score.h"

#include <cstddef>
#include <map>
#include <random>
#include <string>
#include <vector>

namespace oriel {

/// A class as it would be found if only predictions of at least that score were there.
struct CurvePoint {
  double threshold = 0;
  std::string label;
  ClassScore counts;
};

/// The precision-recall curve of every class: for each score that a prediction has, the highest
/// first, each class that the truth or the predictions have. Predictions are matched anew at each
/// threshold, by the rules of score().
std::vector<CurvePoint> precision_recall_curve(const std::vector<Prediction>& predictions,
                                               const std::vector<ExpectedObject>& truth,
                                               const ScoreOptions& options = {});

/// Where 95 % of the resampled values lie; NaN without any.
struct ConfidenceInterval {
  double low = 0;
  double high = 0;
};

/// The middle 95 % of values, of which NaN is none: quantiles that are values, the outer one where
/// they lie between two.
ConfidenceInterval middle_of(std::vector<double> values);

/// Draws buildings with replacement, always in the same way.
class BuildingDraws {
 public:
  /// `buildings`: at least 1.
  explicit BuildingDraws(std::size_t buildings) : buildings_(buildings) {}
  /// 0 … buildings - 1.
  std::size_t next() { return generator_() % buildings_; }

 private:
  std::size_t buildings_;
  /// Any number does; it is fixed, so that the same records give the same intervals.
  std::mt19937_64 generator_{2004};
};

struct Intervals {
  std::size_t samples = 0;
  std::map<std::string, ConfidenceInterval> f1;
  ConfidenceInterval macro_f1;
};

/// 95 % percentile intervals of F1 by the bootstrap over buildings (Efron and Tibshirani 1993,
/// section 13.3): as many buildings as there are, drawn with replacement, `samples` (at least 1)
/// times. The draws depend on nothing but the number of buildings. Where a class does not occur in
/// a sample, that sample says nothing of it.
Intervals bootstrap(const std::map<std::string, Score>& buildings, std::size_t samples);

/// For a terminal, a line a class; and `"intervals":{…}` for to_json (docs/formats.md).
std::string to_text(const Intervals& intervals);
/// `[low,high]`, as JSON.
std::string interval_json(const ConfidenceInterval& interval);
std::string intervals_json(const Intervals& intervals);

}  // namespace oriel
