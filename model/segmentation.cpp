#include "model/segmentation.h"

namespace oriel {

std::string to_string(Order order) { return order == Order::natural ? "natural" : "paper"; }

std::string to_string(Sense sense) {
  switch (sense) {
    case Sense::protrusion:
      return "protrusion";
    case Sense::hole:
      return "hole";
    case Sense::cavity:
      return "cavity";
    case Sense::imprint:
      return "imprint";
  }
  return "";
}

std::string to_string(LeafFlag flag) {
  switch (flag) {
    case LeafFlag::convex:
      return "convex";
    case LeafFlag::own:
      return "own";
    case LeafFlag::no_candidate:
      return "no-candidate";
    case LeafFlag::cycle:
      return "cycle";
    case LeafFlag::budget:
      return "budget";
    case LeafFlag::open:
      return "open";
  }
  return "";
}

}  // namespace oriel
