#include "experiments/results/results.h"

namespace oriel {

std::string to_string(ExperimentPart part) {
  switch (part) {
    case ExperimentPart::sweep:
      return "sweep";
    case ExperimentPart::ablate:
      return "ablate";
    case ExperimentPart::compare:
      return "compare";
    case ExperimentPart::stability:
      return "stability";
    case ExperimentPart::learning_curve:
      return "learning_curve";
    case ExperimentPart::learn:
      break;
  }
  return "learn";
}

}  // namespace oriel
