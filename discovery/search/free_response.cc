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
#include "discovery/model/record_rows.h"
#include "rig/rig_assembly.h"
#include "rig/rig_channels.h"
#include "rotor/linear/linear_rotor.h"

namespace ambrig {

namespace {

using Series = FreeResponse::Series;

constexpr double kLowest = 20, kHighest = 2500;  // [Hz]
// Of reading and answer: magnets and gains of the model err so much.
constexpr double kRelativeError = 0.03;
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

/// Amplitudes of the lines of a series without its mean, without a window.
Series LinesOf(std::vector<double> series) {
  const auto n = static_cast<double>(series.size());
  const double mean = std::accumulate(series.begin(), series.end(), 0.0) / n;
  for (double& v : series) v = (v - mean) * 2 / n;
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

/// Lines of the model's own record; nullopt where it does not hold its rotor.
std::optional<RecordLines> OwnLines(const CaseModel& model, const Hypothesis& h, std::size_t record,
                                    const RadialBearings& bearings) {
  const std::optional<Record> simulated = model.SimulatedChannels(h, record, false, 1);
  if (!simulated) return std::nullopt;
  return LinesOfRecord(AtRowsOf(model.data().records[record].data, *simulated), bearings);
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

/// Forces, readings and the model's answer to the forces around one line in one direction, bearing
/// by bearing.
struct LineOfRecord {
  std::array<FreeResponse::Neighbours, 2> force, read, model;
};

/// `shaft` holds the model's answers at the lines k - 1, k and k + 1.
LineOfRecord LineOf(const RecordLines& lines, std::size_t k,
                    const std::array<Eigen::Matrix4cd, 3>& shaft, int direction) {
  const std::complex<double> turn(0, direction);
  LineOfRecord out;
  for (std::size_t side = 0; side < 3; ++side) {
    const std::size_t line = k + side - 1;
    Eigen::Vector4cd pull;
    for (std::size_t b = 0; b < 2; ++b) {
      const auto i = static_cast<Eigen::Index>(2 * b);
      for (std::size_t axis = 0; axis < 2; ++axis)
        pull[i + static_cast<Eigen::Index>(axis)] = lines.force[b][axis][line];
      out.force[b][side] = pull[i] + turn * pull[i + 1];
      out.read[b][side] = lines.reading[b][0][line] + turn * lines.reading[b][1][line];
    }
    const Eigen::Vector4cd answer = shaft[side] * pull;
    for (std::size_t b = 0; b < 2; ++b) {
      const auto i = static_cast<Eigen::Index>(2 * b);
      out.model[b][side] = answer[i] + turn * answer[i + 1];
    }
  }
  return out;
}

/// Appends line k of a measured record in one direction, less what the model's own record shows
/// there.
void AddLine(const RecordLines& measured, const RecordLines* own, std::size_t k,
             const std::array<Eigen::Matrix4cd, 3>& shaft, const std::array<double, 2>& noise,
             FreeResponse& out) {
  const LineOfRecord line = LineOf(measured, k, shaft, out.direction);
  const LineOfRecord known = own ? LineOf(*own, k, shaft, out.direction) : LineOfRecord();
  out.w.push_back(out.line * static_cast<double>(k));
  for (std::size_t b = 0; b < 2; ++b) {
    const std::complex<double> reading = Windowed(line.read[b]), answer = Windowed(line.model[b]);
    out.force[b].push_back(line.force[b]);
    out.missing[b].push_back(reading - answer - Windowed(known.read[b]) + Windowed(known.model[b]));
    out.scale[b].push_back(
        std::hypot(noise[b], kRelativeError * std::hypot(std::abs(reading), std::abs(answer))));
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
    const auto own = OwnLines(model, h, r, *bearings);
    const double line = 2 * kPi * record.data.rate / static_cast<double>(record.data.rows()),
                 speed = record.scenario.speed.Speed(record.data.start),
                 highest = 2 * kPi * std::min(kHighest, 0.4 * record.data.rate);
    const std::array<double, 2> noise = NoiseLines(model, r, *bearings);
    const ShaftResponse shaft(h.rig, *bearings, speed);
    FreeResponse forward, backward;
    forward.speed = backward.speed = speed;
    forward.line = backward.line = line;
    backward.direction = -1;
    const std::size_t count = lines->force[0][0].size();
    std::vector<Eigen::Matrix4cd> answer(count);
    // one line beyond the highest, as its neighbour
    for (std::size_t k = 1; k < count && line * static_cast<double>(k - 1) <= highest; ++k)
      answer[k] = shaft.At(line * static_cast<double>(k));
    for (std::size_t k = 2; k + 1 < count && line * static_cast<double>(k) <= highest; ++k) {
      const double w = line * static_cast<double>(k);
      if (w < 2 * kPi * kLowest || NearAnOrder(w, speed, line)) continue;
      for (FreeResponse* whirl : {&forward, &backward})
        AddLine(*lines, own ? &*own : nullptr, k, {answer[k - 1], answer[k], answer[k + 1]}, noise,
                *whirl);
    }
    if (forward.w.empty()) continue;
    out.push_back(std::move(forward));
    out.push_back(std::move(backward));
  }
  return out;
}

}  // namespace ambrig
