#include "discovery/search/free_response.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>

#include "core/math/constants.h"
#include "core/math/fft.h"
#include "core/record/missing_samples.h"
#include "discovery/model/magnetic_force.h"
#include "rig/rig_assembly.h"
#include "rig/rig_channels.h"
#include "rotor/motion/linear_rotor.h"

namespace ambrig {

namespace {

using Series = FreeResponse::Series;

constexpr double kLowest = 20, kHighest = 2500;  // [Hz]
constexpr double kRelativeError =
    0.03;  // of reading and answer: magnets and gains of the model err so much
// of the answer of a free mass, over (w/line)²: a window spreads a line where the answer goes with 1/w²
constexpr double kLeakage = 8;
constexpr int kOrders = 3;         // of the speed, where an unbalance and its like may act
constexpr double kOrderLines = 4;  // lines beside an order that a Hann window fills

bool TurnsSteadily(const Scenario& s, double from, double to) {
  constexpr int kParts = 20;
  for (int k = 1; k <= kParts; ++k)
    if (std::abs(s.speed.Speed(from + (to - from) * k / kParts) - s.speed.Speed(from)) > 1e-6)
      return false;
  return s.speed_free_from > to;
}

bool IsFree(const CaseRecord& r) {
  return !r.validate && OverTime(r) && r.scenario.start == StartState::kLevitated &&
         r.scenario.loads.empty() && r.scenario.faults.empty() && r.data.rows() > 64 &&
         TurnsSteadily(r.scenario, r.data.start, r.data.TimeAt(r.data.rows() - 1));
}

/// Amplitudes of the lines of a series without its mean, through a Hann window.
Series LinesOf(std::vector<double> series) {
  const auto n = static_cast<double>(series.size());
  const double mean = std::accumulate(series.begin(), series.end(), 0.0) / n;
  for (std::size_t k = 0; k < series.size(); ++k)
    series[k] = (series[k] - mean) * (1 - std::cos(2 * kPi * static_cast<double>(k) / n)) * 2 / n;
  return RealFft(series);
}

/// Lines of a record: forces and readings in both directions, bearing by bearing.
struct RecordLines {
  std::array<std::array<Series, 2>, 2> force, reading;  // [bearing][x, y]
};

std::optional<RecordLines> LinesOfRecord(const Record& data, const RadialBearings& bearings) {
  const Record d = BridgeMissing(data, 0, [](const std::string&) { return true; }).record;
  std::array<std::array<const Channel*, 2>, 2> reading{};
  for (std::size_t k = 0; k < 2; ++k) {
    const auto ids = ChannelsOf(*bearings[k], ChannelKind::kReading);
    for (std::size_t side = 0; side < 2; ++side) {
      reading[k][side] = ids.size() == 2 ? Find(d, ids[side]) : nullptr;
      if (!reading[k][side]) return std::nullopt;
    }
  }
  const double from = bearings[0]->sensor.z, span = bearings[1]->sensor.z - from;
  RecordLines out;
  for (std::size_t k = 0; k < 2; ++k) {
    const double share = (bearings[k]->z - from) / span;
    std::array<std::vector<double>, 2> at;
    for (std::size_t side = 0; side < 2; ++side)
      for (std::size_t row = 0; row < d.rows(); ++row)
        at[side].push_back((1 - share) * reading[0][side]->samples[row] +
                           share * reading[1][side]->samples[row]);
    const auto force = MagneticForce(d, *bearings[k], at[0], at[1]);
    if (!force) return std::nullopt;
    out.force[k] = {LinesOf(force->x), LinesOf(force->y)};
    for (std::size_t side = 0; side < 2; ++side)
      out.reading[k][side] = LinesOf(reading[k][side]->samples);
  }
  return out;
}

bool NearAnOrder(double w, double speed, double line) {
  for (int order = 1; order <= kOrders && speed > 0; ++order)
    if (std::abs(w - order * speed) < kOrderLines * line) return true;
  return false;
}

/// The model's shaft: readings under forces at its two radial bearings, (x, y) each.
class ShaftResponse {
 public:
  ShaftResponse(const RigParameters& rig, const RadialBearings& bearings, double speed)
      : linear_(LinearRotorOf(BuildPlant(TrueRig(rig)), speed)), speed_(speed) {
    for (const BearingParameters* b : bearings)
      ports_.push_back(*std::find_if(linear_.ports.begin(), linear_.ports.end(),
                                     [&](const LinearPort& p) { return p.name == b->name; }));
  }

