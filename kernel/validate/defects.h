#pragma once

#include "kernel/base/work.h"
#include "kernel/validate/polygons/snapped.h"
#include "kernel/validate/validate.h"

#include <cstdint>
#include <string>
#include <vector>

namespace oriel::detail {

/// What can be wrong; each has a code of oriel and the number of val3dity's error that means the
/// same.
enum class Defect {
  empty,
  too_few_points,
  repeated_point,
  ring_crosses_itself,
  rings_cross,
  rings_alike,
  off_plane,
  folded,
  polygon_in_pieces,
  hole_outside,
  holes_nested,
  holes_turned,
  too_few_polygons,
  open_shell,
  many_at_edge,
  many_at_vertex,
  shell_in_pieces,
  shell_crosses_itself,
  polygon_turned,
  one_sided,
  shells_cross,
  shells_alike,
  cavity_outside,
  solid_in_pieces,
  shell_turned,
  solids_cross,
  solids_alike,
  solids_apart,
  parts_overlap,
};

/// Of what a finding is; -1 where it is not of one.
struct Subject {
  int body = -1;
  int shell = -1;
  int polygon = -1;
  int ring = -1;
};

/// Collects findings about one building.
class FindingList {
 public:
  explicit FindingList(const SnappedBuilding& building, std::int64_t budget = kWorkBudget)
      : building_(building), work_(budget) {}

  /// Adds a finding; `sentence` is completed with the place of `vertices` (none, a point, or the
  /// ends of an edge) and val3dity's name.
  void add(Defect defect, const Subject& subject, std::string sentence,
           const std::vector<int>& vertices = {});

  /// Steps that judging took. Once they are used up nothing more is judged: what a check says then
  /// is no finding.
  void count(std::int64_t steps) { work_.add(steps); }
  [[nodiscard]] bool is_used_up() const { return work_.is_used_up(); }
  [[nodiscard]] Work& work() { return work_; }

  [[nodiscard]] std::size_t size() const { return findings_.size(); }
  [[nodiscard]] std::vector<Finding> take() { return std::move(findings_); }

 private:
  const SnappedBuilding& building_;
  Work work_;
  std::vector<Finding> findings_;
};

}  // namespace oriel::detail
