#include "control/kinds/feedback_linearisation.h"

namespace ambrig {

namespace {

/// Readings of all axes -> place (x, y) in the plane of bearing `of`. A rigid rotor is c + z tilt
/// in either plane; one radial bearing alone, or an axial one, is where its own sensor reads.
Eigen::Matrix2Xd PlaceFromReadings(const ControllerSite& site, std::size_t of) {
  std::vector<std::size_t> first;  // axis of each radial bearing
  std::vector<double> sensor_z;
  std::size_t axis = 0, own = 0;
  for (std::size_t k = 0; k < site.bearings.size(); ++k) {
    const ControllerSite::Bearing& b = site.bearings[k];
    if (k == of) own = axis;
    if (b.radial) {
      first.push_back(axis);
      sensor_z.push_back(b.sensor_z);
    }
    axis += b.radial ? 2 : 1;
  }
  Eigen::Matrix2Xd place = Eigen::Matrix2Xd::Zero(2, static_cast<Eigen::Index>(axis));
  const ControllerSite::Bearing& b = site.bearings[of];
  Eigen::MatrixX2d arms(static_cast<Eigen::Index>(sensor_z.size()), 2);
  for (Eigen::Index k = 0; k < arms.rows(); ++k)
    arms.row(k) << 1, sensor_z[static_cast<std::size_t>(k)];
  const auto fit = arms.completeOrthogonalDecomposition();
  if (!b.radial || fit.rank() < 2) {
    for (Eigen::Index side = 0; side < (b.radial ? 2 : 1); ++side)
      place(side, static_cast<Eigen::Index>(own) + side) = 1;
    return place;
  }
  const Eigen::RowVectorXd share = Eigen::RowVector2d(1, b.z) * fit.pseudoInverse();
  for (Eigen::Index k = 0; k < arms.rows(); ++k)
    for (Eigen::Index side = 0; side < 2; ++side)
      place(side, static_cast<Eigen::Index>(first[static_cast<std::size_t>(k)]) + side) = share[k];
  return place;
}

}  // namespace

FeedbackLinearisation::FeedbackLinearisation(std::vector<PidParameters> axes,
                                             const ControllerSite& site)
    : pid_(std::move(axes), site.period) {
  std::size_t first = 0;
  for (std::size_t k = 0; k < site.bearings.size(); ++k) {
    const ControllerSite::Bearing& b = site.bearings[k];
    const std::size_t count = b.radial ? 2 : 1;
    bearings_.push_back(
        {b.index, first, count, site.inverse(b.index), {}, PlaceFromReadings(site, k)});
    first += count;
  }
}

void FeedbackLinearisation::Invert(const std::vector<double>& y, const std::vector<double>& f) {
  const Eigen::Map<const Eigen::VectorXd> readings(y.data(), static_cast<Eigen::Index>(y.size()));
  for (Bearing& b : bearings_)
    b.set_points = b.inverse.currents({f[b.first], b.axes > 1 ? f[b.first + 1] : 0},
                                      b.place_from_y * readings);
}

void FeedbackLinearisation::Step(const std::vector<double>& y, const std::vector<double>& r,
                                 const std::vector<double>& excitation, double Omega,
                                 std::vector<double>& f) {
  pid_.Step(y, r, excitation, Omega, f);
  Invert(y, f);
}

const Lane* FeedbackLinearisation::SetPoints(std::size_t bearing) const {
  for (const Bearing& b : bearings_)
    if (b.index == bearing) return &b.set_points;
  return nullptr;
}

void FeedbackLinearisation::Hold(const std::vector<double>& force, const std::vector<double>& y,
                                 const std::vector<double>& r) {
  pid_.Hold(force, y, r);
  Invert(y, force);
}

StateSpace FeedbackLinearisation::Linear(double Omega) const {
  StateSpace s = pid_.Linear(Omega);
  for (const Bearing& b : bearings_) {
    const auto n = static_cast<Eigen::Index>(b.axes), at = static_cast<Eigen::Index>(b.first);
    s.D.middleRows(at, n) -=
        b.inverse.negative_stiffness.topLeftCorner(n, n) * b.place_from_y.topRows(n);
  }
  return s;
}

}  // namespace ambrig
