#include "control/external/external_controller.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include "control/external/host/wire.h"

namespace ambrig {

namespace {

ControllerLink Reach(const ExternalSettings& s) {
  try {
    return s.library.empty() ? ControllerLink::Connect(s.address, s.timeout)
                             : ControllerLink::Start(s.library, s.timeout);
  } catch (const ControllerFailure& e) {
    throw InputError(fmt::format("{} = \"{}\": {}", s.where, s.name, e.what()));
  }
}

template <class T>
void AppendBytes(std::vector<unsigned char>& to, const T* from, std::size_t count) {
  const auto* begin = reinterpret_cast<const unsigned char*>(from);
  to.insert(to.end(), begin, begin + count * sizeof(T));
}

}  // namespace

ExternalController::ExternalController(const ExternalSettings& settings, const ControllerSite& site)
    : settings_(settings), site_(site), none_(site.axes.size(), 0.0), link_(Reach(settings)) {
  for (const ControllerSite::Bearing& b : site_.bearings) {
    Bearing mine{b.index, b.coils.size(), {}, {}};
    for (int j = 0; j < kLanes; ++j) mine.limit[j] = b.i_max;
    coils_ += mine.coils;
    bearings_.push_back(mine);
  }
  coil_values_.assign(3 * coils_, 0.0);
  SetUp();
}

void ExternalController::Fail(const std::string& text) const {
  throw InputError(fmt::format("{} = \"{}\": {}", settings_.where, settings_.name, text));
}

void ExternalController::SetUp() {
  std::string text;
  const auto add = [&text](const std::string& name) { text.append(name.c_str(), name.size() + 1); };
  std::vector<double> numbers{site_.period};
  for (const double f : site_.f_max) numbers.push_back(f);
  for (const std::string& axis : site_.axes) add(axis);
  for (const ControllerSite::Bearing& b : site_.bearings)
    for (const std::string& coil : b.coils) {
      add(b.name + "." + coil);
      numbers.push_back(b.i_max);
    }
  for (const double p : settings_.parameters) numbers.push_back(p);
  for (const std::string& name : settings_.parameter_names) add(name);
  const wire_setup setup{WIRE_MAGIC,
                         WIRE_VERSION,
                         static_cast<std::uint32_t>(site_.axes.size()),
                         static_cast<std::uint32_t>(coils_),
                         static_cast<std::uint32_t>(settings_.parameters.size()),
                         static_cast<std::uint32_t>(text.size())};
  std::vector<unsigned char> payload;
  AppendBytes(payload, &setup, 1);
  AppendBytes(payload, numbers.data(), numbers.size());
  AppendBytes(payload, text.data(), text.size());
  try {
    link_.Ask(WIRE_SETUP, payload);
  } catch (const ControllerFailure& e) {
    Fail(e.what());
  }
}

void ExternalController::Observe(const std::vector<BearingControl>& control, double t) {
  t_ = t;
  std::size_t at = 0;
  for (const Bearing& b : bearings_) {
    const BearingControl& c = control[b.index];
    for (std::size_t j = 0; j < b.coils; ++j, ++at) {
      const int lane = static_cast<int>(j);
      coil_values_[at] = c.feedback[lane];
      coil_values_[coils_ + at] = c.set_point[lane];
      coil_values_[2 * coils_ + at] = c.duty[lane];
    }
  }
}

void ExternalController::Gather(const std::vector<double>& y, const std::vector<double>& r,
                                const std::vector<double>& excitation, double Omega,
                                const std::vector<double>* f) {
  numbers_.assign({t_, Omega});
  for (const std::vector<double>* v :
       {&y, &r, &excitation, f ? f : &none_, &std::as_const(coil_values_)})
    numbers_.insert(numbers_.end(), v->begin(), v->end());
}

ControllerLink::Answer ExternalController::Ask(std::uint32_t kind, const char* function) {
  const std::size_t bytes = numbers_.size() * sizeof(double);
  try {
    return link_.Ask(kind, {reinterpret_cast<const unsigned char*>(numbers_.data()), bytes});
  } catch (const ControllerFailure& e) {
    Fail(fmt::format("{} at t = {:.6g} s: {}", function, t_, e.what()));
  }
}

void ExternalController::TakeAnswer(const ControllerLink::Answer& answer, std::vector<double>& f) {
  const std::size_t axes = f.size();
  if (answer.kind != WIRE_FORCE || answer.payload.size() != (axes + coils_) * sizeof(double))
    Fail(fmt::format(
        "step at t = {:.6g} s: the answer has another length than {} forces and {} currents", t_,
        axes, coils_));
  answer_.resize(axes + coils_);
  std::memcpy(answer_.data(), answer.payload.data(), answer.payload.size());
  for (std::size_t k = 0; k < axes; ++k) {
    if (!std::isfinite(answer_[k]))
      Fail(fmt::format("step at t = {:.6g} s: the force of {} is {}, allowed: finite numbers", t_,
                       site_.axes[k], answer_[k]));
    f[k] = std::clamp(answer_[k], -site_.f_max[k], site_.f_max[k]);
  }
  if (!settings_.commands_currents) return;
  std::size_t at = axes;
  for (std::size_t b = 0; b < bearings_.size(); ++b)
    for (std::size_t j = 0; j < bearings_[b].coils; ++j, ++at) {
      const double i = answer_[at], most = site_.bearings[b].i_max;
      if (!std::isfinite(i))
        Fail(
            fmt::format("step at t = {:.6g} s: the current of {}.{} is {}, allowed: finite numbers",
                        t_, site_.bearings[b].name, site_.bearings[b].coils[j], i));
      bearings_[b].command[static_cast<int>(j)] =
          std::clamp(i, site_.bearings[b].unipolar ? 0.0 : -most, most);
    }
}

void ExternalController::Step(const std::vector<double>& y, const std::vector<double>& r,
                              const std::vector<double>& excitation, double Omega,
                              std::vector<double>& f) {
  Gather(y, r, excitation, Omega, nullptr);
  TakeAnswer(Ask(WIRE_STEP, "step"), f);
}

const Lane* ExternalController::SetPoints(std::size_t bearing) const {
  if (!settings_.commands_currents) return nullptr;
  for (const Bearing& b : bearings_)
    if (b.index == bearing) return &b.command;
  return nullptr;
}

void ExternalController::Hold(const std::vector<double>& force, const std::vector<double>& y,
                              const std::vector<double>& r) {
  Gather(y, r, none_, 0, &force);
  Ask(WIRE_HOLD, "hold");
}

void ExternalController::Track(const std::vector<double>& y, const std::vector<double>& r,
                               double Omega, const std::vector<double>& f) {
  Gather(y, r, none_, Omega, &f);
  Ask(WIRE_TRACK, "track");
}

StateSpace ExternalController::Linear(double) const {
  Fail("has no linear model; allowed: what simulates (run, check, campaign, compare, ...)");
}

void ExternalController::WriteC(CCode&) const {
  Fail("is no controller of ambrig's; allowed: a kind that ambrig computes itself");
}

std::unique_ptr<PositionController> ExternalController::Clone() const {
  Fail("cannot be copied in the middle of a run");
}

void ReadExternal(const TomlTable& t, const char* key, ExternalSettings& s) {
  s.where = t.Where(key);
  s.name = t.String(key);
  t.Read(s, kExternalFields);
  s.commands_currents = t.Choice("commands", "forces", "forces, currents") == "currents";
  if (const auto p = t.Table("parameters")) {
    s.parameter_names = p->Keys();
    for (const std::string& name : s.parameter_names) s.parameters.push_back(p->Number(name));
  }
}

}  // namespace ambrig
