#include "faulttolerance/supervision/fault_supervisor.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/coil_name.h"
#include "faulttolerance/redistribution/redistribution_setup.h"
#include "faulttolerance/supervision/stator_settings.h"
#include "faulttolerance/supervision/watched_bearing.h"
#include "rig/clearance.h"
#include "rig/parameters/bearing_kind.h"
#include "rig/rig_figures.h"

namespace ambrig {

namespace {

constexpr double kBusSag = 0.9;  // of the nominal bus
// of the nominal bus, half the way to a sag: no noise may go it [sd]
constexpr double kBusUncertainty = 0.05, kBusNoise = 6;
constexpr double kProbeCurrent = 0.4;  // of a coil's bias current
constexpr double kCalm = 0.2;          // of the clearance: motion while idle coils are probed
constexpr double kIdleCurrent = 0.15;  // of it: a coil that works, but shows nothing
// of it, of a bearing that has lost turns: a coil that is idle no more
constexpr double kBusyCurrent = 0.25;

}  // namespace

FaultSupervisor::FaultSupervisor(const NominalRig& nominal, const FaultSupervisorOptions& options)
    : rig_(nominal),
      options_(options),
      T_(1 / nominal->amplifier.switching_frequency),
      feed_(rig_) {
  const AmplifierParameters& a = rig_->amplifier;
  // Mean of as many readings as their noise asks for: one, of a quiet one.
  const double noisy = kBusNoise * a.bus_noise / (kBusUncertainty * a.bus_voltage);
  bus_weight_ = 1 / std::max(1.0, noisy * noisy);
  bus_ = a.bus_voltage;
  for (const BearingParameters& b : rig_->bearings) {
    CheckWhatStatorsAllow(*rig_, b, options.redistribution);
    auto w = std::make_unique<Watched>();
    w->bearing = &b;
    w->index = watched_.size();
    w->bias = BiasCurrent(*rig_, b);
    w->detector =
        MakeRunDetector(rig_->detection.kind, rig_->detection.where, RunDetectorSetupOf(rig_, b));
    watched_.push_back(std::move(w));
  }
}

FaultSupervisor::~FaultSupervisor() = default;

void FaultSupervisor::WatchBus(double t, double reading, std::vector<RunEvent>& events) {
  const double nominal = rig_->amplifier.bus_voltage;
  const double bus = bus_ += bus_weight_ * (reading - bus_);
  if (!bus_sagged_ && bus < kBusSag * nominal) {
    bus_sagged_ = true;
    events.push_back({t, "detected", "rig", "", 0});
    events.push_back({t, "classified", "rig", ToText(FaultClass::kBusSag), 0});
  } else if (bus_sagged_ && bus > 0.5 * (1 + kBusSag) * nominal) {
    bus_sagged_ = false;
    events.push_back({t, "alarm_cleared", "rig", ToText(FaultClass::kBusSag), 0});
  }
}

void FaultSupervisor::WatchPositions(const PeriodMeasurement& m, std::vector<RunEvent>& events) {
  const double t = m.t + T_;
  for (const std::string& name : feed_.TakeFaultyAxes()) {
    events.push_back({t, "detected", name, "", 0});
    events.push_back({t, "classified", name, ToText(FaultClass::kPositionSensor), 0});
  }
}

void FaultSupervisor::AfterPeriod(const PeriodMeasurement& m,
                                  const std::vector<BearingControl>& control,
                                  SupervisorOutput& out) {
  const double bus = m.bearings.front().bus;
  feed_.Read(m);
  WatchBus(m.t + T_, bus, out.events);
  WatchPositions(m, out.events);
  for (std::size_t k = 0; k < watched_.size(); ++k) WatchBearing(k, m, control[k], out);
  interfered_ = interfered_ || !out.actions.empty();
  if (options_.slopes) TraceSlopes(m.t);
}

void FaultSupervisor::WatchBearing(std::size_t k, const PeriodMeasurement& m,
                                   const BearingControl& control, SupervisorOutput& out) {
  Watched& w = *watched_[k];
  std::vector<RunEvent>& events = out.events;
  w.mapped = m.bearings[k].mapped;
  MeasuredPeriod in = feed_.Period(k, m);
  in.set_point = &control.commanded;
  const DetectorAlarm alarm = w.detector->Period(in);
  coil_periods_ += w.bearing->coils();
  const double t = m.t + T_;
  ++w.periods;
  if (w.detector->doubtful()) {
    ++w.doubtful_periods;
    Doubt(w, t, events);
  }
  if (options_.redistribute) {
    Probe(w, t, in, m.position_loop, control, out);
    if (m.position_loop) TakeOutDerated(w, t, control, out);
    if (alarm.carrying >= 0) FollowCarried(w, alarm, t, m.position_loop, control, out);
  }
  if (alarm.coil < 0) return;
  const std::string name = CoilName(w.bearing->name, alarm.coil);
  if (alarm.raised) w.alarmed = alarm.coil;
  if (alarm.diagnosis.cls != FaultClass::kNone && alarm.coil != w.alarmed) {
    if (w.alarmed >= 0)
      events.push_back({t, "alarm_cleared", CoilName(w.bearing->name, w.alarmed), "", 0});
    events.push_back({t, "detected", name, "", 0});
  }
  if (alarm.diagnosis.cls != FaultClass::kNone || alarm.cleared) w.alarmed = -1;
  if (alarm.raised) {
    events.push_back({t, "detected", name, "", 0});
    if (first_alarm_ < 0) {
      first_alarm_ = t;
      alarm_bearing_ = k;
      alarm_coil_ = alarm.coil;
    }
  }
  if (alarm.cleared) events.push_back({t, "alarm_cleared", name, "", 0});
  if (alarm.restored > 0 && options_.redistribute)
    Restore(w, alarm.coil, alarm.restored, t, "turns that carry", m.position_loop, control, out);
  if (alarm.diagnosis.cls == FaultClass::kNone) return;
  events.push_back({t, "classified", name, ToText(alarm.diagnosis.cls), alarm.diagnosis.fraction});
  for (const Diagnosis& d : alarm.more) {
    events.push_back({t, "detected", CoilName(w.bearing->name, d.coil), "", 0});
    events.push_back(
        {t, "classified", CoilName(w.bearing->name, d.coil), ToText(d.cls), d.fraction});
  }
  if (!options_.redistribute || w.detector->doubtful()) return;
  ActOn(alarm, w, t, m.position_loop, control, out);
}

void FaultSupervisor::ActOn(const DetectorAlarm& alarm, Watched& w, double t, bool position_loop,
                            const BearingControl& control, SupervisorOutput& out) {
  if (alarm.diagnosis.cls == FaultClass::kCurrentSensor && w.probes.OtherFalseCurrent(alarm.coil)) {
    Doubt(w, t, out.events);
    Refuse(w, alarm.diagnosis);
    for (const Diagnosis& d : alarm.more) Refuse(w, d);
    return;
  }
  if (NothingElseCarries(w, alarm, control)) {
    out.events.push_back({t, "not_redistributed", w.bearing->name, "nothing else carries", 0});
    Refuse(w, alarm.diagnosis);
    return;
  }
  Disable(w, alarm.diagnosis, out);
  for (const Diagnosis& d : alarm.more) Disable(w, d, out);
  // Set-points that come from outside are not spread over other coils.
  if (position_loop) Redistribute(w, t, control, out);
}

void FaultSupervisor::Doubt(Watched& w, double t, std::vector<RunEvent>& events) {
  if (w.doubtful) return;
  w.doubtful = doubtful_ = true;
  events.push_back({t, "doubtful", w.bearing->name, "model doubtful", 0});
}

void FaultSupervisor::Refuse(Watched& w, const Diagnosis& d) {
  w.detector->SetTurns(d.coil, w.turns_left[d.coil]);
}

void FaultSupervisor::Probe(Watched& w, double t, const MeasuredPeriod& in, bool position_loop,
                            const BearingControl& control, SupervisorOutput& out) {
  if (in.comparable) w.probes.Orbit(t, in.x1, in.y1);
  const bool calm = w.probes.Motion() < kCalm * ClearanceOf(*w.bearing);
  const bool reduced = w.turns_left.minCoeff() < 1;
  for (int j = 0; j < control.coils; ++j) {
    const bool works = w.turns_left[j] > 0 && position_loop && !in.uncertainty.any();
    // The noise of a command near the limit would put every probe off.
    const double limit = reduced && w.probes.idle(j) ? kBusyCurrent : kIdleCurrent;
    w.probes.Idle(j, works && calm && control.commanded[j] < limit * w.bias, t);
  }
  const int coil = w.probed;
  if (coil < 0) {
    const int due = in.comparable ? w.probes.Due(t) : -1;
    w.doubted = w.detector->doubtful();
    if (due < 0 || !w.detector->BeginProbe(due)) return;
    w.probed = due;
    const double current = kProbeCurrent * w.bias;
    CurrentRegulator held = control.regulator[static_cast<std::size_t>(due)];
    held.HoldCurrent(current, CoilResistance(*w.bearing));
    out.actions.push_back(SetIntegral{w.index, due, held.integral()});
    out.actions.push_back(ProbeCoil{w.index, due, current});
    return;
  }
  const ProbeAnswer answer = w.detector->Probed();
  if (answer == ProbeAnswer::kNone) return;
  if (w.turns_left[coil] > 0) {
    EndIdleProbe(w, coil, t, control, out);
    return;
  }
  const bool disputed = answer == ProbeAnswer::kHealthy && w.probes.FalseCurrent(coil) && w.doubted;
  const bool healthy = answer == ProbeAnswer::kHealthy && !disputed;
  if (disputed) w.probes.Dispute(coil);
  w.probed = -1;
  w.detector->EndProbe(healthy, t);
  w.probes.Answer(coil, healthy, t);
  out.actions.push_back(ProbeCoil{w.index, coil, 0});
  const bool interrupted = answer == ProbeAnswer::kInterrupted;
  actions_.push_back({t, CoilName(w.bearing->name, coil), "probe",
                      healthy       ? "healthy"
                      : interrupted ? "interrupted"
                                    : "faulty"});
  if (healthy) Restore(w, coil, 1, t, "healthy when probed", position_loop, control, out);
}

void FaultSupervisor::EndIdleProbe(Watched& w, int coil, double t, const BearingControl& control,
                                   SupervisorOutput& out) {
  w.probed = -1;
  w.probes.AnswerIdle(coil, t);
  const Diagnosis found = w.detector->EndProbe(false, t);
  CurrentRegulator held = control.regulator[static_cast<std::size_t>(coil)];
  held.HoldCurrent(control.commanded[coil], CoilResistance(*w.bearing));
  out.actions.push_back(EnableCoil{w.index, coil});
  out.actions.push_back(SetIntegral{w.index, coil, held.integral()});
  if (found.cls == FaultClass::kNone) return;
  const std::string name = CoilName(w.bearing->name, coil);
  actions_.push_back({t, name, "probe", "faulty"});
  // A coil that carries nothing is told without a model; the rest says nothing in doubt.
  const bool no_current = found.cls == FaultClass::kOpen || found.cls == FaultClass::kAmplifierOff;
  if (w.doubted && !no_current) {
    Refuse(w, found);
    return;
  }
  out.events.push_back({t, "detected", name, "", 0});
  out.events.push_back({t, "classified", name, ToText(found.cls), found.fraction});
  Disable(w, found, out);
  Redistribute(w, t, control, out);
}

void FaultSupervisor::Restore(Watched& w, int coil, double turns, double t,
                              const std::string& reason, bool position_loop,
                              const BearingControl& control, SupervisorOutput& out) {
  const std::string name = CoilName(w.bearing->name, coil);
  turns = std::max(turns, w.turns_left[coil]);
  w.turns_left[coil] = turns;
  out.actions.push_back(EnableCoil{w.index, coil});
  out.events.push_back({t, "restored", name, reason, 1 - turns});
  actions_.push_back({t, name, "restore", fmt::format("{}, {:.3f} of the turns", reason, turns)});
  if (position_loop) Redistribute(w, t, control, out);
}

}  // namespace ambrig
