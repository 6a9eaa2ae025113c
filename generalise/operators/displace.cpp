#include "generalise/operators/facade.h"
#include "generalise/operators/operators.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

namespace oriel {

namespace {

using detail::Extents;
using detail::Host;
using detail::Placed;

/// An opening of a facade.
struct FacadeMember {
  std::size_t member = 0;  ///< of the task
  Extents now{}, wished{};
  double depth_m = 0;
};

/// The openings of one facet.
class FacadeDisplacer {
 public:
  FacadeDisplacer(const Redrawing& task, Host host, std::vector<FacadeMember> members)
      : task_(task),
        host_(std::move(host)),
        room_(task.solid, task.segmentation, host_),
        members_(std::move(members)) {
    std::vector<Extents> boxes;
    for (const FacadeMember& one : members_) boxes.push_back(one.now);
    const std::vector<int> rows = room_.rows_of(boxes);
    for (std::size_t i = 0; i < members_.size(); ++i)
      movables_.push_back({members_[i].wished, rows[i]});
  }

  /// Puts them on the solid, or says which of them stay.
  void run(Placed& out) const {
    const detail::FacadePlaces found = room_.arrange(movables_, task_.gap_m());
    if (found.places.empty()) return leave_crowded(found, out);
    const bool had_none = out.left.empty();
    for (std::size_t i = 0; i < members_.size(); ++i)
      if (!is_moved(members_[i].now, found.places[i])) leave_as_it_is(i, out);
    if (had_none && !out.left.empty()) return;
    for (std::size_t i = 0; i < members_.size() && out.solid; ++i) {
      Placed placed = put(members_[i], found.places[i], found.clear_m[i], *out.solid);
      if (placed.solid)
        out.solid = std::move(placed.solid);
      else
        out.left.push_back({members_[i].member, std::move(placed.reason), false, {}});
    }
  }

 private:
  /// On the facade it has its distances; what is nearer lies behind the wall, such as a recess in
  /// the next wall, around the corner.
  [[nodiscard]] Placed put(const FacadeMember& one, const Extents& where, double clear_m,
                           const Solid& solid) const {
    const Feature& feature = task_.feature(one.member);
    Placed placed = place_like(solid, task_.segmentation, host_, where, one.depth_m, feature.sense,
                               clear_m, feature);
    for (const double share : {0.5, 0.25, 0.125})
      if (!placed.solid)
        placed = place_like(solid, task_.segmentation, host_, where, one.depth_m, feature.sense,
                            share * clear_m, feature);
    return placed;
  }

  static bool is_moved(const Extents& now, const Extents& then) {
    const double most = std::max({std::abs(now.u0 - then.u0), std::abs(now.u1 - then.u1),
                                  std::abs(now.v0 - then.v0), std::abs(now.v1 - then.v1)});
    return most > detail::kNoShift_m;
  }

  void leave_as_it_is(std::size_t i, Placed& out) const {
    out.left.push_back({members_[i].member, "there is room enough", true, {}});
  }

  /// All of the rows that crowd each other.
  void leave_crowded(const detail::FacadePlaces& found, Placed& out) const {
    std::set<int> rows;
    for (const std::size_t i : found.crowded) rows.insert(movables_[i].row);
    for (std::size_t i = 0; i < members_.size(); ++i)
      if (rows.contains(movables_[i].row))
        out.left.push_back(
            {members_[i].member,
             fmt::format("its wall has no room for the row: {:.2f} m are missing", found.lacking_m),
             false,
             {{}, found.beside}});
  }

  const Redrawing& task_;
  Host host_;
  detail::FacadeRoom room_;
  std::vector<FacadeMember> members_;
  std::vector<detail::Movable> movables_;
};

}  // namespace

Placed displace(const Redrawing& task) {
  const double to_m = task.number("to", 0);
  Placed out{task.solid, {}, false};
  std::map<FacetId, std::pair<Host, std::vector<FacadeMember>>> facades;
  for (std::size_t i = 0; i < task.steps.size(); ++i) {
    const auto host = task.host(i);
    if (!host) {
      out.left.push_back({i, "its wall is no longer found", false, {}});
      continue;
    }
    const Extents now = extents_of(*host, task.segmentation, task.feature(i));
    const auto depth_m = box_depth(*host, task.feature(i), now);
    if (!depth_m) {
      out.left.push_back(
          {i, "only recesses, blocks that are boxes and outlines can be displaced", false, {}});
      continue;
    }
    const double more = std::max(0.0, to_m - now.width());
    Extents wished = now;
    wished.u0 -= more / 2;
    wished.u1 += more / 2;
    facades.try_emplace(host->facet, *host, std::vector<FacadeMember>{})
        .first->second.second.push_back({i, now, wished, *depth_m});
  }
  for (auto& [facet, facade] : facades)
    FacadeDisplacer(task, std::move(facade.first), std::move(facade.second)).run(out);
  if (out.left.empty()) return out;
  out.solid.reset();
  out.reason = out.left.front().reason;
  return out;
}

}  // namespace oriel