  /// [m/N], readings A.x, A.y, B.x, B.y by forces in the same order.
  Eigen::Matrix4cd At(double w) const {
    const std::complex<double> jw(0, w);
    const Eigen::MatrixXcd dynamic = -w * w * linear_.M.cast<std::complex<double>>() +
                                     jw * (linear_.D + speed_ * linear_.G) + linear_.K;
    const Eigen::PartialPivLU<Eigen::MatrixXcd> lu(dynamic);
    Eigen::Matrix4cd out;
    for (Eigen::Index k = 0; k < 2; ++k) {
      const Eigen::MatrixXcd q =
          lu.solve(ports_[static_cast<std::size_t>(k)].B.cast<std::complex<double>>());
      for (Eigen::Index s = 0; s < 2; ++s)
        out.block<2, 2>(2 * s, 2 * k) = ports_[static_cast<std::size_t>(s)].C * q;
    }
    return out;
  }

 private:
  LinearRotor linear_;
  double speed_;
  std::vector<LinearPort> ports_;
};

/// What the noise of the readings makes of a line of both directions, bearing by bearing [m].
std::array<double, 2> NoiseLines(const CaseModel& model, std::size_t record,
                                 const RadialBearings& bearings) {
  const Record& data = model.data().records[record].data;
  std::array<double, 2> noise{};
  for (std::size_t b = 0; b < 2; ++b) {
    double floor = bearings[b]->sensor.noise;
    for (const Target& t : model.targets())
      if (t.record == record && data.channels[t.channel].name ==
                                    ChannelsOf(*bearings[b], ChannelKind::kReading)[0].name())
        floor = t.floor;
    noise[b] = floor * std::sqrt(12.0 / static_cast<double>(data.rows()));  // through a Hann window
  }
  return noise;
}

/// Appends line k of a record in one direction (turn: +i or -i).
void AddLine(const RecordLines& lines, std::size_t k, double w, const Eigen::Matrix4cd& shaft,
             const std::array<double, 2>& noise, double relative, FreeResponse& out) {
  const std::complex<double> turn(0, out.direction);
  Eigen::Vector4cd force;
  for (std::size_t b = 0; b < 2; ++b) {
    force[static_cast<Eigen::Index>(2 * b)] = lines.force[b][0][k];
    force[static_cast<Eigen::Index>(2 * b + 1)] = lines.force[b][1][k];
  }
  const Eigen::Vector4cd answer = shaft * force;
  out.w.push_back(w);
  for (std::size_t b = 0; b < 2; ++b) {
    const auto i = static_cast<Eigen::Index>(2 * b);
    out.force[b].push_back(force[i] + turn * force[i + 1]);
    const std::complex<double> read = lines.reading[b][0][k] + turn * lines.reading[b][1][k],
                               model = answer[i] + turn * answer[i + 1];
    out.missing[b].push_back(read - model);
    out.scale[b].push_back(
        std::hypot(noise[b], relative * std::hypot(std::abs(read), std::abs(model))));
  }
}

}  // namespace

std::vector<FreeResponse> FreeResponses(const CaseModel& model, const Hypothesis& h) {
  std::vector<FreeResponse> out;
  const auto bearings = TwoEightPoleBearings(h.rig);
  if (!bearings || (*bearings)[0]->sensor.z == (*bearings)[1]->sensor.z) return out;
  for (std::size_t r = 0; r < model.data().records.size(); ++r) {
    const CaseRecord& record = model.data().records[r];
    if (!IsFree(record)) continue;
    const auto lines = LinesOfRecord(record.data, *bearings);
    if (!lines) continue;
    const double line = 2 * kPi * record.data.rate / static_cast<double>(record.data.rows()),
                 speed = record.scenario.speed.Speed(record.data.start),
                 highest = std::min(kHighest, 0.4 * record.data.rate);
    const std::array<double, 2> noise = NoiseLines(model, r, *bearings);
    const ShaftResponse shaft(h.rig, *bearings, speed);
    FreeResponse forward, backward;
    forward.speed = backward.speed = speed;
    forward.line = backward.line = line;
    backward.direction = -1;
    for (std::size_t k = 1; k < lines->force[0][0].size(); ++k) {
      const double w = line * static_cast<double>(k);
      if (w < 2 * kPi * kLowest || w > 2 * kPi * highest || NearAnOrder(w, speed, line)) continue;
      const Eigen::Matrix4cd at = shaft.At(w);
      const double lines_below = w / line,
                   relative = std::hypot(kRelativeError, kLeakage / (lines_below * lines_below));
      AddLine(*lines, k, w, at, noise, relative, forward);
      AddLine(*lines, k, w, at, noise, relative, backward);
    }
    if (forward.w.empty()) continue;
    out.push_back(std::move(forward));
    out.push_back(std::move(backward));
  }
  return out;
}

}  // namespace ambrig
