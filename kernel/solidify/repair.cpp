#include "kernel/solidify/repair.h"

namespace oriel {

std::string to_string(Closing closing) {
  switch (closing) {
    case Closing::none:
      return "none";
    case Closing::planar:
      return "planar";
    case Closing::any:
      return "any";
  }
  return "";
}

}  // namespace oriel
