#include "kernel/base/index.h"
#include "kernel/segment/cuts/carve.h"

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

namespace oriel::detail {

namespace {

/// A corner of a facet on the section plane: the half-edge that comes to it and the one that
/// leaves, as they were before any chord was put in.
struct ChordStop {
  EdgeId in = {}, out = {};
  double along = 0;
};

using Rim = boost::container::small_vector<EdgeId, 32>;

/// +1 on the side that the section looks to, 0 on its plane, -1 on the other side.
int level_at(const Boundary& body, const Section& section, PointId point) {
  const int level = body.world().points.side(point, section.plane);
  return level * section.direction;
}

/// The edge that a chord is already: it leads from one end of it to the other, and its facet meets
/// the plane nowhere else, as those of a window do. Invalid: none.
EdgeId edge_of_chord(const Boundary& body, const Section& section, CrossingId c) {
  const EdgeId begin = section.crossings[c].edge;
  const EdgeId end = body.twin(section.crossings[section.crossings[c].next].edge);
  const EdgeId e = body.next(begin);
  if (body.next(e) != end) return {};
  int on_plane = 0;
  body.for_each_edge(body.facet_of(begin), [&](EdgeId f) {
    on_plane += level_at(body, section, body.origin(f)) == 0 ? 1 : 0;
  });
  return on_plane == 2 ? e : EdgeId{};
}

/// Takes out of a rim what it runs there and back.
void cancel_spikes(const Boundary& body, Rim& rim) {
  const auto is_back = [&](std::size_t i) { return i > 0 && body.twin(rim[i - 1]) == rim[i]; };
  bool has_spike = rim.size() > 1 && body.twin(rim.back()) == rim.front();
  for (std::size_t i = 0; i < rim.size(); ++i) has_spike = has_spike || is_back(i);
  if (!has_spike) return;
  Rim out;
  for (const EdgeId e : rim) {
    if (!out.empty() && body.twin(out.back()) == e)
      out.pop_back();
    else
      out.push_back(e);
  }
  while (out.size() > 1 && body.twin(out.back()) == out.front()) {
    out.pop_back();
    out.erase(out.begin());
  }
  rim = std::move(out);
}

CapLoop cap_loop(const Boundary& body, const Rim& rim) {
  CapLoop loop;
  loop.edges.reserve(rim.size());
  for (const EdgeId e : rim) loop.edges.push_back({e, body.origin(e), body.target(e)});
  return loop;
}

class Imprinter {
 public:
  Imprinter(Boundary& body, const Section& section, const Lump& lump, std::vector<PointId>& touched)
      : body_(body),
        section_(section),
        lump_(lump),
        touched_(touched),
        axis_(body.world().planes.normal(section.looking())) {}

  std::vector<CutCap> run() {
    split_edges();
    collect_corners();
    std::vector<CutCap> caps;
    for (const RegionId r : lump_.regions) {
      const Region& region = section_.regions[r];
      CutCap cap{section_.split_side(region), {}, region.covered};
      for (const SectionLoopId l : region.loops) {
        CapLoop loop = rim_of(l);
        if (!loop.edges.empty()) cap.loops.push_back(std::move(loop));
      }
      if (!cap.loops.empty()) caps.push_back(std::move(cap));
    }
    for (const auto& [facet, edges] : fresh_) body_.retrace(facet, {edges.data(), edges.size()});
    return caps;
  }

 private:
  [[nodiscard]] int level(PointId point) const { return level_at(body_, section_, point); }

  template <class Visit>
  void for_each_crossing(Visit visit) {
    for (const RegionId r : lump_.regions)
      for (const SectionLoopId l : section_.regions[r].loops) {
        CrossingId c = section_.loops[l].first;
        do {
          visit(c);
          c = section_.crossings[c].next;
        } while (c != section_.loops[l].first);
      }
  }

  /// Edges that cross the plane between their ends get a vertex there.
  void split_edges() {
    for_each_crossing([&](CrossingId c) {
      const EdgeId e = section_.crossings[c].edge;
      const PointId high = body_.origin(e), low = body_.target(e);
      if (level(low) == 0) return;
      const int f = body_.side_of_edge(e) >> 1, g = body_.side_of_edge(body_.twin(e)) >> 1;
      const PointId point = body_.world().points.cross_edge(f, g, low, high, section_.plane);
      body_.split_edge(e, point);
      touched_.insert(touched_.end(), {low, high, point});
    });
  }

  [[nodiscard]] EdgeId edge_of(CrossingId c) const { return edge_of_chord(body_, section_, c); }

  /// For every facet that a chord may split: its corners on the plane that touch it from the other
  /// side, along the line.
  void collect_corners() {
    for_each_crossing([&](CrossingId c) {
      if (edge_of(c).is_valid()) return;
      const BodyFacetId f = body_.facet_of(section_.crossings[c].edge);
      const auto [entry, is_new] = corners_.try_emplace(f);
      if (!is_new) return;
      const Vec3 line = line_in(f);
      body_.for_each_edge(f, [&](EdgeId e) {
        const EdgeId out = body_.next(e);
        if (level(body_.target(e)) != 0 || level(body_.origin(e)) > 0 ||
            level(body_.target(out)) > 0)
          return;
        entry->second.push_back({e, out, dot(line, body_.at(out))});
      });
      std::ranges::sort(entry->second, {},
                        [](const ChordStop& corner) { return std::pair(corner.along, corner.in); });
    });
  }

