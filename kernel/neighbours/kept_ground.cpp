#include "kernel/neighbours/kept_ground.h"

#include "kernel/base/sha256.h"
#include "kernel/geometry/boxes.h"
#include "kernel/geometry/shared_area.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

namespace oriel {

namespace {

using detail::PlanArea;

Box box_of_plan(std::span<const Outline> outlines) {
  Box box;
  for (const Outline& outline : outlines)
    for (const Vec3 p : outline) box.grow(Vec3{p.x, p.y, 0});
  return box;
}

}  // namespace

void KeptGround::add(PlanArea area) { areas_.push_back(std::move(area)); }

void KeptGround::finish() {
  std::vector<Box> boxes;
  std::string text;
  for (const PlanArea& area : areas_) {
    boxes.push_back(box_of_plan(area));
    box_.grow(boxes.back());
    for (const Outline& outline : area)
      for (const Vec3 p : outline) text += fmt::format("{} {},", p.x, p.y);
    text += '\n';
  }
  sha256_ = oriel::sha256(text);
  if (!boxes.empty()) tree_.emplace(std::move(boxes));
}

double KeptGround::under_m2(std::span<const Outline> figure, Vec3 origin_m) const {
  if (!tree_) return 0;
  std::vector<std::size_t> near;
  tree_->for_each_overlap(box_of_plan(figure).moved({origin_m.x, origin_m.y, 0}),
                          [&](int i) { near.push_back(static_cast<std::size_t>(i)); });
  std::ranges::sort(near);
  double sum_m2 = 0;
  for (const std::size_t i : near) {
    PlanArea moved = areas_[i];
    for (Outline& outline : moved)
      for (Vec3& p : outline) p = {p.x - origin_m.x, p.y - origin_m.y, 0};
    sum_m2 += shared_area_m2(figure, moved, {0, 0, 1});
  }
  return sum_m2;
}

}  // namespace oriel
