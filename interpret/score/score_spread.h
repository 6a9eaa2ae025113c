#pragma once

#include "interpret/score/score.h"

#include <cstddef>
#include <map>
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
std::string intervals_json(const Intervals& intervals);

}  // namespace oriel
