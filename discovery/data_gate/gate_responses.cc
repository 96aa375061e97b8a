// Which frequency responses of a record err grossly, and what is told of them.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/math/constants.h"
#include "discovery/data_gate/gate_columns.h"
#include "discovery/data_gate/gate_points.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;

constexpr double kGrossOfResponse = 0.25;  // relative error, whatever the noise
constexpr double kLeftOfRecord =
    0.15;  // of the relative error, that other frequencies or axes leave
constexpr std::size_t kFewestPoints = 6;
constexpr double kLeastRelativeSd = 1e-3;  // so that no point decides alone

/// Point k counts where both parts do and the model says something of it.
bool Counts(const CaseModel& model, const std::vector<double>& predicted, const Target& re,
            const Target& im, std::size_t k) {
  return model.ok()[re.first + k] && model.ok()[im.first + k] &&
         std::isfinite(predicted[re.first + k]) && std::isfinite(predicted[im.first + k]);
}

/// The sd of point k over its magnitude; 0: the point cannot count.
double RelativeSd(const RigResponse& r, std::size_t k) {
  const double size = std::abs(r.values[k]);
  return r.sd[k] > 0 && size > 0 ? std::max(kLeastRelativeSd, r.sd[k] / size) : 0;
}

/// Point k of `response`, at its frequency [Hz], beside what is expected of it over its sd.
void AddPoint(const RigResponse& response, std::size_t k, double frequency, Complex expected,
              GateResponse& out) {
  out.frequency.push_back(frequency);
  out.measured.push_back(response.values[k]);
  out.expected.push_back(response.sd[k] * expected);
  out.weight.push_back(std::pow(RelativeSd(response, k), -2));
}

/// From its two targets, the real part's and the imaginary part's.
GateResponse ResponseOf(const CaseModel& model, const std::vector<double>& predicted,
                        const Target& re, const Target& im) {
  const CaseRecord& record = model.data().records[re.record];
  const RigResponse& response = record.responses.responses[re.channel / 2];
  GateResponse out;
  out.index = re.channel / 2;
  double square = 0, weights = 0;
  for (std::size_t k = 0; k < re.count; ++k) {
    if (!Counts(model, predicted, re, im, k) || RelativeSd(response, k) == 0) continue;
    const Complex p(predicted[re.first + k], predicted[im.first + k]);  // over its sd
    AddPoint(response, k, record.responses.frequency[k], p, out);
    square += std::norm(response.values[k] / response.sd[k] - p) / 2;
    weights += out.weight.back();
  }
  const auto points = static_cast<double>(out.frequency.size());
  if (points == 0) return out;
  out.floors = response.sd_known ? std::sqrt(square / points) / re.floor : kInfinity;
  // a weight is one over the squared noise of its point
  out.noise = response.sd_known ? re.floor * std::sqrt(points / weights) : 0;
  return out;
}

std::vector<GateResponse> ResponsesOf(const CaseModel& model, const std::vector<double>& predicted,
                                      std::size_t record) {
  std::vector<GateResponse> out;
  const std::vector<Target>& all = model.targets();
  for (std::size_t t = 0; t + 1 < all.size(); ++t)
    if (all[t].record == record && all[t + 1].record == record && all[t].channel % 2 == 0 &&
        all[t + 1].channel == all[t].channel + 1)
      out.push_back(ResponseOf(model, predicted, all[t], all[t + 1]));
  return out;
}

bool IsGross(const GateResponse& r) {
  return r.frequency.size() >= kFewestPoints && r.floors > kGrossError &&
         RelativeError(r, r.expected) > kGrossOfResponse;
}

