#include "control/position/feedback_linearisation.h"

namespace ambrig {

FeedbackLinearisation::FeedbackLinearisation(std::vector<PidParameters> axes,
                                             const ControllerSite& site)
    : pid_(std::move(axes), site.period) {
  std::size_t first = 0;
  for (const ControllerSite::Bearing& b : site.bearings) {
    const std::size_t count = b.radial ? 2 : 1;
    bearings_.push_back({b.index, first, count, site.inverse(b.index), {}});
    first += count;
  }
}

void FeedbackLinearisation::Invert(const std::vector<double>& y, const std::vector<double>& f) {
  for (Bearing& b : bearings_) {
    const bool planar = b.axes > 1;
    b.set_points = b.inverse.currents({f[b.first], planar ? f[b.first + 1] : 0},
                                      {y[b.first], planar ? y[b.first + 1] : 0});
  }
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
    s.D.block(at, at, n, n) -= b.inverse.negative_stiffness.topLeftCorner(n, n);
  }
  return s;
}

}  // namespace ambrig
