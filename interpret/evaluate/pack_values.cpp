#include "interpret/evaluate/pack_values.h"

#include "interpret/evaluate/arithmetic.h"

#include <algorithm>
#include <utility>

namespace oriel::rules {

namespace {

std::vector<double> stated_in(const Pack& pack) {
  std::vector<double> params;
  params.reserve(pack.params.size());
  for (const Param& param : pack.params) params.push_back(param.value);
  return params;
}

}  // namespace

PackValues::PackValues(const Pack& pack) : PackValues(pack, stated_in(pack)) {}

PackValues::PackValues(const Pack& pack, std::vector<double> values) : params(std::move(values)) {
  read_settings(pack);
}

void PackValues::set(const Pack& pack, std::size_t param, double value) {
  params[param] = value;
  read_settings(pack);
}

void PackValues::read_settings(const Pack& pack) {
  static_cast<PackSettings&>(*this) = {};
  const auto read = [&](ExprId id, double& value) {
    if (id != kNoExpr) value = fold(pack, id, params).value_or(value);
  };
  const auto read_range = [&](const HostRange& written, AngleRange& range) {
    read(written.low, range.low_deg);
    read(written.high, range.high_deg);
  };
  read_range(pack.hosts.wall, wall);
  read_range(pack.hosts.roof, roof);
  read_range(pack.hosts.ground, ground);
  read(pack.hosts.ground_reach, ground_reach_m);
  read(pack.decide.min_score, min_score);
  read(pack.decide.ambiguous_below, ambiguous_below);
  read(pack.decide.evidence.most, evidence);
}

bool PackValues::has_overlapping_hosts() const {
  const auto overlap = [](const AngleRange& p, const AngleRange& q) {
    return std::max(p.low_deg, q.low_deg) < std::min(p.high_deg, q.high_deg);
  };
  return overlap(wall, roof) || overlap(wall, ground) || overlap(roof, ground);
}

CountRange PackValues::count_of(const Pack& pack, const Typical& typical) const {
  CountRange range;
  range.low = static_cast<int>(fold(pack, typical.low, params).value_or(0));
  if (typical.high != kNoExpr)
    range.high = static_cast<int>(fold(pack, typical.high, params).value_or(0));
  return range;
}

AngleRange PackValues::range_of(HostKind kind) const {
  if (kind == HostKind::wall) return wall;
  return kind == HostKind::roof ? roof : ground;
}

HostKind PackValues::kind_of_facet(double inclination_deg) const {
  const auto is_in = [&](const AngleRange& r) {
    return inclination_deg >= r.low_deg && inclination_deg <= r.high_deg;
  };
  if (is_in(wall)) return HostKind::wall;
  if (is_in(roof)) return HostKind::roof;
  return is_in(ground) ? HostKind::ground : HostKind::none;
}

}  // namespace oriel::rules