/// The record as if its frequencies stood for others, `factor` times too large as written.
CaseRecord WithFrequenciesOver(const CaseRecord& r, double factor, const RigParameters& rig) {
  CaseRecord out = r;
  const double nyquist =
      0.5 * (r.scenario.start == StartState::kClamped ? rig.amplifier.switching_frequency
                                                      : rig.controller.rate);
  for (double& f : out.responses.frequency) f /= factor;
  for (std::size_t c = 0; c < out.quality.size(); ++c)
    for (std::size_t k = 0; k < out.quality[c].ok.size(); ++k) {
      const double f = out.responses.frequency[k];
      out.quality[c].ok[k] =
          std::isfinite(out.data.channels[c].samples[k]) && f > 0 && f < 0.98 * nyquist ? 1 : 0;
    }
  return out;
}

/// The responses of `record` beside what the model expects of them; empty where it cannot say.
std::vector<GateResponse> PredictedResponses(const CaseModel& model, const Hypothesis& h,
                                             const CaseRecord& record) {
  std::vector<std::vector<double>> columns;
  if (!MakePredictor(model.data(), record)->Predict(h.rig, columns)) return {};
  std::vector<GateResponse> out;
  for (std::size_t n = 0; n < record.responses.responses.size(); ++n) {
    const RigResponse& response = record.responses.responses[n];
    GateResponse r;
    r.index = n;
    for (std::size_t k = 0; k < response.sd.size(); ++k) {
      if (record.quality[2 * n].ok[k] && record.quality[2 * n + 1].ok[k] &&
          RelativeSd(response, k) > 0)
        AddPoint(response, k, record.responses.frequency[k],
                 Complex(columns[2 * n][k], columns[2 * n + 1][k]), r);
    }
    out.push_back(std::move(r));
  }
  return out;
}

/// The record with its response `index` alone, once for every other axis that could be its output.
CaseRecord WithOtherAxes(const CaseRecord& r, std::size_t index, const RigParameters& rig) {
  const RigResponse& from = r.responses.responses[index];
  CaseRecord out = r;
  out.responses.responses.clear();
  out.data.channels.clear();
  out.quality.clear();
  if (!from.output.name.starts_with(from.output.axis)) return out;
  for (const BearingParameters& b : rig.bearings)
    for (const std::string& axis : b.Axes()) {
      const auto other =
          ParseResponsePoint(rig, axis + from.output.name.substr(from.output.axis.size()));
      if (axis == from.output.axis || !other || other->kind != from.output.kind) continue;
      out.responses.responses.push_back(from);
      out.responses.responses.back().output = *other;
      for (const std::size_t part : {2 * index, 2 * index + 1}) {
        out.data.channels.push_back(r.data.channels[part]);
        out.quality.push_back(r.quality[part]);
      }
    }
  return out;
}

/// The same of another axis: a cable at the wrong input of the analyser. `shown` is that response.
ResponseMistake OtherAxisOf(const CaseModel& model, const Hypothesis& h, std::size_t record,
                            const GateResponse& r, RigResponse* shown) {
  const CaseRecord others = WithOtherAxes(model.data().records[record], r.index, model.data().rig);
  ResponseMistake best;
  best.left = kLeftOfRecord;
  if (others.responses.responses.empty()) return best;
  const double before = RelativeError(r, r.expected);
  for (const GateResponse& as : PredictedResponses(model, h, others)) {
    const double left = RelativeError(as, as.expected) / before;
    if (as.frequency.size() < kFewestPoints || left >= best.left) continue;
    *shown = others.responses.responses[as.index];
    best = {"swap", shown->name(), 1, 0, left};
  }
  return best;
}

/// rms of the relative errors of responses.
double ErrorOfAll(const std::vector<GateResponse>& all) {
  double sum = 0;
  for (const GateResponse& r : all) sum += std::pow(RelativeError(r, r.expected), 2);
  return std::sqrt(sum / static_cast<double>(std::max<std::size_t>(1, all.size())));
}

