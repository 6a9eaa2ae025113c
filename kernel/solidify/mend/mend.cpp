#include "kernel/solidify/mend/mend.h"

#include "kernel/base/index.h"
#include "kernel/solidify/cap_kinds.h"
#include "kernel/solidify/crossings/crossings.h"
#include "kernel/solidify/crossings/faces.h"
#include "kernel/solidify/mend/boundary_rays.h"
#include "kernel/solidify/mend/caps.h"
#include "kernel/solidify/mend/cells.h"
#include "kernel/solidify/mend/duplicates.h"
#include "kernel/solidify/mend/exposed_faces.h"
#include "kernel/solidify/mend/t_vertices.h"
#include "kernel/solidify/shells/edge_groups.h"
#include "kernel/solidify/soup/polygon_shape.h"
#include "kernel/solidify/soup/soup.h"

#include <algorithm>
#include <limits>
#include <map>
#include <numeric>
#include <span>
#include <vector>

namespace oriel::detail {

namespace {

/// What becomes of what a piece encloses.
enum class PieceRole : char {
  nothing,  ///< it encloses nothing
  lump,
  cavity,  ///< of the lumps around it
  within   ///< it lies in the material of another piece
};

/// The boundary of a piece, as far as its role depends on it.
struct PieceBoundary {
  int polygon = -1;         ///< its first one
  double input_volume = 0;  ///< as the input's polygons run
};

class RoleFinder {
 public:
  RoleFinder(const Soup& soup, std::span<const PolygonShape> shapes, const PolygonCells& cells,
             bool is_solid, Work& work)
      : soup_(soup), shapes_(shapes), cells_(cells), is_solid_(is_solid), work_(work) {}

  std::vector<PieceRole> run() {
    std::vector<PieceRole> roles(at(cells_.piece_count), PieceRole::nothing);
    const std::vector<PieceBoundary> pieces = boundaries();
    Numbers enclosing;
    for (int i = 0; i < cells_.piece_count; ++i)
      if (pieces[at(i)].polygon >= 0) enclosing.push_back(i);
    if (enclosing.size() == 1) roles[at(enclosing[0])] = PieceRole::lump;
    if (enclosing.size() <= 1) return roles;

    const std::vector<Numbers> around = pieces_around(pieces);
    std::ranges::stable_sort(enclosing, {}, [&](int i) { return around[at(i)].size(); });
    for (const int i : enclosing) {
      int depth = 0;  // how much material there is around it
      for (const int j : around[at(i)])
        depth += (roles[at(j)] == PieceRole::lump) - (roles[at(j)] == PieceRole::cavity);
      roles[at(i)] = depth <= 0                    ? PieceRole::lump
                     : wants_cavity(pieces[at(i)]) ? PieceRole::cavity
                                                   : PieceRole::within;
    }
    return roles;
  }

 private:
  [[nodiscard]] Vec3 place(int point) const { return exact::to_metres(soup_.points[at(point)], 1); }

  [[nodiscard]] std::vector<PieceBoundary> boundaries() const {
    std::vector<PieceBoundary> pieces(at(cells_.piece_count));
    for (int p = 0; p < soup_.polygon_count(); ++p) {
      if (!cells_.is_boundary(p)) continue;
      PieceBoundary& piece = pieces[at(cells_.piece[at(p)])];
      if (piece.polygon < 0) piece.polygon = p;
      piece.input_volume += shapes_[at(p)].area *
                            dot(shapes_[at(p)].unit, place(soup_.corners_of(p).front()) - place(0));
    }
    return pieces;
  }

  [[nodiscard]] bool wants_cavity(const PieceBoundary& piece) const {
    return is_solid_ ? soup_.polygons[at(piece.polygon)].shell > 0 : piece.input_volume < 0;
  }

