#include "examples/generator/english/english_plan.h"

#include <array>
#include <utility>

// Where sizes come from (docs/generator.md has the addresses):
//   [brick]    BS 4729: bricks of 215 x 102.5 x 65 mm, with joints 225 x 112.5 x 75
//   [1774]     Fires Prevention (Metropolis) Act 1774 and its forerunner of 1709: windows half a
//              brick, about 4 inches, behind the wall
//   [K]        Approved Document K (2013), table 1.1: rise 150 to 220 mm, going 220 to 300 mm, out
//              of doors at least 280 mm
//   [J]        Approved Document J: flues at the ridge end at least 600 mm above it
//   [doors]    Vivid Doors, standard external doors: 762 and 838 x 1981, 813 x 2032, 864 x 2082
//   [sash]     Everest, standard sash windows: 914, 1219 wide; 914, 1219, 1524 high
//   [casement] Everest, standard uPVC windows: 488 to 1770 wide, 450 to 1500 high
//   [plots]    Kings Heath Architects on terraces: plots of 10 to 15 feet; here up to 18
//   [yards]    house-extension.info, Victorian terraces: back additions leave 1.2 to 2 m of yard
//   [pots]     aboc.co.uk, cannon head chimney pots: 300, 450, 600 mm high
// Sizes without a source are the author's estimates.

namespace oriel::generator {
namespace {

/// Draws one plan, kind by kind.
class EnglishDraw {
 public:
  explicit EnglishDraw(Random& random) : random_(random) {}

  EnglishPlan draw();

