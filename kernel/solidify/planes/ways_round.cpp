#include "kernel/solidify/planes/ways_round.h"

#include "kernel/base/index.h"

#include <algorithm>
#include <map>
#include <utility>

namespace oriel::detail {

namespace {

using Edge = std::pair<int, int>;  ///< points, the smaller one first

template <class Visit>
void for_each_edge(const Soup& soup, int polygon, Visit visit) {
  for (const int r : soup.rings_of(polygon)) {
    const auto ring = soup.ring(r);
    for (std::size_t k = 0; k < ring.size(); ++k)
      visit(Edge(std::minmax({ring[k], ring[(k + 1) % ring.size()]})));
  }
}

double edge_length(const Soup& soup, Edge edge) {
  const auto &p = soup.points[at(edge.first)], &q = soup.points[at(edge.second)];
  return length({static_cast<double>(p[0] - q[0]), static_cast<double>(p[1] - q[1]),
                 static_cast<double>(p[2] - q[2])});
}

/// The polygons at the edges of those that are undecided.
std::map<Edge, std::vector<int>> polygons_beside(const Soup& soup,
                                                 const std::vector<int>& undecided) {
  std::vector<char> is_near(soup.points.size(), 0);
  for (const int i : undecided)
    for (const int v : soup.corners_of(i)) is_near[at(v)] = 1;
  std::map<Edge, std::vector<int>> polygons_at;
  for (int i = 0; i < soup.polygon_count(); ++i)
    for_each_edge(soup, i, [&](Edge edge) {
      if (is_near[at(edge.first)] && is_near[at(edge.second)]) polygons_at[edge].push_back(i);
    });
  return polygons_at;
}

void decide_standing(const Soup& soup, std::span<const double> cosines, std::span<const int> planes,
                     const std::vector<int>& undecided, std::vector<char>& is_turned) {
  const auto polygons_at = polygons_beside(soup, undecided);
  std::vector<double> votes(soup.polygons.size(), 0);
  for (const int i : undecided)
    for_each_edge(soup, i, [&](Edge edge) {
      for (const int j : polygons_at.at(edge))
        if (j != i && planes[at(j)] == planes[at(i)] && !is_standing(cosines[at(j)]))
          votes[at(i)] += (is_turned[at(j)] ? -1 : 1) * edge_length(soup, edge);
    });
  for (const int i : undecided)
    if (votes[at(i)] != 0) is_turned[at(i)] = votes[at(i)] < 0;
}

}  // namespace

WaysRound ways_round(const Soup& soup, std::span<const double> cosines,
                     std::span<const int> planes) {
  WaysRound out;
  out.is_turned.resize(soup.polygons.size());
  std::vector<int> undecided;
  for (int i = 0; i < std::ssize(out.is_turned); ++i) {
    out.is_turned[at(i)] = cosines[at(i)] < 0;
    if (is_standing(cosines[at(i)])) undecided.push_back(i);
  }
  out.standing = static_cast<int>(undecided.size());
  if (!undecided.empty()) decide_standing(soup, cosines, planes, undecided, out.is_turned);
  return out;
}

}  // namespace oriel::detail
