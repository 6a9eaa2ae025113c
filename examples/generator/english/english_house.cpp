#include "examples/generator/english/english_house.h"

#include "examples/generator/english/english_flats.h"
#include "examples/generator/english/english_front.h"
#include "examples/generator/english/english_rear.h"
#include "examples/generator/english/english_roof.h"

namespace oriel::generator {

Body build_english_house(const Options& options, Random& random) {
  const EnglishPlan plan = draw_english_plan(options, random);
  Draft draft;
  const EnglishSite site{draft, plan, random};
  EnglishShell shell = build_english_shell(draft, plan);
  lay_out_english_roof(site, shell);
  if (plan.kind == EnglishKind::flats) {
    lay_out_flats(site, shell.house);
  } else {
    lay_out_english_front(site, shell.house);
    lay_out_english_rear(site, shell.house);
    lay_out_english_ends(site, shell.house);
  }
  Body body = draft.close();
  body.roof = name_of(plan.roof);
  body.storeys = plan.storeys();
  return body;
}

}  // namespace oriel::generator
