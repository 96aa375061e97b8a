#include "discovery/model/response_predictor.h"

#include <algorithm>
#include <cmath>

#include "discovery/model/run_memo.h"
#include "effects/catalogue.h"
#include "effects/plant.h"
#include "rig/rig_assembly.h"

namespace ambrig {

namespace {

using Complex = std::complex<double>;

constexpr std::size_t kKept = 32;     // tests without effects
constexpr double kNoResponse = 1e-3;  // of the response with the effects

/// How much of a plant the linear model leaves out, part by part.
std::vector<double> LeftOut(const Plant& plant, const EffectInstance& effect, bool voltage_mode) {
  std::vector<double> out;
  for (const BearingPlant& b : plant.bearings) {
    // a formula may see more of the motion than the place of the shaft
    if (effect.IsFormula()) out.push_back(static_cast<double>(b.sensor.maps.size()));
    out.push_back(static_cast<double>(std::ranges::count_if(
        b.laws, [&](const auto& law) { return !law->LinearAt(b.lanes.phi); })));
    out.push_back(b.heating.rise_per_watt);
    for (int j = 0; j < b.lanes.coils; ++j) {
      const auto k = static_cast<std::size_t>(j);
      out.push_back(static_cast<double>(b.voltage[k].size()));
      out.push_back(b.bridge[k].dead_duty);
      // without a current loop an error of the bridge is one of the current
      if (!voltage_mode) continue;
      const CurrentSensor& s = b.current_sensor[k];
      const BridgeImperfection& i = b.bridge[k];
      out.insert(out.end(), {s.gain, s.offset, i.dead_time, i.freewheel_drop, i.voltage_offset});
    }
  }
  out.push_back(plant.bus.stiff() ? 0 : 1);
  return out;
}

/// Complex values over ascending lines at f, straight between them, the ends' beyond.
Complex Between(const std::vector<double>& lines, const std::vector<Complex>& values, double f) {
  const auto above = std::ranges::upper_bound(lines, f) - lines.begin();
  if (above == 0) return values.front();
  if (above == static_cast<std::ptrdiff_t>(lines.size())) return values.back();
  const auto k = static_cast<std::size_t>(above);
  const double part = (f - lines[k - 1]) / (lines[k] - lines[k - 1]);
  return values[k - 1] + part * (values[k] - values[k - 1]);
}

}  // namespace

bool InLinearModel(const RigParameters& rig, const EffectInstance& effect) {
  RigParameters without = rig, with = rig;
  without.effects.clear();
  with.effects = {effect};
  const bool voltage_mode = rig.amplifier.voltage_mode;
  const auto left_out = [&](const RigParameters& r) {
    return LeftOut(BuildPlant(TrueRig(r)), effect, voltage_mode);
  };
  return left_out(without) == left_out(with);
}

ResponsePredictor::Split ResponsePredictor::SplitOf(const RigParameters& rig) const {
  Split out{rig, true};
  out.linear.effects.clear();
  for (const EffectInstance& e : rig.effects) {
    // what adds to readings is in no response
    if (e.IsNull() || (!e.IsFormula() && EffectNamed(e.name).adds_signal)) continue;
    const std::string key = e.name + " " + e.target + " " + e.label;
    std::unique_lock lock(mutex_);
    const auto known = in_linear_model_.find(key);
    const bool held = known != in_linear_model_.end()
                          ? known->second
                          : (in_linear_model_[key] = InLinearModel(case_.rig, e));
    if (held)
      out.linear.effects.push_back(e);
    else
      out.all = false;
  }
  return out;
}

std::vector<const MultisineMeasurement*> ResponsePredictor::Tests() const {
  // of the rig file, so that the tests do not hang on which hypothesis came first
  const Split file = SplitOf(case_.rig);
  const std::scoped_lock lock(mutex_);
  if (tests_.empty()) {
    const LinearResponses base(file.linear, case_.rig, record_.scenario);
    for (const RigResponse& r : record_.responses.responses)
      if (std::ranges::none_of(tests_,
                               [&](const auto& t) { return t->port().name == r.excited.name; }))
        tests_.push_back(
            std::make_unique<MultisineMeasurement>(case_.rig, record_, r.excited, base));
  }
  std::vector<const MultisineMeasurement*> out;
  for (const auto& t : tests_) out.push_back(t.get());
  return out;
}

std::optional<MultisineMeasurement::Spectra> ResponsePredictor::BaseTest(
    const MultisineMeasurement& test, std::size_t index, const RigParameters& linear) const {
  const std::string key = MemoKey(linear, record_, index);
  {
    const std::scoped_lock lock(mutex_);
    for (auto it = kept_.begin(); it != kept_.end(); ++it)
      if (it->key == key) {
        kept_.splice(kept_.begin(), kept_, it);
        return it->spectra;
      }
  }
  const auto spectra = test.Run(linear);
  const std::scoped_lock lock(mutex_);
  kept_.push_front({key, spectra});
  if (kept_.size() > kKept) kept_.pop_back();
  return spectra;
}

bool ResponsePredictor::Correct(const RigParameters& rig, const Split& split,
                                Responses& out) const {
  const std::vector<const MultisineMeasurement*> tests = Tests();
  for (std::size_t n = 0; n < tests.size(); ++n) {
    const auto without = BaseTest(*tests[n], n, split.linear);
    const auto with = without ? tests[n]->Run(rig) : std::nullopt;
    if (!with) return false;
    for (std::size_t r = 0; r < out.size(); ++r) {
      const std::vector<Complex>&a = (*with)[r], &b = (*without)[r];
      if (a.empty()) continue;
      // a response that is there only with the effects is added, not multiplied
      std::vector<Complex> ratio(a.size(), 1), more(a.size());
      for (std::size_t k = 0; k < a.size(); ++k)
        (std::abs(b[k]) > kNoResponse * std::abs(a[k]) ? ratio[k] : more[k]) =
            std::abs(b[k]) > kNoResponse * std::abs(a[k]) ? a[k] / b[k] : a[k] - b[k];
      for (std::size_t k = 0; k < out[r].size(); ++k) {
        const double f = record_.responses.frequency[k];
        out[r][k] *= Between(tests[n]->lines(), ratio, f);
        out[r][k] += Between(tests[n]->lines(), more, f);
      }
    }
  }
  return true;
}

ResponsePredictor::Responses ResponsePredictor::Respond(const RigParameters& rig) const {
  const Split split = SplitOf(rig);
  RigParameters drawing = case_.rig;
  drawing.amplifier.adc_samples_per_period = rig.amplifier.adc_samples_per_period;
  const LinearResponses base(split.linear, drawing, record_.scenario);
  if (!base.stable()) return {};
  const std::vector<double>& f = record_.responses.frequency;
  Responses out(record_.responses.responses.size(), std::vector<Complex>(f.size()));
  for (std::size_t k = 0; k < f.size(); ++k) {
    // points that no row looks at: beyond half the sampling rate, no number
    if (std::ranges::none_of(record_.quality, [k](const auto& q) { return q.ok[k] != 0; }))
      continue;
    const std::vector<Complex> H = base.At(f[k], record_.responses.responses);
    for (std::size_t r = 0; r < out.size(); ++r) out[r][k] = H[r];
  }
  if (!split.all && !Correct(rig, split, out)) return {};
  return out;
}

bool ResponsePredictor::Predict(const RigParameters& rig,
                                std::vector<std::vector<double>>& columns) const {
  const Responses H = Respond(rig);
  if (H.empty()) return false;
  columns.clear();
  for (std::size_t r = 0; r < H.size(); ++r) {
    const std::vector<double>& sd = record_.responses.responses[r].sd;
    columns.emplace_back();
    for (std::size_t k = 0; k < sd.size(); ++k)
      columns.back().push_back(sd[k] > 0 ? H[r][k].real() / sd[k] : 0);
    columns.emplace_back();
    for (std::size_t k = 0; k < sd.size(); ++k)
      columns.back().push_back(sd[k] > 0 ? H[r][k].imag() / sd[k] : 0);
  }
  return true;
}

}  // namespace ambrig