/// The factor of the record's frequencies that leaves the least of all responses together.
struct FrequencyMistake {
  double factor = 1, left = 1;
};
FrequencyMistake FrequenciesOf(const CaseModel& model, const Hypothesis& h, std::size_t record,
                               const std::vector<GateResponse>& all) {
  FrequencyMistake best{1, kLeftOfRecord};
  const double before = ErrorOfAll(all);
  for (const double factor : {2 * kPi, 1 / (2 * kPi), 60.0, 1 / 60.0, 1e3, 1e-3}) {
    const std::vector<GateResponse> other = PredictedResponses(
        model, h, WithFrequenciesOver(model.data().records[record], factor, model.data().rig));
    const bool enough = !other.empty() && std::ranges::all_of(other, [](const GateResponse& r) {
      return r.frequency.size() >= kFewestPoints;
    });
    const double left = enough ? ErrorOfAll(other) / before : 1;
    if (left < best.left) best = {factor, left};
  }
  return best;
}

/// The line of the case file that undoes a mistake; empty where none can.
std::string ResponseLine(const RigResponse& r, const ResponseMistake& mistake) {
  TraceMapping m = r.from;
  if (mistake.with == kConjugate) {
    m.conjugate = !m.conjugate;
    m.late = -m.late;  // is undone before it
  } else if (mistake.with == kPhase && mistake.factor < 1) {
    m.phase_gain /= mistake.factor;
  } else if (mistake.fault == "lag") {
    m.late += mistake.seconds;
  } else if (mistake.with.empty()) {
    m.gain /= mistake.factor;
  } else if (mistake.fault != "swap") {
    return "";  // phases beyond a turn, powers of magnitudes: the file lost what they were
  }
  std::string keys = fmt::format("trace = \"{}\"", m.trace);
  const auto name = [&](const char* key, const std::string& value) {
    if (!value.empty()) keys += fmt::format(", {} = \"{}\"", key, value);
  };
  const auto number = [&](const char* key, double value, double usual) {
    if (value != usual) keys += fmt::format(", {} = {:.9g}", key, value);
  };
  name("unit", m.unit);
  name("excited", r.input.port() ? "" : r.excited.name);
  name("coherence", m.coherence);
  if (m.conjugate) keys += ", conjugate = true";
  number("phase_gain", m.phase_gain, 1);
  number("late", m.late, 0);
  number("gain", m.gain, 1);
  return fmt::format("responses.\"{}\" = {{ {} }}", r.name(), keys);
}

}  // namespace

void CheckResponses(const CaseModel& model, const std::vector<double>& predicted,
                    const Hypothesis& h, std::size_t record, std::vector<DataFault>& out) {
  const CaseRecord& r = model.data().records[record];
  const std::vector<GateResponse> all = ResponsesOf(model, predicted, record);
  std::vector<std::pair<const GateResponse*, ResponseMistake>> gross;
  double least = 1;  // that mistakes of each response leave
  for (const GateResponse& response : all) {
    if (!IsGross(response)) continue;
    const bool quotient = !r.responses.responses[response.index].input.port();
    gross.emplace_back(&response, MistakeOf(response, quotient));
    least = std::min(least, gross.back().second.left);
  }
  if (gross.empty()) return;
  // all responses of a file share its frequencies
  const FrequencyMistake f = FrequenciesOf(model, h, record, all);
  if (f.factor != 1 && f.left < least) {
    DataFault fault = FaultLeaving(r, "frequency", "unit", f.left);
    fault.factor = f.factor;
    fault.mend = fmt::format("frequency_gain = {:.9g}", r.responses.frequency_gain / f.factor);
    out.push_back(fault);
    return;
  }
  for (auto& [response, mistake] : gross) {
    RigResponse of = r.responses.responses[response->index];
    const std::string name = of.name();
    if (mistake.fault.empty()) mistake = OtherAxisOf(model, h, record, *response, &of);
    if (mistake.fault.empty()) continue;
    DataFault fault = FaultLeaving(r, name, mistake.fault, mistake.left);
    fault.factor = mistake.factor;
    fault.seconds = mistake.seconds;
    fault.with = mistake.with;
    fault.mend = ResponseLine(of, mistake);
    out.push_back(fault);
  }
}

}  // namespace ambrig
