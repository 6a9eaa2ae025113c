#include "kernel/segment/boundary/flat_body.h"

#include "kernel/base/index.h"

namespace oriel::detail {

std::span<const FlatBody::EdgePoints> FlatBody::edges() {
  if (!edges_.empty()) return edges_;
  edges_.reserve(at(body_.half_edge_count()) / 2);
  for (int e = 0; e < body_.half_edge_count(); ++e)
    if (body_.is_alive_edge(e) && e < body_.twin(e))
      edges_.push_back({body_.origin(e), body_.target(e)});
  return edges_;
}

std::span<const FlatBody::RankedFacet> FlatBody::facets() {
  if (!facets_.empty()) return facets_;
  const PlaneTable& planes = body_.world().planes;
  for (int f = 0; f < body_.facet_count(); ++f) {
    if (!body_.is_alive(f)) continue;
    const int plane = body_.facet(f).side >> 1;
    facets_.push_back({f, planes.class_of(plane), planes.rank_of(plane)});
  }
  return facets_;
}

}  // namespace oriel::detail
