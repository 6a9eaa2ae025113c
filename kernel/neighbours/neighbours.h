#pragma once

#include "kernel/base/issue.h"
#include "kernel/geometry/box_tree.h"
#include "kernel/neighbours/footprint_union.h"
#include "kernel/neighbours/standing_building.h"

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace oriel {

namespace detail {
class ShapeStore;
}

/// A wall of another building against which a building stands, in the building's frame, moved into
/// the plane of the building's own wall.
struct NeighbourWall {
  std::string building;           ///< id of the other one
  std::vector<Outline> outlines;  ///< the outer one first, counter-clockwise about `normal`
  Vec3 normal;                    ///< out of the other building
};

/// How a building touches another one.
struct BuildingContact {
  std::string building;   ///< id of the other one
  double area_m2 = 0;     ///< of walls that lie against each other
  double widest_m = 0;    ///< how far such walls are apart at most
  double overlap_m2 = 0;  ///< of the ground that both cover, where their heights overlap
};

/// What lies before a wall, seen from above.
enum class Outlook {
  street,  ///< neither of the others
  /// A hole of the ground that its group covers; or straight on, and at 45 degrees to both sides,
  /// other buildings of its group are met first.
  yard,
  roof  ///< the ground of another building at once: the wall stands over its roof
};

/// What stands around one building.
struct Neighbourhood {
  /// By id, ascending.
  std::vector<BuildingContact> contacts;
  /// Of buildings in `contacts`.
  std::vector<NeighbourWall> walls;
  /// The building's position among those of the search, if it is one of them.
  std::optional<std::size_t> self;
  Vec3 origin_m;  ///< Frame::origin_m
  /// E175: it overlaps another building; E176: it stands in another one; E178: walls that count as
  /// touching are more than a centimetre apart.
  std::vector<Issue> issues;

  /// The share of a plane figure (outlines counter-clockwise about `normal`) that lies against
  /// other buildings, 0 … 1.
  [[nodiscard]] double covered_share(std::span<const Outline> figure, Vec3 normal) const;
};

/// What the outlines of buildings may take in memory, and where the rest of them is.
struct ScratchSpace {
  /// So many of them are in memory. Those of two and a half thousand houses with windows take 32
  /// MB, less than a run over single buildings needs anyway; a building and all that stands near
  /// it, at whatever scale, is a small part of that.
  std::size_t held_bytes = std::size_t{32} << 20;
  /// The output: those of larger cities are in a file without a name in its folder. Empty: in the
  /// folder for temporary files.
  std::string beside{};
};

/// The buildings of a city: who touches whom, and what lies before their walls.
///
/// Two buildings touch where walls of them, upright to half a degree and with opposite normals, are
/// no more than kContact_m apart and share kContact_m2 or more; those that touch, directly or by
/// others, are a group. Results do not depend on the order in which buildings are added. Searches
/// take O(n log n) in all: boxes in a tree (BoxTree). Of each building its id, box and
/// heights are in memory, some 400 bytes; outlines are as ScratchSpace says, which changes no
/// result. A file that cannot be written or read again is an OutputError E601, thrown by any call.
class NeighbourSearch {
 public:
  explicit NeighbourSearch(ScratchSpace scratch = {});
  ~NeighbourSearch();
  NeighbourSearch(NeighbourSearch&&) noexcept;
  NeighbourSearch& operator=(NeighbourSearch&&) noexcept;

  /// A building of a file, before finish(). One that comes again unchanged counts once.
  void add(const Building& building);
  /// All were added: groups and courtyards are found. Then the rest may be called, by several
  /// threads at the same time.
  void finish();

  [[nodiscard]] std::size_t size() const { return standing_.size(); }
  /// All that the results depend on, as hexadecimal SHA-256.
  [[nodiscard]] const std::string& sha256() const { return sha256_; }
  /// Warnings: E179 for an id that several buildings have, E177 for buildings whose coordinate
  /// reference system is not that of most, which have no neighbours in others, E502 for a group
  /// whose courtyards are not known.
  [[nodiscard]] const std::vector<Issue>& issues() const { return issues_; }

  /// What stands around a building, which need not be one of them; then it has no `self`.
  [[nodiscard]] Neighbourhood of(const Building& building) const;
  /// What lies before a point of a wall of a building, in its frame, along a normal that is not
  /// upright. Nothing if the building is none of the search.
  [[nodiscard]] std::optional<Outlook> outlook(const Neighbourhood& of, Vec3 point,
                                               Vec3 normal) const;

  /// Whether a building other than that of `of` stands over the box, seen from above; the box is in
  /// the building's frame.
  [[nodiscard]] bool is_built_on(const Neighbourhood& of, const Box& local_m) const;

  /// The buildings whose boxes a box in the input's coordinates meets, seen from above, ascending.
  [[nodiscard]] std::vector<std::size_t> standing_in(const Box& input_m) const;

  /// The buildings, ascending by id.
  [[nodiscard]] const std::vector<StandingBuilding>& buildings() const { return standing_; }
  /// One of them with its outlines.
  [[nodiscard]] ShapedBuilding shaped(std::size_t building) const;
  /// All of them, those that stand near each other together.
  [[nodiscard]] const std::vector<std::size_t>& by_place() const { return by_place_; }
  /// Those whose boxes are no further than `reach_m` from that of a building, itself left out,
  /// ascending.
  [[nodiscard]] std::vector<std::size_t> near(std::size_t building, double reach_m) const;

 private:
  /// Of two buildings at least.
  struct TouchingGroup {
    std::vector<std::size_t> members;
    Box box;  ///< in the input's coordinates
    /// Holes of the ground that it covers, in the frame of its first member.
    std::vector<Outline> yards;
  };

  [[nodiscard]] std::vector<std::size_t> drop_repeated();
  void tell_systems();
  void unite_touching();
  void find_yards(TouchingGroup& group);
  [[nodiscard]] std::optional<std::size_t> find(const ShapedBuilding& building,
                                                const std::string& crs) const;
  [[nodiscard]] const TouchingGroup* group_of(std::size_t building) const;
  /// Whether a point of the plan, in the building's frame, is ground of another building.
  [[nodiscard]] bool is_on_other(const Neighbourhood& of, Vec3 from) const;
  /// Whether the first building on the way, itself left out, is one of its group.
  [[nodiscard]] bool meets_group(const Neighbourhood& of, Vec3 from, Vec3 along) const;
  [[nodiscard]] std::vector<std::size_t> near_boxes(const StandingBuilding& own,
                                                    std::optional<std::size_t> self) const;

  std::vector<StandingBuilding> standing_;
  std::unique_ptr<detail::ShapeStore> shapes_;
  std::vector<std::string> keys_;  ///< hashes, as buildings were added, until finish()
  std::map<std::string, std::size_t> repeated_;  ///< by hash, those whose id others have, too
  std::map<std::string, int> systems_;
  std::vector<std::size_t> by_place_;
  std::optional<BoxTree> tree_;  ///< in the input's coordinates, seen from above: z = 0
  std::vector<int> group_of_;    ///< by building; -1: it touches none
  std::vector<TouchingGroup> groups_;
  std::string sha256_;
  std::vector<Issue> issues_;
};

}  // namespace oriel
