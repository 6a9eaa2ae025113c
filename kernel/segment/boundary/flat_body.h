#pragma once

#include "kernel/segment/boundary/boundary.h"

#include <span>
#include <vector>

namespace oriel::detail {

/// The living edges and facets of a body, close together: for questions that all of them are asked
/// again and again while the body stays as it is. Listed when they are first asked for.
class FlatBody {
 public:
  explicit FlatBody(const Boundary& body) : body_(body) {}

  struct EdgePoints {
    int from, to;  ///< points
  };
  /// A facet and where its plane stands among those of its class.
  struct RankedFacet {
    int number;
    int normal_class;
    int rank;
  };

  [[nodiscard]] const Boundary& body() const { return body_; }
  /// Each edge once, in one of its directions.
  [[nodiscard]] std::span<const EdgePoints> edges();
  [[nodiscard]] std::span<const RankedFacet> facets();

 private:
  const Boundary& body_;
  std::vector<EdgePoints> edges_;
  std::vector<RankedFacet> facets_;
};

}  // namespace oriel::detail
