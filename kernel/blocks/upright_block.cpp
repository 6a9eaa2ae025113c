#include "kernel/blocks/upright_block.h"

#include "kernel/solidify/solidify.h"

#include <utility>

namespace oriel {

namespace {

/// Adds the faces of blocks to a building, for solidify.
class BlockFaces {
 public:
  void add(const UprightBlock& block) {
    std::vector<std::vector<int>> top, ground;
    for (const Outline& outline : block.outlines) {
      const std::vector<int> low = ring(outline, block.ground_m), high = ring(outline, block.top_m);
      for (std::size_t i = 0; i < low.size(); ++i) {
        const std::size_t k = (i + 1) % low.size();
        add_polygon({{low[i], low[k], high[k], high[i]}});
      }
      top.push_back(high);
      ground.push_back({low.rbegin(), low.rend()});
    }
    add_polygon(std::move(top));
    add_polygon(std::move(ground));
    ++body_;
  }

  Building building;

 private:
  std::vector<int> ring(const Outline& outline, double z) {
    std::vector<int> out;
    for (const Vec3 p : outline) {
      out.push_back(static_cast<int>(building.vertices.size()));
      building.vertices.push_back({p.x, p.y, z});
    }
    return out;
  }

  void add_polygon(std::vector<std::vector<int>> rings) {
    Polygon polygon;
    polygon.rings = std::move(rings);
    polygon.source = static_cast<int>(building.polygons.size());
    polygon.body = body_;
    building.polygons.push_back(std::move(polygon));
  }

  int body_ = 0;
};

}  // namespace

Building faces_of(const std::vector<UprightBlock>& blocks) {
  BlockFaces faces;
  for (const UprightBlock& block : blocks) faces.add(block);
  return std::move(faces.building);
}

std::optional<Solid> block_solid(const Building& faces, const Tolerances& tolerances) {
  auto made = solidify(faces, tolerances, {Closing::planar});
  if (!made.value || !is_closed(*made.value)) return std::nullopt;
  return std::move(*made.value);
}

std::optional<Solid> block_solid(const std::vector<UprightBlock>& blocks,
                                 const Tolerances& tolerances) {
  return block_solid(faces_of(blocks), tolerances);
}

}  // namespace oriel
