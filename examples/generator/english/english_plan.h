#pragma once

#include "examples/generator/options.h"
#include "examples/generator/random.h"

#include <vector>

namespace oriel::generator {

/// What is built: a row of brick houses of about 1870 to 1910, a pair of about 1935, a row of about
/// 1800 to 1840 behind a parapet, or a block of flats of about 1900.
enum class EnglishKind { terrace, semi, town, flats };

/// How a window is divided: one pane; two sashes, the lower one behind the upper one; sashes with a
/// glazing bar; casements under top lights.
enum class Glazing { plain, sash, barred, casement };

/// The bay beside each front door.
struct BayPlan {
  /// 0 = none.
  int storeys = 0;
  Um width = 0, depth = 0;
  /// Sides at 45°, else square.
  bool is_canted = true;
};

enum class Hood { none, slab, gabled };

struct EntrancePlan {
  Um leaf_width = 0, leaf_height = 0;
  /// Height of the glass over the door; 0 = none.
  Um fanlight = 0;
  /// How deep the door lies in a porch behind the wall; 0 = in the wall itself.
  Um porch = 0;
  Hood hood = Hood::none;
  bool has_pilasters = false;
};

/// A chimney stack; its flues stand in `columns` across the party wall and `rows` along it.
struct StackPlan {
  Um width = 0, length = 0, over_ridge = 0;
  int columns = 1, rows = 1;
  /// Height of the pots; 0 = open flues.
  Um pot = 0;
};

/// Everything about a row that is drawn before it is built. All its dwellings are alike, each
/// second one the other way round.
struct EnglishPlan {
  EnglishKind kind = EnglishKind::terrace;
  int dwellings = 1;
  Um frontage = 0, depth = 0;
  /// Height of each floor, then of the walls' top.
  std::vector<Um> floors;
  int steps = 0;
  RoofKind roof = RoofKind::gable;
  Slope slope;
  Um overhang = 0;
  /// Height of the parapet before the roof (town) or around it (flats).
  Um parapet = 0;
  /// How far party walls rise over the roof; 0 = they end below it.
  Um upstand = 0;
  Glazing glazing = Glazing::sash;
  Um window_width = 0, reveal = 0;
  /// Heights of stone sills and lintels; 0 = none that stick out.
  Um sill = 0, lintel = 0;
  BayPlan bay;
  EntrancePlan entrance;
  StackPlan stack;
  /// Width of the yard beside a back addition; 0 = the row has no back additions.
  Um yard = 0;
  Um addition_length = 0;
  bool has_balconies = false, has_cellar = false, has_garages = false, has_bands = false;
  double flush = 0;
  Um jitter = 0;

  [[nodiscard]] int storeys() const { return static_cast<int>(floors.size()) - 1; }
  [[nodiscard]] Um width() const { return dwellings * frontage; }
  [[nodiscard]] Um floor(int i) const { return floors[static_cast<std::size_t>(i)]; }
  [[nodiscard]] Um wall_height() const { return floors.back(); }
};

/// Draws a row; of the options, only `flush` and `jitter` count.
EnglishPlan draw_english_plan(const Options& options, Random& random);

}  // namespace oriel::generator
