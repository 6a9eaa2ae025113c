#include "tests/support/convex_body.h"

#include "tests/support/shapes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

namespace oriel::test {

namespace {

constexpr double kOn = 1e-9;
constexpr double kFarAway = 1e3;

using Face = std::vector<Vec3>;
/// A convex cell as its faces, each counter-clockwise seen from outside.
using Cell = std::vector<Face>;

double height(const HalfSpace& h, Vec3 p) { return dot(h.normal, p) - h.offset; }

Vec3 middle_of(const std::vector<Vec3>& points) {
  Vec3 sum;
  for (const Vec3 p : points) sum = sum + p;
  return (1.0 / static_cast<double>(points.size())) * sum;
}

Vec3 middle_of(const Cell& cell) {
  std::vector<Vec3> middles;
  for (const Face& face : cell) middles.push_back(middle_of(face));
  return middle_of(middles);
}

/// Where an edge crosses the plane: the same double from both ends.
Vec3 crossing(const HalfSpace& h, Vec3 p, Vec3 q) {
  if (std::tuple(q.x, q.y, q.z) < std::tuple(p.x, p.y, p.z)) std::swap(p, q);
  const double hp = height(h, p), hq = height(h, q);
  return p + (hp / (hp - hq)) * (q - p);
}

/// The part of a face with sign · height ≤ 0; points on the plane are added to `on_plane`.
Face clip(const Face& face, const HalfSpace& h, double sign, std::vector<Vec3>& on_plane) {
  Face part;
  for (std::size_t i = 0; i < face.size(); ++i) {
    const Vec3 p = face[i], q = face[(i + 1) % face.size()];
    const double hp = sign * height(h, p), hq = sign * height(h, q);
    if (hp <= kOn) part.push_back(p);
    if (std::abs(hp) <= kOn) on_plane.push_back(p);
    if ((hp < -kOn && hq > kOn) || (hp > kOn && hq < -kOn)) {
      part.push_back(crossing(h, p, q));
      on_plane.push_back(part.back());
    }
  }
  return part;
}

/// The convex face through points of a plane, counter-clockwise about `normal`.
Face face_through(std::vector<Vec3> points, Vec3 normal) {
  const Vec3 middle = middle_of(points);
  const Vec3 u = normalised(points[0] - middle), v = cross(normalised(normal), u);
  std::ranges::sort(points, {},
                    [&](Vec3 p) { return std::atan2(dot(p - middle, v), dot(p - middle, u)); });
  Face face;
  for (const Vec3 p : points)
    if (face.empty() || length(p - face.back()) > kOn) face.push_back(p);
  while (face.size() > 1 && length(face.front() - face.back()) <= kOn) face.pop_back();
  return face;
}

/// The part of a cell that a plane parts, on one side of it.
Cell half(const Cell& cell, const HalfSpace& h, double sign) {
  Cell part;
  std::vector<Vec3> on_plane;
  for (const Face& face : cell) {
    Face clipped = clip(face, h, sign, on_plane);
    const bool is_flat =
        std::ranges::all_of(clipped, [&](Vec3 p) { return std::abs(height(h, p)) <= kOn; });
    if (clipped.size() >= 3 && !is_flat) part.push_back(std::move(clipped));
  }
  part.push_back(face_through(on_plane, sign > 0 ? h.normal : -h.normal));
  return part;
}

bool is_parted(const Cell& cell, const HalfSpace& h) {
  bool has_behind = false, has_before = false;
  for (const Face& face : cell)
    for (const Vec3 p : face) {
      has_behind |= height(h, p) < -kOn;
      has_before |= height(h, p) > kOn;
    }
  return has_behind && has_before;
}

/// A face as a key that is the same seen from both sides.
using Key = std::vector<std::tuple<long long, long long, long long>>;
Key key_of(const Face& face) {
  Key key;
  for (const Vec3 p : face)
    key.emplace_back(std::llround(p.x * 1e6), std::llround(p.y * 1e6), std::llround(p.z * 1e6));
  std::ranges::sort(key);
  return key;
}

}  // namespace

std::vector<HalfSpace> box(Vec3 min, Vec3 max) {
  return {{{-1, 0, 0}, -min.x}, {{1, 0, 0}, max.x},   {{0, -1, 0}, -min.y},
          {{0, 1, 0}, max.y},   {{0, 0, -1}, -min.z}, {{0, 0, 1}, max.z}};
}

ConvexBody& ConvexBody::put(std::vector<HalfSpace> piece, bool is_solid) {
  pieces_.push_back({std::move(piece), is_solid});
  return *this;
}

bool ConvexBody::is_solid_at(Vec3 p) const {
  bool is_solid = false;
  for (const Piece& piece : pieces_)
    if (std::ranges::all_of(piece.half_spaces,
                            [&](const HalfSpace& h) { return height(h, p) < 0; }))
      is_solid = piece.is_solid;
  return is_solid;
}

Building ConvexBody::build(const std::string& id) const {
  const double f = kFarAway;
  std::vector<Cell> cells{{{{-f, -f, -f}, {-f, -f, f}, {-f, f, f}, {-f, f, -f}},
                           {{f, -f, -f}, {f, f, -f}, {f, f, f}, {f, -f, f}},
                           {{-f, -f, -f}, {f, -f, -f}, {f, -f, f}, {-f, -f, f}},
                           {{-f, f, -f}, {-f, f, f}, {f, f, f}, {f, f, -f}},
                           {{-f, -f, -f}, {-f, f, -f}, {f, f, -f}, {f, -f, -f}},
                           {{-f, -f, f}, {f, -f, f}, {f, f, f}, {-f, f, f}}}};
  for (const Piece& piece : pieces_)
    for (const HalfSpace& h : piece.half_spaces) {
      std::vector<Cell> parted;
      for (Cell& cell : cells) {
        if (!is_parted(cell, h)) {
          parted.push_back(std::move(cell));
          continue;
        }
        parted.push_back(half(cell, h, 1));
        parted.push_back(half(cell, h, -1));
      }
      cells = std::move(parted);
    }
  std::map<Key, std::vector<const Face*>> faces_of_solid;
  for (const Cell& cell : cells)
    if (is_solid_at(middle_of(cell)))
      for (const Face& face : cell) faces_of_solid[key_of(face)].push_back(&face);
  std::vector<std::vector<Vec3>> boundary;
  for (const auto& [key, faces] : faces_of_solid)
    if (faces.size() == 1) boundary.push_back(*faces[0]);
  return building_of(boundary, id);
}

}  // namespace oriel::test