 private:
  Um length(Um low, Um high, Um step = 10'000) { return random_.between(low, high, step); }
  bool chance(double probability) { return random_.chance(probability); }
  template <std::size_t N>
  Um one_of(const std::array<Um, N>& sizes) {
    return sizes[static_cast<std::size_t>(random_.below(static_cast<int>(N)))];
  }

  void draw_terrace();
  void draw_semi();
  void draw_town();
  void draw_flats();
  /// Floors from the steps before the door and the height of each storey.
  void raise(int steps, Um rise, const std::vector<Um>& storeys);
  void draw_stack(int most_rows);
  void draw_door(double fanlight);
  void draw_bay(double share, int most_storeys, double canted, const Range<Um>& width);

  Random& random_;
  EnglishPlan plan_;
};

void EnglishDraw::raise(int steps, Um rise, const std::vector<Um>& storeys) {
  plan_.steps = steps;
  plan_.floors = {steps * rise};
  for (const Um storey : storeys) plan_.floors.push_back(plan_.floors.back() + storey);
}

/// Stacks of whole and half bricks: a flue of 225 mm between walls of half a brick [brick].
void EnglishDraw::draw_stack(int most_rows) {
  StackPlan& stack = plan_.stack;
  stack.columns = random_.between(1, 2);
  stack.rows = random_.between(1, most_rows);
  stack.width = stack.columns * 340_mm + 120_mm;
  stack.length = stack.rows * 340_mm + 120_mm;
  stack.over_ridge = length(600_mm, 1300_mm);                 // [J]
  const Um pot = one_of(std::array{300_mm, 450_mm, 600_mm});  // [pots]
  if (chance(0.85)) stack.pot = pot;
}

void EnglishDraw::draw_door(double fanlight) {
  struct Leaf {
    Um width, height;
  };
  constexpr std::array<Leaf, 4> leaves{
      {{762_mm, 1981_mm}, {838_mm, 1981_mm}, {813_mm, 2032_mm}, {864_mm, 2082_mm}}};  // [doors]
  const Leaf leaf = leaves[static_cast<std::size_t>(random_.below(4))];
  plan_.entrance.leaf_width = leaf.width;
  plan_.entrance.leaf_height = leaf.height;
  if (chance(fanlight)) plan_.entrance.fanlight = length(250_mm, 400_mm);
}

void EnglishDraw::draw_bay(double share, int most_storeys, double canted, const Range<Um>& width) {
  if (!chance(share)) return;
  plan_.bay.storeys = random_.between(1, most_storeys);
  plan_.bay.depth = length(500_mm, 800_mm);
  plan_.bay.width = length(width.low, width.high, 20_mm);
  plan_.bay.is_canted = chance(canted);
}

void EnglishDraw::draw_terrace() {
  plan_.dwellings = random_.between(2, 5);
  plan_.frontage = length(4200_mm, 5500_mm, 100_mm);  // [plots]
  plan_.depth = length(7600_mm, 8800_mm, 20_mm);
  std::vector<Um> storeys{length(2850_mm, 3100_mm), length(2700_mm, 2900_mm)};
  if (chance(0.2)) storeys.push_back(length(2600_mm, 2750_mm));
  const int steps = random_.between(1, 3);
  raise(steps, length(150_mm, 180_mm), storeys);  // [K]
  plan_.slope = {random_.between(13, 18) * 50};
  if (chance(0.45)) plan_.upstand = length(300_mm, 400_mm);
  plan_.glazing = chance(0.7) ? Glazing::sash : chance(0.5) ? Glazing::barred : Glazing::plain;
  plan_.window_width = length(914_mm, 1100_mm, 1_mm);  // [sash]
  plan_.reveal = 103_mm;                               // [brick] [1774]
  if (chance(0.85)) plan_.sill = 75_mm;
  if (chance(0.6)) plan_.lintel = one_of(std::array{150_mm, 225_mm});
  draw_bay(0.65, 2, 0.75, {2000_mm, 2500_mm});
  draw_door(0.85);
  if (chance(0.5))
    plan_.entrance.porch = length(450_mm, 900_mm);
  else if (chance(0.3))
    plan_.entrance.hood = chance(0.5) ? Hood::slab : Hood::gabled;
  draw_stack(4);
  if (chance(0.75)) plan_.yard = length(1300_mm, 2000_mm);  // [yards]
  plan_.addition_length = length(2800_mm, 4600_mm);
  plan_.has_bands = chance(0.3);
}

void EnglishDraw::draw_semi() {
  plan_.dwellings = 2;
  plan_.frontage = length(6000_mm, 7200_mm, 100_mm);
  plan_.depth = length(7600_mm, 8800_mm, 20_mm);
  const std::vector<Um> storeys{length(2600_mm, 2700_mm), length(2550_mm, 2650_mm)};
  const int steps = random_.between(1, 2);
  raise(steps, length(150_mm, 180_mm), storeys);  // [K]
  plan_.roof = chance(0.7) ? RoofKind::hip : RoofKind::gable;
  plan_.slope = {random_.between(15, 20) * 50};
  plan_.overhang = length(200_mm, 350_mm, 50_mm);
  plan_.glazing = chance(0.75) ? Glazing::casement : Glazing::plain;
  plan_.window_width = one_of(std::array{1200_mm, 1770_mm});  // [casement]
  plan_.reveal = length(50_mm, 103_mm, 1_mm);
  if (chance(0.8)) plan_.sill = 75_mm;
  draw_bay(0.85, 2, 0.6, {2400_mm, 3000_mm});
  draw_door(0.4);
  if (chance(0.35))
    plan_.entrance.porch = length(600_mm, 1000_mm);
  else if (chance(0.75))
    plan_.entrance.hood = chance(0.6) ? Hood::slab : Hood::gabled;
  draw_stack(2);
  plan_.has_garages = chance(0.45);
}

void EnglishDraw::draw_town() {
  plan_.dwellings = random_.between(1, 4);
  plan_.frontage = length(5000_mm, 6000_mm, 100_mm);
  plan_.depth = length(8000_mm, 9200_mm, 20_mm);
  const std::vector<Um> storeys{length(3000_mm, 3300_mm), length(3200_mm, 3500_mm),
                                length(2500_mm, 2800_mm)};
  const int steps = random_.between(4, 7);
  raise(steps, length(150_mm, 180_mm), storeys);  // [K]
  plan_.slope = {random_.between(11, 16) * 50};
  plan_.parapet = length(600_mm, 900_mm);
  if (chance(0.8)) plan_.upstand = length(300_mm, 450_mm);
  plan_.glazing = chance(0.5) ? Glazing::barred : Glazing::sash;
  plan_.window_width = length(1000_mm, 1219_mm, 1_mm);  // [sash]
  plan_.reveal = length(103_mm, 150_mm, 1_mm);          // [1774]
  if (chance(0.7)) plan_.sill = 75_mm;
  draw_door(1);
  plan_.entrance.has_pilasters = chance(0.6);
  if (chance(0.4)) plan_.entrance.hood = Hood::slab;
  draw_stack(5);
  if (chance(0.5)) plan_.yard = plan_.frontage - length(2000_mm, 2600_mm);
  plan_.addition_length = length(2000_mm, 3200_mm);
  plan_.has_balconies = chance(0.7);
  plan_.has_cellar = plan_.floor(0) >= 900_mm && chance(0.8);
  plan_.has_bands = chance(0.5);
}

void EnglishDraw::draw_flats() {
  plan_.dwellings = 2;
  plan_.frontage = length(7200_mm, 9600_mm, 100_mm);
  plan_.depth = length(9600_mm, 12000_mm, 20_mm);
  const Um storey = length(2950_mm, 3200_mm);
  const int storeys = random_.between(3, 4), steps = random_.between(1, 4);
  raise(steps, length(150_mm, 170_mm), std::vector<Um>(static_cast<std::size_t>(storeys), storey));
  plan_.roof = chance(0.6) ? RoofKind::flat : RoofKind::gable;
  const int slope = random_.between(14, 18) * 50;
  const Um parapet = length(450_mm, 1100_mm);
  if (plan_.roof == RoofKind::gable)
    plan_.slope = {slope};
  else
    plan_.parapet = parapet;
  plan_.glazing = chance(0.6) ? Glazing::sash : Glazing::casement;
  plan_.window_width = plan_.glazing == Glazing::sash ? 1219_mm : 1200_mm;  // [sash] [casement]
  plan_.reveal = 103_mm;
  if (chance(0.8)) plan_.sill = 75_mm;
  if (chance(0.4)) plan_.lintel = 150_mm;
  draw_bay(0.7, 1, 0.7, {2400_mm, 3000_mm});
  if (plan_.bay.storeys > 0) plan_.bay.storeys = storeys;
  draw_door(0.7);
  if (chance(0.6)) plan_.entrance.hood = Hood::slab;
  draw_stack(4);
}

EnglishPlan EnglishDraw::draw() {
  const int kind = random_.below(20);
  plan_.kind = kind < 9    ? EnglishKind::terrace
               : kind < 14 ? EnglishKind::semi
               : kind < 18 ? EnglishKind::town
                           : EnglishKind::flats;
  switch (plan_.kind) {
    case EnglishKind::terrace:
      draw_terrace();
      break;
    case EnglishKind::semi:
      draw_semi();
      break;
    case EnglishKind::town:
      draw_town();
      break;
    case EnglishKind::flats:
      draw_flats();
      break;
  }
  return std::move(plan_);
}

}  // namespace

EnglishPlan draw_english_plan(const Options& options, Random& random) {
  EnglishPlan plan = EnglishDraw(random).draw();
  plan.flush = options.flush;
  plan.jitter = options.jitter;
  return plan;
}

}  // namespace oriel::generator