  [[nodiscard]] Vec3 line_in(BodyFacetId f) const {
    return cross(axis_, body_.world().planes.normal(body_.facet(f).side));
  }

  /// The rim of a loop, chord by chord, without stretches that it runs there and back.
  CapLoop rim_of(SectionLoopId l) {
    Rim rim;
    CrossingId c = section_.loops[l].first;
    do {
      if (const EdgeId e = edge_of(c); e.is_valid())
        rim.push_back(e);
      else
        add_chord(c, rim);
      c = section_.crossings[c].next;
    } while (c != section_.loops[l].first);
    cancel_spikes(body_, rim);
    return cap_loop(body_, rim);
  }

  /// Makes the chord from crossing c an edge of the body, and adds its upper half-edges to the rim.
  /// The chord goes from corner to corner; where an existing edge leads from one to the next it is
  /// that edge.
  void add_chord(CrossingId c, Rim& rim) {
    const EdgeId begin = section_.crossings[c].edge;
    const EdgeId end = body_.twin(section_.crossings[section_.crossings[c].next].edge);
    const BodyFacetId f = body_.facet_of(begin);
    const Vec3 line = line_in(f);
    const EdgeId last_in = body_.prev(end);
    boost::container::small_vector<ChordStop, 4> stops{
        {begin, body_.next(begin), dot(line, body_.world().points.at(body_.target(begin)))}};
    const double goal = dot(line, body_.at(end));
    for (const ChordStop& corner : corners_.at(f))
      if (corner.along > stops[0].along && corner.along < goal) stops.push_back(corner);
    stops.push_back({last_in, end, goal});
    if (body_.target(begin) == body_.origin(end)) stops.pop_back();

    EdgeId tail = begin;
    if (stops.size() == 1 && stops[0].out != end) {
      // The facet touches the plane in a point: its parts on the two sides come apart there.
      relink(f, last_in, stops[0].out);
    }
    for (std::size_t i = 0; i + 1 < stops.size(); ++i) {
      const EdgeId old_out = stops[i].out, old_in = stops[i + 1].in;
      if (old_out == old_in) {
        relink(f, tail, old_out);
        tail = old_out;
      } else {
        tail = add_piece(f, tail, old_out, old_in, body_.origin(stops[i + 1].out));
      }
      rim.push_back(tail);
    }
    relink(f, tail, end);
  }

  void relink(BodyFacetId f, EdgeId e, EdgeId after) {
    if (body_.next(e) == after) return;
    body_.link(e, after);
    fresh_[f].push_back(after);
  }

  /// A new edge from where `tail` ends to `to`: the upper half-edge continues the tail, the lower
  /// one leads from `old_in` to `old_out`. Returns the upper one.
  EdgeId add_piece(BodyFacetId f, EdgeId tail, EdgeId old_out, EdgeId old_in, PointId to) {
    const PointId from = body_.origin(old_out);
    const EdgeId upper = body_.add_edge(from), lower = body_.add_edge(to);
    body_.pair(upper, lower);
    body_.link(tail, upper);
    body_.link(old_in, lower);
    body_.link(lower, old_out);
    fresh_[f].insert(fresh_[f].end(), {upper, lower});
    touched_.insert(touched_.end(), {from, to});
    return upper;
  }

  Boundary& body_;
  const Section& section_;
  const Lump& lump_;
  std::vector<PointId>& touched_;
  Vec3 axis_;
  std::map<BodyFacetId, boost::container::small_vector<ChordStop, 4>> corners_;
  std::map<BodyFacetId, boost::container::small_vector<EdgeId, 8>>
      fresh_;  ///< half-edges whose cycles have changed, by facet
};

}  // namespace

std::vector<CutCap> imprint(Boundary& body, const Section& section, const Lump& lump,
                            std::vector<PointId>& touched) {
  return Imprinter(body, section, lump, touched).run();
}

std::optional<std::vector<CutCap>> bare_caps(const Boundary& body, const Section& section,
                                             const Lump& lump) {
  std::vector<CutCap> caps;
  for (const RegionId r : lump.regions) {
    const Region& region = section.regions[r];
    if (!region.covered.empty()) return std::nullopt;
    CutCap& cap = caps.emplace_back(CutCap{section.split_side(region), {}, {}});
    for (const SectionLoopId l : region.loops) {
      Rim rim;
      CrossingId c = section.loops[l].first;
      do {
        const EdgeId e = edge_of_chord(body, section, c);
        if (!e.is_valid()) return std::nullopt;
        rim.push_back(e);
        c = section.crossings[c].next;
      } while (c != section.loops[l].first);
      cancel_spikes(body, rim);
      if (rim.empty()) return std::nullopt;
      cap.loops.push_back(cap_loop(body, rim));
    }
  }
  return caps;
}

}  // namespace oriel::detail