  /// Of every piece that encloses something the others of its body whose boundary it lies in: a ray
  /// from its first point crosses that an odd number of times.
  [[nodiscard]] std::vector<Numbers> pieces_around(std::span<const PieceBoundary> pieces) const {
    const BoundaryRays rays(soup_, shapes_, cells_, work_);
    std::vector<Numbers> around(pieces.size());
    for (std::size_t i = 0; i < pieces.size(); ++i) {
      if (pieces[i].polygon < 0 || work_.is_used_up()) continue;
      const Vec3 eye = place(soup_.corners_of(pieces[i].polygon).front());
      std::map<int, int> crossings;
      rays.for_each_hit(eye, [&](int p) {
        const int piece = cells_.piece[at(p)];
        if (piece != static_cast<int>(i) && body(p) == body(pieces[i].polygon)) ++crossings[piece];
      });
      for (const auto& [piece, count] : crossings)
        if (count % 2 == 1) around[i].push_back(piece);
    }
    return around;
  }

  [[nodiscard]] int body(int polygon) const { return soup_.polygons[at(polygon)].body; }

  const Soup& soup_;
  std::span<const PolygonShape> shapes_;
  const PolygonCells& cells_;
  bool is_solid_;
  Work& work_;
};

/// The role of every piece of the soup. A piece in the material of others of the same body is a
/// cavity if the input says so (an inner shell of a solid, or, of loose surfaces, one whose
/// boundary faces inward), else it is within. `is_solid`: what the input says of shells counts.
std::vector<PieceRole> find_roles(const Soup& soup, std::span<const PolygonShape> shapes,
                                  const PolygonCells& cells, bool is_solid, Work& work) {
  return RoleFinder(soup, shapes, cells, is_solid, work).run();
}

/// Published models have polygons that are out of plane by up to 9 mm: five times the tolerance of
/// planes.
constexpr double kCapReach = 5;

/// How much of what can be seen a repair may leave out: what a ray misjudges at polygons out of
/// plane, and a sheet or two. The smallest wall, roof or ground of a house is several times as much
/// of its surface, and losing one is no repair.
constexpr double kMostExposed = 0.01;

/// What finding shapes and cells takes.
constexpr std::int64_t kStepsPerCorner = 16;

Soup with_counted_work(Soup soup, Work& work) {
  work.add(kStepsPerCorner * soup.corner_count());
  return soup;
}

/// A soup with what is known of it.
struct MendStage {
  Soup soup;
  std::vector<PolygonShape> shapes;
  PolygonCells cells;

  /// What would be left out of the solid though it can be seen from outside.
  ExposedFaces exposed;

  MendStage(Soup polygons, const Tolerances& tolerances, Work& work)
      : soup(with_counted_work(std::move(polygons), work)),
        shapes(shapes_of(soup)),
        cells(find_cells(soup, shapes)),
        exposed(is_open() ? ExposedFaces{}
                          : find_exposed_faces(soup, shapes, cells,
                                               tolerances.plane_offset_m / soup.grid_m, work)) {}

  /// Less is enclosed than is left over.
  [[nodiscard]] bool is_open() const {
    double boundary = 0, dangling = 0;
    for (int p = 0; p < soup.polygon_count(); ++p) {
      if (soup.polygons[at(p)].source == kNoSource) continue;
      if (cells.is_boundary(p)) boundary += shapes[at(p)].area;
      if (cells.is_front_outside(p) && cells.is_back_outside(p)) dangling += shapes[at(p)].area;
    }
    return boundary <= dangling;
  }

