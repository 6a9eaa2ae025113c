#include "generalise/series/level_state.h"

#include "generalise/removal/facets.h"
#include "kernel/base/index.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <utility>

namespace oriel {

namespace {

/// Without vertices that stand twice in a row, from the smallest one on; empty if less than a
/// triangle is left.
MicrometreRing ring_of(const Loop& loop, const std::vector<MicrometrePoint>& places) {
  MicrometreRing ring;
  for (const int v : loop)
    if (ring.empty() || ring.back() != places[at(v)]) ring.push_back(places[at(v)]);
  while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  if (std::set<MicrometrePoint>(ring.begin(), ring.end()).size() < 3) return {};
  std::ranges::rotate(ring, std::ranges::min_element(ring));
  return ring;
}

/// Makes the building of a state.
class Builder {
 public:
  Builder(const LevelState& state, const Frame& frame) : state_(state), frame_(frame) {}

  LabelledBuilding run() {
    out_.building = state_.building;
    for (const auto& [outer, facet] : state_.facets) add(outer, facet);
    solid_.shells = detail::shells_of(solid_);
    tie_openings();
    for (const auto& [id, label] : state_.installations) add_installation(id, label);
    for (const auto& [name, value] : state_.attributes) out_.attributes.emplace_back(name, value);
    if (!state_.facets.empty()) out_.geometry = std::move(solid_);
    return std::move(out_);
  }

 private:
  int vertex(const MicrometrePoint& p) {
    const auto [found, is_new] = number_of_.try_emplace(p, static_cast<int>(number_of_.size()));
    if (is_new) {
      const Vec3 input = metres_of(p);
      solid_.vertices.push_back({input - frame_.origin_m, false});
    }
    return found->second;
  }

  Loop loop(const MicrometreRing& ring) {
    Loop loop;
    for (const MicrometrePoint& p : ring) loop.push_back(vertex(p));
    return loop;
  }

  void add(const MicrometreRing& outer, const LevelFacet& facet) {
    Facet made{PlaneId{static_cast<int>(solid_.planes.size())}, {loop(outer)}, {}};
    for (const MicrometreRing& hole : facet.holes) made.loops.push_back(loop(hole));
    solid_.planes.push_back(detail::plane_of(solid_.vertices, made.loops[0]));
    solid_.facets.push_back(std::move(made));
    const int number = static_cast<int>(out_.surfaces.size());
    const std::string& id = facet.label->id;
    const auto found = id.empty() ? surface_of_id_.end() : surface_of_id_.find(id);
    if (found != surface_of_id_.end() && out_.surfaces[at(found->second)].type == facet.type) {
      out_.surface_of_polygon.push_back(found->second);
      return;
    }
    if (!id.empty()) surface_of_id_.emplace(id, number);
    out_.surface_of_polygon.push_back(facet.type.empty() ? -1 : number);
    if (!facet.type.empty()) out_.surfaces.push_back({facet.type, -1, facet.label});
  }

  void tie_openings() {
    std::map<std::pair<int, int>, double> contact_m;  // opening, other surface
    std::map<std::pair<int, int>, int> surface_at;    // by directed edge
    detail::for_each_edge(solid_, [&](int facet, int p, int q) {
      surface_at[{p, q}] = out_.surface_of_polygon[at(facet)];
    });
    for (const auto& [edge, surface] : surface_at) {
      const auto other = surface_at.find({edge.second, edge.first});
      if (other == surface_at.end() || surface < 0 || other->second < 0) continue;
      if (!is_opening_type(out_.surfaces[at(surface)].type) ||
          is_opening_type(out_.surfaces[at(other->second)].type))
        continue;
      contact_m[{surface, other->second}] +=
          length(solid_.vertices[at(edge.first)].point - solid_.vertices[at(edge.second)].point);
    }
    std::map<int, double> best_m;
    for (const auto& [pair, length_m] : contact_m) {
      double& best = best_m[pair.first];
      if (length_m <= best) continue;
      best = length_m;
      out_.surfaces[at(pair.first)].parent = pair.second;
    }
  }

  void add_installation(const std::string& id, const SharedLabel& label) {
    Installation installation{id, label, {}, {}};
    int number = 0;
    for (const auto& [outer, facet] : state_.facets) {
      if (std::ranges::binary_search(facet.installations, id)) {
        installation.polygons.push_back(number);
        installation.surfaces.push_back(out_.surface_of_polygon[at(number)]);
      }
      ++number;
    }
    out_.installations.push_back(std::move(installation));
  }

  const LevelState& state_;
  const Frame& frame_;
  Solid solid_;
  LabelledBuilding out_;
  std::map<MicrometrePoint, int> number_of_;
  std::map<std::string, int> surface_of_id_;
};

}  // namespace

LevelState level_state(const LabelledBuilding& labelled, const Placer& place) {
  LevelState state;
  state.building = labelled.building;
  const Solid& solid = *labelled.geometry;
  std::vector<MicrometrePoint> places;
  places.reserve(solid.vertices.size());
  for (const Vertex& vertex : solid.vertices) places.push_back(place(vertex.point));
  std::vector<std::vector<std::string>> owners(solid.facets.size());
  for (const Installation& installation : labelled.installations) {
    state.installations[installation.id] = installation.label;
    for (const int facet : installation.polygons) owners[at(facet)].push_back(installation.id);
  }
  for (std::size_t f = 0; f < solid.facets.size(); ++f) {
    MicrometreRing outer = ring_of(solid.facets[f].loops[0], places);
    if (outer.empty()) continue;
    LevelFacet facet;
    for (std::size_t i = 1; i < solid.facets[f].loops.size(); ++i)
      if (MicrometreRing hole = ring_of(solid.facets[f].loops[i], places); !hole.empty())
        facet.holes.push_back(std::move(hole));
    std::ranges::sort(facet.holes);
    if (const int surface = labelled.surface_of_polygon[f]; surface >= 0) {
      facet.type = labelled.surfaces[at(surface)].type;
      facet.label = labelled.surfaces[at(surface)].label;
    }
    std::ranges::sort(owners[f]);
    facet.installations = std::move(owners[f]);
    facet.polygons = solid.facets[f].polygons;
    const MicrometrePoint corner = outer[0];
    if (!state.facets.emplace(std::move(outer), std::move(facet)).second)
      throw DoubledFacet(corner);
  }
  for (const auto& [name, value] : labelled.attributes)
    if (is_of_state(name)) state.attributes[name] = as_written(value);
  return state;
}

LabelledBuilding labelled_building(const LevelState& state, const Frame& frame) {
  return Builder(state, frame).run();
}

Building building_of(const LevelState& state, const Frame& frame) {
  const LabelledBuilding labelled = labelled_building(state, frame);
  Building building;
  building.id = state.building;
  building.frame = frame;
  for (const Vertex& vertex : labelled.geometry->vertices)
    building.vertices.push_back(vertex.point);
  int shell_number = 0;
  for (const Shell& shell : labelled.geometry->shells) {
    shell_number = shell.is_cavity ? shell_number + 1 : 0;
    for (const FacetId id : shell.facets) {
      const int source = static_cast<int>(building.polygons.size());
      building.polygons.push_back(
          {labelled.geometry->facets[id.index()].loops, source, shell.lump, shell_number, {}});
    }
  }
  return building;
}

}  // namespace oriel
