#include "analysis/transfer_function.h"

#include <fmt/format.h>
#include <algorithm>
#include <cmath>

#include "analysis/closed_loop_modes.h"
#include "core/math/constants.h"
#include "core/record/channels.h"

namespace ambrig {

namespace {
using Complex = std::complex<double>;
using Eigen::Index;
using Eigen::MatrixXcd;
using Eigen::VectorXcd;
}  // namespace

TransferFunction::TransferFunction(const OperatingPoint& point, const ClosedLoop& loop)
    : loop_(loop), axes_(point.Axes()) {
  for (const PlantCoil& c : loop.plant().coils)
    coils_.push_back(
        ChannelId{ChannelKind::kCoilCurrent, point.rig().bearings[c.bearing].name, c.lane}.name());
  const Index m = loop.plant().m();
  plane_rows_.resize(2 * static_cast<Index>(point.rig().stations.size()), m);
  for (const ShaftPlane& p : point.rig().stations) {
    plane_rows_.middleRows<2>(static_cast<Index>(planes_.size())) =
        ShaftRows(point, loop.plant(), p.z);
    for (const char* side : {".x", ".y"}) planes_.push_back(p.name + side);
  }
  Eigen::MatrixXd C = Eigen::MatrixXd::Zero(loop.C.rows() + plane_rows_.rows(), loop.states());
  C.topRows(loop.C.rows()) = loop.C;
  C.bottomLeftCorner(plane_rows_.rows(), m) = plane_rows_ * loop.scale().head(m).asDiagonal();
  system_ = SampledSystem(loop.Phi, loop.Gamma, C);
  D_.setZero(C.rows(), loop.D.cols());
  D_.topRows(loop.D.rows()) = loop.D.cast<Complex>();
}

MatrixXcd TransferFunction::operator()(double omega) const {
  return system_.At(std::polar(1.0, omega * loop_.Ts())) + D_;
}

MatrixXcd TransferFunction::operator()(double omega, const std::vector<Index>& columns) const {
  return system_.At(std::polar(1.0, omega * loop_.Ts()), columns) + D_(Eigen::all, columns);
}

VectorXcd TransferFunction::Harmonic(const HarmonicInput& in) const {
  return system_.Under(std::polar(1.0, in.omega * loop_.Ts()), loop_.Disturbance(in));
}

VectorXcd TransferFunction::LoadOn(Index axis) const {
  for (const LinearPort& p : loop_.plant().rotor.ports) {
    if (axis < p.gap.rows()) return p.gap.row(axis).transpose().cast<Complex>();
    axis -= p.gap.rows();
  }
  if (axis < plane_rows_.rows()) return plane_rows_.row(axis).transpose().cast<Complex>();
  throw std::logic_error("an axis of the rig");
}

TransferFunction::Input TransferFunction::FindInput(const std::string& channel) const {
  for (Index a = 0; a < loop_.axes(); ++a) {
    const std::string& axis = axes_[static_cast<std::size_t>(a)];
    if (channel == axis + ".reference") return {loop_.Reference(a), false, "m"};
    if (channel == axis + ".force") return {loop_.Excitation(a), false, "N"};
    if (channel == axis + ".sensor") return {loop_.SensorError(a), false, "m"};
    if (channel == axis + ".load") return {a, true, "N"};
  }
  for (std::size_t p = 0; p < planes_.size(); ++p)
    if (channel == planes_[p] + ".load") return {loop_.axes() + static_cast<Index>(p), true, "N"};
  throw InputError(
      fmt::format("input channel \"{}\", allowed: .reference, .force, .sensor or .load of {}{}",
                  channel, fmt::join(axes_, ", "),
                  planes_.empty() ? "" : fmt::format("; .load of {}", fmt::join(planes_, ", "))));
}

TransferFunction::Output TransferFunction::FindOutput(const std::string& channel) const {
  for (Index a = 0; a < loop_.axes(); ++a) {
    const std::string& axis = axes_[static_cast<std::size_t>(a)];
    if (channel == axis) return {loop_.Reading(a), "m"};
    if (channel == axis + ".command") return {loop_.Command(a), "N"};
    if (channel == axis + ".shaft") return {loop_.Position(a), "m"};
    if (channel == axis + ".magnet") return {loop_.Force(a), "N"};
  }
  for (std::size_t c = 0; c < coils_.size(); ++c)
    if (channel == coils_[c]) return {loop_.Current(static_cast<Index>(c)), "A"};
  for (std::size_t p = 0; p < planes_.size(); ++p)
    if (channel == planes_[p]) return {loop_.C.rows() + static_cast<Index>(p), "m"};
  throw InputError(
      fmt::format("output channel \"{}\", allowed: {} alone or with .command, .shaft, .magnet; a "
                  "coil's current as {}{}",
                  channel, fmt::join(axes_, ", "), coils_.empty() ? "A.i1" : coils_.front(),
                  planes_.empty() ? "" : fmt::format("; {}", fmt::join(planes_, ", "))));
}

Complex TransferFunction::Between(const Input& in, const Output& out, double omega) const {
  if (in.load) return Harmonic({omega, LoadOn(in.column)})(out.row);
  return (*this)(omega)(out.row, in.column);
}

std::vector<double> FrequencyGrid(const TransferFunction& transfer, double low, double high,
                                  int count) {
  std::vector<double> f;
  for (int k = 0; k < count; ++k) f.push_back(low * std::pow(high / low, k / (count - 1.0)));
  for (const Complex& z : transfer.eigenvalues()) {
    const Complex s = std::log(z) / transfer.loop().Ts();
    const double centre = s.imag() / (2 * kPi), half = std::abs(s.real()) / (2 * kPi);
    if (!(centre > low && centre < high) || half > 0.3 * centre) continue;
    // Equal arcs of the circle that the resonance draws in the complex plane.
    for (int k = -16; k <= 16; ++k)
      if (const double at = centre + half * std::tan(k * kPi / 36); at > low && at < high)
        f.push_back(at);
  }
  std::sort(f.begin(), f.end());
  f.erase(std::unique(f.begin(), f.end()), f.end());
  return f;
}

}  // namespace ambrig
