#include "generalise/operators/separate.h"

#include "kernel/base/index.h"
#include "kernel/base/issue.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace oriel {

namespace {

/// Separations that miss by no more hold. Sums of doubles along a wall of 1 km are off by 1e-12 m,
/// which must not count as missing, and callers ask for a millimetre more than they check
/// (kNoShift_m), so anything between would do.
constexpr double kHolds_m = 1e-6;
/// Steps for each separation after which something is wrong.
constexpr std::size_t kMostSteps = 100;

constexpr double kInfinite = std::numeric_limits<double>::infinity();

class DualActiveSet {
 public:
  DualActiveSet(const std::vector<double>& wished, const std::vector<Separation>& separations,
                const std::vector<double>& weights)
      : separations_(separations),
        places_(wished),
        weights_(weights.empty() ? std::vector<double>(wished.size(), 1) : weights),
        pull_(separations.size(), 0) {}

  Separated run() {
    const std::size_t most = kMostSteps * (separations_.size() + 1);
    for (std::size_t step = 0; step < most; ++step) {
      const int worst = most_violated();
      if (worst < 0) return {std::move(places_), {}, 0};
      if (!satisfy(at(worst))) return crowded(at(worst));
    }
    throw GeometryError("the places on a wall are not found");
  }

 private:
  /// What a violated separation pulls at: its trees, how each moves, and how the pull of the
  /// active separations changes, all per unit of its own pull.
  struct SolverDirection {
    std::vector<double> move;  ///< by place
    std::vector<double> pull;  ///< by separation
    double gain = 0;           ///< by which the separation grows
  };

  [[nodiscard]] double place(int i) const { return i == Separation::kFixed ? 0 : places_[at(i)]; }
  [[nodiscard]] double missing(std::size_t s) const {
    return separations_[s].least - (place(separations_[s].after) - place(separations_[s].before));
  }

  [[nodiscard]] bool is_active(std::size_t s) const {
    return std::ranges::binary_search(active_, s);
  }

  [[nodiscard]] int most_violated() const {
    int worst = -1;
    double most = kHolds_m;
    for (std::size_t s = 0; s < separations_.size(); ++s)
      if (missing(s) > most && !is_active(s)) {
        most = missing(s);
        worst = static_cast<int>(s);
      }
    return worst;
  }

  /// Pulls until the separation holds; active ones that come to pull the wrong way are let go.
  /// False if it cannot hold with the active ones.
  bool satisfy(std::size_t s) {
    while (true) {
      const SolverDirection along = direction(s);
      double step = along.gain > 0 ? missing(s) / along.gain : kInfinite;
      std::size_t slack = separations_.size();
      for (const std::size_t c : active_)
        if (along.pull[c] < 0 && -pull_[c] / along.pull[c] < step) {
          step = -pull_[c] / along.pull[c];
          slack = c;
        }
      if (step == kInfinite) return false;
      for (std::size_t i = 0; i < places_.size(); ++i) places_[i] += step * along.move[i];
      for (const std::size_t c : active_) pull_[c] = std::max(0.0, pull_[c] + step * along.pull[c]);
      pull_[s] += step;
      if (slack == separations_.size()) {
        active_.insert(std::ranges::upper_bound(active_, s), s);
        return true;
      }
      std::erase(active_, slack);
      pull_[slack] = 0;
    }
  }

  /// The places of a tree of active separations; what comes first is its root. A tree with the
  /// fixed place in it does not move.
  struct Tree {
    std::vector<int> places;          ///< parents first; kFixed may be among them
    std::vector<std::size_t> toward;  ///< the separation that leads to each, but for the root
    double weight = 0;
    [[nodiscard]] bool contains(int place) const {
      return std::ranges::find(places, place) != places.end();
    }
  };

  [[nodiscard]] Tree tree_at(int root) const {
    Tree tree{{root}, {separations_.size()}, 0};
    for (std::size_t next = 0; next < tree.places.size(); ++next)
      for (const std::size_t c : active_) {
        const auto [before, after, least] = separations_[c];
        if (c == tree.toward[next]) continue;
        if (before != tree.places[next] && after != tree.places[next]) continue;
        tree.places.push_back(before == tree.places[next] ? after : before);
        tree.toward.push_back(c);
      }
    const bool is_fixed = tree.contains(Separation::kFixed);
    for (const int i : tree.places) tree.weight += is_fixed ? kInfinite : weights_[at(i)];
    return tree;
  }

  /// From the leaves to the root: each separation passes on what its side needs.
  void share(const Tree& tree, int pulled, double sign, double speed, SolverDirection& out) const {
    std::vector<double> needs(tree.places.size(), 0);
    for (std::size_t i = tree.places.size(); i-- > 0;) {
      const int its = tree.places[i];
      if (its != Separation::kFixed) needs[i] += weights_[at(its)] * speed;
      if (its == pulled) needs[i] -= sign;
      if (i == 0) break;
      const Separation& leads = separations_[tree.toward[i]];
      const bool is_after = leads.after == its;
      out.pull[tree.toward[i]] += is_after ? needs[i] : -needs[i];
      const int parent = is_after ? leads.before : leads.after;
      needs[at(static_cast<int>(std::ranges::find(tree.places, parent) - tree.places.begin()))] +=
          needs[i];
    }
  }

  [[nodiscard]] SolverDirection direction(std::size_t s) const {
    SolverDirection out{std::vector<double>(places_.size(), 0),
                        std::vector<double>(separations_.size(), 0), 0};
    const auto [before, after, least] = separations_[s];
    // The fixed place is the root of its tree, as its needs are met by itself.
    const auto rooted = [&](int pulled) {
      Tree tree = tree_at(pulled);
      return tree.contains(Separation::kFixed) ? tree_at(Separation::kFixed) : tree;
    };
    const Tree low = rooted(before), high = rooted(after);
    if (low.contains(after)) {  // along a way that is tight, nothing moves
      share(low, before, -1, 0, out);
      share(low, after, 1, 0, out);
      return out;
    }
    const double down = 1 / low.weight, up = 1 / high.weight;
    share(low, before, -1, -down, out);
    share(high, after, 1, up, out);
    for (const int i : low.places)
      if (down > 0) out.move[at(i)] = -down;
    for (const int i : high.places)
      if (up > 0) out.move[at(i)] = up;
    out.gain = down + up;
    return out;
  }

  /// The separation and the tight way between its ends.
  [[nodiscard]] Separated crowded(std::size_t s) const {
    Separated out;
    out.lacking = missing(s);
    const SolverDirection along = direction(s);
    for (std::size_t c = 0; c < separations_.size(); ++c)
      if (c == s || along.pull[c] != 0) out.crowded.push_back(c);
    return out;
  }

  const std::vector<Separation>& separations_;
  std::vector<double> places_, weights_;
  std::vector<double> pull_;         ///< the multipliers, none below 0
  std::vector<std::size_t> active_;  ///< ascending
};

}  // namespace

Separated separate(const std::vector<double>& wished, const std::vector<Separation>& separations,
                   const std::vector<double>& weights) {
  return DualActiveSet(wished, separations, weights).run();
}

}  // namespace oriel
