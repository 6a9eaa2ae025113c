#include "kernel/literal/body_view.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>
#include <unordered_map>
#include <utility>

namespace oriel::literal {

namespace {

/// Words of a set, and reflex edges, that take as long to look at as a region.
constexpr std::ptrdiff_t kWordsPerStep = 8, kEdgesPerStep = 4;

}  // namespace

BodyView::BodyView(const PlaneArrangement& arrangement, const Bits& body, Work& work)
    : arrangement_(arrangement), work_(work) {
  find_planes(body);
  group_regions(body);
  find_reflex_edges(body);
}

void BodyView::find_planes(const Bits& body) {
  std::map<std::pair<int, bool>, double> areas;
  for (const Partition& p : arrangement_.partitions) {
    const bool is_behind = body.has(p.behind), is_before = body.has(p.before);
    if (is_behind != is_before) areas[{p.plane, is_behind}] += p.area_m2;
  }
  work_.add(std::ssize(arrangement_.partitions));
  std::map<std::array<std::int64_t, 3>, int> classes;
  for (const auto& [key, area_m2] : areas) {
    const auto [number, is_along] = key;
    const Plane& plane = arrangement_.planes[at(number)];
    auto coefficients = plane.coefficients;
    if (!is_along)
      for (std::int64_t& c : coefficients) c = -c;
    const int normal_class =
        classes.emplace(coefficients, static_cast<int>(classes.size())).first->second;
    planes_.push_back({number, is_along, is_along ? plane.normal : -plane.normal,
                       is_along ? plane.offset_m : 0 - plane.offset_m, area_m2, normal_class});
  }
  std::ranges::sort(planes_, [](const SplitPlane& p, const SplitPlane& q) {
    return std::tuple(p.normal.x, p.normal.y, p.normal.z, p.offset_m) >
           std::tuple(q.normal.x, q.normal.y, q.normal.z, q.offset_m);
  });
}

void BodyView::group_regions(const Bits& body) {
  const std::size_t count = arrangement_.regions.size();
  Bits own(arrangement_.planes.size());
  for (const SplitPlane& split : planes_) own.add(split.plane);
  std::unordered_map<Bits, int, Bits::Hash> group_of;
  std::vector<Bits> front;
  for (std::size_t r = 0; r < count; ++r) {
    const SpaceRegion& region = arrangement_.regions[r];
    Bits key = region.front;
    key &= own;
    const auto [entry, is_new] = group_of.emplace(key, static_cast<int>(groups_.size()));
    if (is_new) {
      groups_.push_back({{}, 0, false, body.has(static_cast<int>(r))});
      front.push_back(key);
    }
    RegionGroup& group = groups_[at(entry->second)];
    group.regions.push_back(static_cast<int>(r));
    group.volume_m3 += region.volume_m3;
    group.is_endless = group.is_endless || region.is_endless;
    group_of_region_.push_back(entry->second);
  }
  work_.add(static_cast<std::int64_t>(count));

  solid_ = air_ = endless_ = Bits(groups_.size());
  for (int g = 0; g < std::ssize(groups_); ++g) {
    (groups_[at(g)].is_solid ? solid_ : air_).add(g);
    if (groups_[at(g)].is_endless) endless_.add(g);
  }
  for (const SplitPlane& split : planes_) {
    Bits& behind = behind_.emplace_back(groups_.size());
    for (int g = 0; g < std::ssize(groups_); ++g)
      if (front[at(g)].has(split.plane) != split.is_along) behind.add(g);
  }

  link_groups(own);
  is_marked_.assign(groups_.size(), 0);
  lump_of_group_.assign(groups_.size(), -1);
}

/// Two groups share one plane, and there perhaps several partitions.
void BodyView::link_groups(const Bits& own) {
  links_.resize(groups_.size());
  const auto add = [&](int from, int to, const Partition& p) {
    std::vector<Link>& links = links_[at(from)];
    const auto known = std::ranges::find(links, to, &Link::to);
    if (known != links.end())
      known->area_m2 += p.area_m2;
    else
      links.push_back({to, p.plane, p.area_m2});
  };
  for (const Partition& p : arrangement_.partitions) {
    if (!own.has(p.plane)) continue;
    const int a = group_of_region_[at(p.behind)], b = group_of_region_[at(p.before)];
    add(a, b, p);
    add(b, a, p);
  }
}

/// Around an edge that m planes meet in there are 2m sectors. More than m of them in the body: its
/// angle there is larger than 180°.
void BodyView::find_reflex_edges(const Bits& body) {
  for (const RegionsAtEdge& around : arrangement_.edges) {
    work_.add(std::ssize(around));
    const auto solid = std::ranges::count_if(around, [&](int r) { return body.has(r); });
    if (2 * solid <= std::ssize(around) || solid == std::ssize(around)) continue;
    std::vector<int>& air = reflex_edges_.emplace_back();
    for (const int r : around)
      if (!body.has(r)) air.push_back(group_of_region_[at(r)]);
    std::ranges::sort(air);
    air.erase(std::unique(air.begin(), air.end()), air.end());
  }
  std::ranges::sort(reflex_edges_);
  reflex_edges_.erase(std::unique(reflex_edges_.begin(), reflex_edges_.end()), reflex_edges_.end());
}

void BodyView::mark(const Bits& groups) {
  groups.for_each([&](int g) { is_marked_[at(g)] = 1; });
}

const std::vector<int>& BodyView::take_piece(int start) {
  piece_.assign(1, start);
  is_marked_[at(start)] = 0;
  for (std::size_t i = 0; i < piece_.size(); ++i)
    for (const Link& link : links_[at(piece_[i])]) {
      if (is_marked_[at(link.to)] == 0) continue;
      is_marked_[at(link.to)] = 0;
      piece_.push_back(link.to);
    }
  work_.add(std::ssize(piece_));
  return piece_;
}

std::vector<LiteralLump> BodyView::protrusions(int split) {
  Bits front = solid_;
  front -= behind_[at(split)];
  mark(front);
  std::vector<LiteralLump> lumps;
  const std::array<int, 1> splits{split};
  front.for_each([&](int g) {
    if (is_marked_[at(g)] == 0) return;
    LiteralLump lump = lump_of(take_piece(g), splits, false);
    if (lump.new_area_m2[0] > 0) lumps.push_back(std::move(lump));
  });
  return lumps;
}

std::vector<LiteralLump> BodyView::holes(std::span<const int> splits) {
  Bits space = air_;
  for (const int split : splits) space &= behind_[at(split)];
  work_.add(std::ssize(splits) * std::ssize(space.words()) / kWordsPerStep);
  mark(space);
  take_endless(space);
  std::vector<LiteralLump> lumps;
  space.for_each([&](int g) {
    if (is_marked_[at(g)] != 0) lumps.push_back(lump_of(take_piece(g), splits, true));
  });
  return lumps;
}

void BodyView::take_endless(Bits space) {
  space &= endless_;
  space.for_each([&](int g) {
    if (is_marked_[at(g)] != 0) take_piece(g);
  });
}

std::vector<LiteralLump> BodyView::cavities() {
  mark(air_);
  take_endless(air_);
  std::vector<LiteralLump> found;
  air_.for_each([&](int g) {
    if (is_marked_[at(g)] != 0) found.push_back(lump_of(take_piece(g), {}, true));
  });
  return found;
}

Bits BodyView::regions_of(const LiteralLump& lump) const {
  Bits regions(arrangement_.regions.size());
  for (const int g : lump.groups)
    for (const int r : groups_[at(g)].regions) regions.add(r);
  return regions;
}

/// New area is where a lump of air meets air in front of a split plane, or a lump of the body meets
/// the body behind it.
LiteralLump BodyView::lump_of(const std::vector<int>& piece, std::span<const int> splits,
                              bool is_hole) {
  LiteralLump lump;
  lump.groups = piece;
  lump.new_area_m2.resize(splits.size());
  const int mine = lumps_++;
  for (const int g : piece) {
    lump.volume_m3 += groups_[at(g)].volume_m3;
    lump_of_group_[at(g)] = mine;
  }
  for (const int g : piece)
    for (const Link& link : links_[at(g)]) {
      if (lump_of_group_[at(link.to)] == mine) continue;
      if (groups_[at(link.to)].is_solid == is_hole) continue;
      for (std::size_t s = 0; s < splits.size(); ++s)
        if (planes_[at(splits[s])].plane == link.plane &&
            behind_[at(splits[s])].has(link.to) != is_hole)
          lump.new_area_m2[s] += link.area_m2;
    }
  work_.add(std::ssize(piece));
  if (is_hole) lump.has_reflex_edge = has_reflex_edge(piece);
  return lump;
}

bool BodyView::has_reflex_edge(const std::vector<int>& piece) {
  const int mine = lump_of_group_[at(piece[0])];
  work_.add(std::ssize(reflex_edges_) / kEdgesPerStep);
  return std::ranges::any_of(reflex_edges_, [&](const std::vector<int>& air) {
    return std::ranges::all_of(air, [&](int g) { return lump_of_group_[at(g)] == mine; });
  });
}

}  // namespace oriel::literal
