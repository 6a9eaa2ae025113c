#include "experiments/report/cells.h"

#include <cmath>

#include <fmt/format.h>

namespace oriel::report {

namespace {

constexpr const char* kNoValue = "–";
/// What is smaller than the last decimal that is shown.
constexpr double kSmallestP = 0.001;
constexpr double kSmallestDifference = 0.0005;

}  // namespace

std::string share_cell(double share) {
  return std::isnan(share) ? kNoValue : fmt::format("{:.3f}", share);
}

std::string difference_cell(double difference) {
  if (std::isnan(difference)) return kNoValue;
  return std::abs(difference) < kSmallestDifference ? "0.000" : fmt::format("{:+.3f}", difference);
}

std::string f1_cell(const ResultRow& row) {
  if (!row.f1_interval || std::isnan(row.f1) || std::isnan(row.f1_interval->low))
    return share_cell(row.f1);
  return fmt::format("{:.3f} [{:.3f}, {:.3f}]", row.f1, row.f1_interval->low,
                     row.f1_interval->high);
}

std::string difference_cell(const ResultRow& row) {
  if (!row.difference) return kNoValue;
  const PairedDifference& difference = *row.difference;
  if (std::isnan(difference.f1) || std::isnan(difference.interval.low))
    return difference_cell(difference.f1);
  return fmt::format("{} [{}, {}]", difference_cell(difference.f1),
                     difference_cell(difference.interval.low),
                     difference_cell(difference.interval.high));
}

std::string p_cell(const ResultRow& row) {
  if (!row.difference || std::isnan(row.difference->p)) return kNoValue;
  return row.difference->p < kSmallestP ? "< 0.001" : fmt::format("{:.3f}", row.difference->p);
}

}  // namespace oriel::report