  /// It encloses something, and shows what the polygons show.
  [[nodiscard]] bool is_solid() const { return !is_open() && exposed.share <= kMostExposed; }
};

/// How far off its plane the rim of a cap may lie, grid units.
double cap_reach(const Soup& soup, const Tolerances& tolerances) {
  return kCapReach * tolerances.plane_offset_m / soup.grid_m;
}

std::vector<AddedFace> faces_of(std::vector<CapDraft> caps) {
  std::vector<AddedFace> faces;
  for (CapDraft& cap : caps) faces.push_back({{std::move(cap.ring)}, cap.beside});
  return faces;
}

/// The polygons with caps as far as they are needed, holes up to an area (m²) closed.
MendStage close_holes(MendStage stage, const Tolerances& tolerances, double cap_area_m2,
                      Work& work) {
  if (cap_area_m2 <= 0 || stage.is_solid() || work.is_used_up()) return stage;
  const double area = cap_area_m2 / (stage.soup.grid_m * stage.soup.grid_m);
  auto caps = find_caps(stage.soup, stage.shapes, cap_reach(stage.soup, tolerances), area, work);
  return MendStage(with_faces(stage.soup, faces_of(std::move(caps))), tolerances, work);
}

/// The same, and of larger holes the missing ground and missing walls.
MendStage close_ground(MendStage stage, const Tolerances& tolerances, double cap_area_m2,
                       Work& work) {
  if (stage.is_solid() || work.is_used_up()) return stage;
  const double area = cap_area_m2 / (stage.soup.grid_m * stage.soup.grid_m);
  const double reach = cap_reach(stage.soup, tolerances);
  std::vector<CapDraft> caps = find_caps(stage.soup, stage.shapes, reach, Box::kInfinity, work);
  const std::vector<AddedFace> all = faces_of(caps);
  const CapKinds kinds(stage.soup, stage.shapes, all, reach, work);
  std::vector<AddedFace> faces;
  for (std::size_t i = 0; i < caps.size(); ++i)
    if (caps[i].area <= area || kinds.kind_of(all[i].rings) != CapKind::hole)
      faces.push_back(all[i]);
  return MendStage(with_faces(stage.soup, std::move(faces)), tolerances, work);
}

/// The polygons cut where others run through them or lie on them.
Soup without_crossings(const Soup& soup, const Tolerances& tolerances, RepairReport& report,
                       Work& work) {
  const double weld = tolerances.weld_m / soup.grid_m;
  const auto [parted, cut] =
      cut_at_crossings(soup, tolerances.plane_offset_m / soup.grid_m, weld, work);
  auto [joined, inserted] = insert_t_vertices(parted, weld, Inserted::all, &work);
  report.cut += cut;
  report.t_vertices += inserted;
  return std::move(joined);
}

/// Closes the shell: small holes first, then by cutting what crosses, then larger holes (a ground
/// and walls, or any), as far as the options allow. Each only if what came before was not enough.
MendStage close(Soup soup, const Tolerances& tolerances, const RepairOptions& options,
                RepairReport& report, Work& work) {
  const double area_m2 = options.close == Closing::none ? 0 : options.cap_area_m2;
  MendStage stage = close_holes(MendStage(soup, tolerances, work), tolerances, area_m2, work);
  if (options.crossings != Crossings::leave && !stage.is_solid()) {
    soup = without_crossings(soup, tolerances, report, work);
    stage = close_holes(MendStage(soup, tolerances, work), tolerances, area_m2, work);
  }
  if (stage.is_solid()) return stage;
  if (options.close == Closing::ground)
    return close_ground(MendStage(std::move(soup), tolerances, work), tolerances, area_m2, work);
  if (options.close != Closing::any) return stage;
  return close_holes(MendStage(std::move(soup), tolerances, work), tolerances,
                     std::numeric_limits<double>::infinity(), work);
}

std::vector<OpenEdge> open_edges_of(const Soup& soup) {
  const ShellMesh mesh = linked_rings(soup);
  const auto place = [&](int v) { return exact::to_metres(soup.points[at(v)], soup.grid_m); };
  std::vector<OpenEdge> open;
  EdgeGroups(soup, mesh).for_each([&](EdgeGroup group) {
    const auto h = at(group[0]);
    if (group.size() == 1)
      open.push_back({place(soup.corners[h]), place(soup.corners[at(mesh.next[h])]),
                      soup.polygons[at(mesh.polygon_of[h])].source});
  });
  return open;
}

Cap cap_of(const MendStage& stage, int polygon, const CapKinds& kinds) {
  const double grid_m = stage.soup.grid_m;
  Cap cap{stage.shapes[at(polygon)].area * grid_m * grid_m,
          {},
          kinds.kind_of(rings_of(stage.soup, polygon))};
  const auto corners = stage.soup.corners_of(polygon);
  for (const int v : corners)
    cap.centre = cap.centre + exact::to_metres(stage.soup.points[at(v)], grid_m);
  cap.centre = 1.0 / static_cast<double>(corners.size()) * cap.centre;
  return cap;
}

/// Sorts the polygons of a list, each once, without those of which a piece is in the soup.
void drop_kept(const Soup& soup, std::vector<int>& polygons) {
  std::vector<int> kept;
  for (const SoupPolygon& polygon : soup.polygons) kept.push_back(polygon.source);
  std::ranges::sort(kept);
  std::ranges::sort(polygons);
  polygons.erase(std::unique(polygons.begin(), polygons.end()), polygons.end());
  std::erase_if(polygons, [&](int p) { return std::ranges::binary_search(kept, p); });
}

/// Fills the soup and the rest of the report.
void keep_boundary(const MendStage& stage, bool is_solid, const Tolerances& tolerances,
                   Mended& mended, Work& work) {
  const Soup& soup = stage.soup;
  const auto& shapes = stage.shapes;
  const PolygonCells& cells = stage.cells;
  const std::vector<PieceRole> roles = find_roles(soup, shapes, cells, is_solid, work);
  RepairReport& report = mended.report;
  const double m2 = soup.grid_m * soup.grid_m;
  const CapKinds kinds(soup, shapes, {}, cap_reach(soup, tolerances), work);
  SoupBuilder builder(soup);
  for (int p = 0; p < soup.polygon_count(); ++p) {
    const int source = soup.polygons[at(p)].source;
    const PieceRole role = roles[at(cells.piece[at(p)])];
    const bool is_front = cells.is_front_outside(p);
    if (cells.is_boundary(p) && role != PieceRole::within) {
      const bool is_turned = is_front == (role == PieceRole::cavity);
      builder.add_polygon(soup, p, is_turned);
      if (source == kNoSource) report.caps.push_back(cap_of(stage, p, kinds));
      report.turned += is_turned && source != kNoSource;
    } else if (source != kNoSource) {
      const bool is_dangling = is_front && cells.is_back_outside(p);
      (is_dangling ? report.dangling : report.inner).push_back(source);
      (is_dangling ? report.dangling_area_m2 : report.inner_area_m2) += shapes[at(p)].area * m2;
    }
  }
  mended.soup = builder.finish();
  for (auto* const polygons : {&report.dangling, &report.inner}) drop_kept(mended.soup, *polygons);
  const auto lumps = std::ranges::count(roles, PieceRole::lump);
  report.detached_shells = std::max(0, static_cast<int>(lumps) - 1);
  report.cavities = static_cast<int>(std::ranges::count(roles, PieceRole::cavity));
  report.crowded_edges = cells.crowded_edges;
}

}  // namespace

Mended mend(const Soup& soup, bool is_solid, const Tolerances& tolerances,
            const RepairOptions& options, Work& work) {
  Mended mended;
  RepairReport& report = mended.report;
  report.was_needed = true;
  const Soup single = without_duplicates(soup, report.duplicates);
  auto [joined, inserted] =
      insert_t_vertices(single, tolerances.weld_m / soup.grid_m, Inserted::odd_ends, &work);
  report.t_vertices = inserted;
  if (joined.polygons.empty()) {
    mended.is_open = true;
    return mended;
  }
  auto [whole, cut] =
      cut_at_contacts(joined, shapes_of(joined), tolerances.plane_offset_m / soup.grid_m, work);
  report.cut = cut;
  std::vector<OpenEdge> open = open_edges_of(whole);
  MendStage stage = close(std::move(whole), tolerances, options, report, work);
  mended.is_open = work.is_used_up() || !stage.is_solid();
  if (mended.is_open) {
    mended.exposed = stage.exposed;
    mended.exposed.area *= soup.grid_m * soup.grid_m;
    report.open_edges = std::move(open);
  } else {
    keep_boundary(stage, is_solid, tolerances, mended, work);
  }
  return mended;
}

}  // namespace oriel::detail
