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

/// Gaps that would do are told to the centimetre.
constexpr double kGapStep_m = 0.01;

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
    if (!found.has_room()) return leave_crowded(found, out);
    const std::size_t before = out.left.size();
    for (std::size_t i = 0; i < members_.size(); ++i)
      if (!detail::is_moved(members_[i].now, found.places[i])) leave_as_it_is(i, out);
    if (out.left.size() > before) return;  // the others are tried again without them
    for (std::size_t i = 0; i < members_.size() && out.solid; ++i) {
      const FacadeMember& one = members_[i];
      Placed placed = put_on_facade(*out.solid, task_.segmentation, host_, found.places[i],
                                    one.depth_m, found.clear_m[i], task_.feature(one.member));
      if (placed.solid)
        out.solid = std::move(placed.solid);
      else
        out.left.push_back({one.member, std::move(placed.reason), false, {}});
    }
  }

 private:
  void leave_as_it_is(std::size_t i, Placed& out) const {
    out.left.push_back({members_[i].member, "there is room enough", true, {}});
  }

  /// All of the rows that crowd each other.
  void leave_crowded(const detail::FacadePlaces& found, Placed& out) const {
    std::set<int> rows;
    for (const std::size_t i : found.crowded) rows.insert(movables_[i].row);
    Hindrance hindrance{{}, found.beside};
    if (task_.tells_needs) add_needs(rows, hindrance);
    for (std::size_t i = 0; i < members_.size(); ++i)
      if (rows.contains(movables_[i].row))
        out.left.push_back(
            {members_[i].member,
             fmt::format("its wall has no room for the row: {:.2f} m are missing", found.lacking_m),
             false, hindrance});
  }

  /// With what gap the rows would have room, and how many of them would have to go.
  void add_needs(const std::set<int>& rows, Hindrance& out) const {
    std::vector<detail::Movable> some;
    for (const detail::Movable& one : movables_)
      if (rows.contains(one.row)) some.push_back(one);
    const double gap_m = task_.gap_m();
    double good_m = 0, bad_m = gap_m;
    while (bad_m - good_m > kGapStep_m) {
      const double middle_m = (good_m + bad_m) / 2;
      (room_.arrange(some, middle_m).has_room() ? good_m : bad_m) = middle_m;
    }
    if (good_m > 0) out.needs.push_back({"gap", gap_m - good_m, good_m});
    const std::size_t all = some.size();
    for (auto left = room_.arrange(some, gap_m); !left.has_room();
         left = room_.arrange(some, gap_m))
      some.erase(some.begin() + static_cast<std::ptrdiff_t>(left.crowded[left.crowded.size() / 2]));
    out.needs.push_back(
        {"count", static_cast<double>(all - some.size()), static_cast<double>(some.size())});
  }

  const Redrawing& task_;
  Host host_;
  detail::FacadeRoom room_;
  std::vector<FacadeMember> members_;
  std::vector<detail::Movable> movables_;
};

}  // namespace

/// The operator `displace`: the openings of a facade move apart (paper 5.1, "displacement").
///
/// `{displace: {to: LENGTH, gap: LENGTH}}`: those of one wall plane, recessed, flush or proud, move
/// until `gap` lies between them, and between them and what else is on the wall and its ends; with
/// `to` they grow first, about their centres, to at least that width. Their order is kept, rows
/// stay rows, and the sum of the squared shifts is the least there is (FacadeRoom::arrange). Sizes
/// and depths stay. Takes some (OperatorScope::wall): an opening that need not move stays as it
/// is, as do those that have no room, which the others then keep off. Precondition: what moves is a
/// recess, a block that is a box, or an outline. Touches: the wall's facet. Inverse: omit, and the
/// openings that the segmentation still has.
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
    const Extents wished = grown(now, std::max(0.0, to_m - now.width()), 0);
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
