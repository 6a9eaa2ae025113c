#include "interpret/relabelling/changed_pack.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <set>

namespace oriel::rules {

namespace {

template <class T>
void erase_at(std::vector<T>& list, int i) {
  list.erase(list.begin() + i);
}

}  // namespace

void ChangedPack::undo() {
  for (const auto& [param, value] : change_.params) pack_.set(param, base_->params[param].value);
  if (change_.without.empty()) return;
  Pack& pack = pack_.pack();
  pack.decide = base_->decide;
  for (const DroppedPart& part : change_.without) {
    if (part.owner < 0) continue;
    if (part.kind == DroppedPart::Kind::typical)
      pack.classes[at(part.owner)].typical = base_->classes[at(part.owner)].typical;
    else
      pack.rules[at(part.owner)] = base_->rules[at(part.owner)];
  }
  pack.code.resize(base_->code.size());
}

/// From the last of an owner to the first, so that those before keep their numbers.
void ChangedPack::become(const PackChange& change) {
  undo();
  change_ = change;
  for (const auto& [param, value] : change_.params) pack_.set(param, value);
  std::ranges::sort(change_.without, [](const DroppedPart& p, const DroppedPart& q) {
    return std::pair(p.item, p.part) > std::pair(q.item, q.part);
  });
  for (const DroppedPart& part : change_.without) drop(part);
}

void ChangedPack::drop(const DroppedPart& part) {
  using Kind = DroppedPart::Kind;
  Pack& pack = pack_.pack();
  switch (part.kind) {
    case Kind::rule:
      // Any of no conditions: never.
      pack.code.push_back({.op = Op::any_of, .type = Type::yes_no});
      pack.rules[at(part.owner)].require = {static_cast<ExprId>(pack.code.size()) - 1};
      break;
    case Kind::condition:
      drop_condition(part);
      break;
    case Kind::veto:
      erase_at(pack.rules[at(part.owner)].unless, part.item);
      break;
    case Kind::score_term:
      erase_at(pack.rules[at(part.owner)].score, part.item);
      break;
    case Kind::evidence:
      pack.decide.evidence = {};
      break;
    case Kind::company:
      if (pack.decide.evidence.is_written()) erase_at(pack.decide.evidence.company, part.item);
      break;
    case Kind::typical:
      erase_at(pack.classes[at(part.owner)].typical, part.item);
      break;
  }
}

void ChangedPack::drop_condition(const DroppedPart& part) {
  Pack& pack = pack_.pack();
  auto& require = pack.rules[at(part.owner)].require;
  if (part.part < 0) return erase_at(require, part.item);
  Expr rest = pack.code[at(require[at(part.item)])];
  erase_at(rest.args, part.part);
  if (rest.args.empty()) return erase_at(require, part.item);
  pack.code.push_back(std::move(rest));
  require[at(part.item)] = static_cast<ExprId>(pack.code.size()) - 1;
}

}  // namespace oriel::rules
