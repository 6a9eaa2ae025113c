#include "model/repair.h"

namespace oriel {

std::string to_string(Closing closing) {
  switch (closing) {
    case Closing::none:
      return "none";
    case Closing::planar:
      return "planar";
    case Closing::ground:
      return "ground";
    case Closing::any:
      return "any";
  }
  return "";
}

std::string to_string(CapKind kind) {
  switch (kind) {
    case CapKind::hole:
      return "hole";
    case CapKind::ground:
      return "ground";
    case CapKind::wall:
      return "wall";
  }
  return "";
}

std::optional<Closing> parse_closing(std::string_view text) {
  for (const Closing closing : {Closing::none, Closing::planar, Closing::ground, Closing::any})
    if (to_string(closing) == text) return closing;
  return std::nullopt;
}

}  // namespace oriel
