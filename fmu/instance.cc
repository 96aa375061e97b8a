#include "fmu/instance.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "core/base/json_file.h"
#include "core/base/read_file.h"
#include "core/base/toml_edit.h"
#include "rig/rig_file.h"
#include "scenarios/faults/fault_file.h"

namespace ambrig {

namespace {

using Role = FmuVariable::Role;

/// A communication step ends at a period's end when this share of a period is missing.
constexpr double kRounding = 1e-6;

std::string ResourceNamed(const nlohmann::json& setup, const char* key,
                          const std::filesystem::path& resources) {
  if (!setup.is_object() || !setup.contains(key) || !setup[key].is_string())
    throw InputError(fmt::format("{}: {} is missing, allowed: the name of a file",
                                 (resources / "setup.json").string(), key));
  return (resources / setup[key].get<std::string>()).string();
}

}  // namespace

FmuInstance::FmuInstance(const std::filesystem::path& resources) {
  const nlohmann::json setup = ReadJson((resources / "setup.json").string());
  rig_ = ReadRig(ResourceNamed(setup, "rig", resources));
  scenario_ = setup.contains("scenario")
                  ? ReadScenario(ResourceNamed(setup, "scenario", resources), rig_)
                  : OpenScenario(rig_);
  variables_ = FmuVariablesOf(rig_, scenario_, SteppedRun(rig_, scenario_).outputs());
  for (std::size_t k = 0; k < variables_.size(); ++k) {
    if (variables_[k].IsOutput() && first_output_ == 0) first_output_ = k;
    if (variables_[k].role == Role::kAcceleration) acceleration_ = k;
  }
  Reset();
}

void FmuInstance::Reset() {
  run_.reset();
  state_ = {};
  for (const FmuVariable& v : variables_) state_.values.push_back(v.start);
  state_.start_values = state_.values;
  outputs_.clear();
  told_ = 0;
}

RigParameters FmuInstance::RigAsSet() const {
  std::vector<TomlEdit> edits;
  for (std::size_t k = 0; k < variables_.size(); ++k)
    if (variables_[k].role == Role::kParameter && state_.start_values[k] != variables_[k].start)
      edits.push_back({variables_[k].name, state_.start_values[k]});
  if (edits.empty()) return rig_;
  return ReadRigText(EditedToml(ReadFile(rig_.file), rig_.file, edits), rig_.file);
}

Scenario FmuInstance::ScenarioAsSet() const {
  Scenario s = scenario_;
  for (std::size_t k = 0; k < variables_.size(); ++k) {
    const double value = state_.start_values[k];
    if (variables_[k].role == Role::kSeed) s.seed = static_cast<std::uint64_t>(value);
    if (variables_[k].role == Role::kNoise) s.noise = value != 0;
    if (variables_[k].role == Role::kFaultTolerant) s.fault_tolerant = value != 0;
  }
  return s;
}

/// The run at t = 0, from state_.start_values.
void FmuInstance::Build() {
  run_ = std::make_unique<SteppedRun>(RigAsSet(), ScenarioAsSet());
  told_ = 0;
  applied_.clear();
  for (const FmuVariable& v : variables_) applied_.push_back(v.start);
  for (const std::size_t k : ChangedInputs(state_.start_values)) Apply(k, state_.start_values[k]);
  run_->Start();
  ReadOutputs();
}

/// Inputs that the run has with another value; faults last, when their numbers are known.
std::vector<std::size_t> FmuInstance::ChangedInputs(const std::vector<double>& values) const {
  std::vector<std::size_t> changed;
  for (const bool faults : {false, true})
    for (std::size_t k = 0; k < first_output_; ++k)
      if (variables_[k].IsInput() && (variables_[k].role == Role::kFault) == faults &&
          values[k] != applied_[k])
        changed.push_back(k);
  return changed;
}

/// Hands an input to the run. @throws InputError for a fault whose numbers are not allowed
void FmuInstance::Apply(std::size_t reference, double value) {
  const FmuVariable& v = variables_[reference];
  if (v.role == Role::kFault && value != 0) Happen(v);
  applied_[reference] = value;
  switch (v.role) {
    case Role::kReference:
      run_->inputs.reference[v.owner] = value;
      break;
    case Role::kForce:
      run_->inputs.force[v.owner] = value;
      break;
    case Role::kCurrent:
      run_->inputs.current[v.owner][v.index] = value;
      break;
    case Role::kLoad:
      (v.index == 0 ? run_->inputs.load[v.owner].x : run_->inputs.load[v.owner].y) = value;
      break;
    case Role::kAcceleration:  // stands before the speed: both may change at once
      run_->SetSpeed(run_->speed(), value);
      break;
    case Role::kSpeed:
      run_->SetSpeed(value, applied_[acceleration_]);
      break;
    default:
      break;
  }
}

void FmuInstance::Happen(const FmuVariable& fault) {
  // By the rules, and with the words, of a scenario file.
  std::string numbers;
  const auto at = static_cast<std::size_t>(&fault - variables_.data());
  for (std::size_t k = at + 1; k < variables_.size() && variables_[k].fault_at == at; ++k) {
    const FmuVariable& n = variables_[k];
    if (n.role != Role::kFaultNumber || applied_[k] == n.start) continue;
    const bool flag = n.type == FmuVariable::Type::kBoolean;
    numbers += fmt::format("{} = {}\n", n.key,
                           flag ? (applied_[k] != 0 ? "true" : "false") : TomlNumber(applied_[k]));
  }
  const std::string kind(fault.fault->kind);
  FaultSpec spec{0, fault.target, kind, {}, fault.name};
  ReadFault(TomlTable::FromText(fmt::format("kind = \"{}\"\n[parameters]\n{}", kind, numbers),
                                fault.name),
            kind, RigAsSet(), &spec.parameters);
  run_->AddFault(spec);
}

void FmuInstance::ReadOutputs() {
  run_->Read(outputs_);
  for (std::size_t k = first_output_; k < variables_.size(); ++k)
    state_.values[k] = outputs_[variables_[k].owner];
}

double FmuInstance::Get(std::size_t reference) {
  if (reference >= variables_.size())
    throw InputError(
        fmt::format("value reference {}, allowed: 0 to {}", reference, variables_.size() - 1));
  if (reference == 0) return state_.time;
  if (variables_[reference].IsOutput() && state_.phase == FmuPhase::kInitialising && !run_) {
    state_.start_values = state_.values;
    Build();
  }
  return state_.values[reference];
}

void FmuInstance::Set(std::size_t reference, double value) {
  if (reference >= variables_.size())
    throw InputError(
        fmt::format("value reference {}, allowed: 1 to {}", reference, variables_.size() - 1));
  const FmuVariable& v = variables_[reference];
  if (!v.IsInput() && !v.IsParameter())
    throw InputError(fmt::format("{} is no input and no parameter: it cannot be set", v.name));
  const bool before =
      state_.phase == FmuPhase::kInstantiated || state_.phase == FmuPhase::kInitialising;
  if (v.IsParameter() && !before)
    throw InputError(
        fmt::format("{} is a parameter: it can be set until the initialization ends", v.name));
  const bool allowed =
      v.role == Role::kFaultNumber ? !std::isnan(value) : std::isfinite(value) || value == v.start;
  if (!allowed || !(v.lo <= value && value <= v.hi))
    throw InputError(
        fmt::format("{} = {} {}, allowed: {} to {}", v.name, value, v.unit, v.lo, v.hi));
  if (state_.values[reference] == value) return;
  state_.values[reference] = value;
  if (before) run_.reset();
}

void FmuInstance::EnterInitialization(double start_time) {
  if (state_.phase != FmuPhase::kInstantiated)
    throw InputError("the initialization may begin once, after instantiation or reset");
  state_.phase = FmuPhase::kInitialising;
  state_.start_time = state_.time = start_time;
}

void FmuInstance::ExitInitialization() {
  if (state_.phase != FmuPhase::kInitialising)
    throw InputError("the initialization ends without having begun");
  if (!run_) {
    state_.start_values = state_.values;
    Build();
  }
  state_.phase = FmuPhase::kStepping;
}

void FmuInstance::Step(double t, double h) {
  if (state_.phase != FmuPhase::kStepping)
    throw InputError("a step is allowed after the initialization and before the end");
  const double T = run_->T();
  if (!(std::abs(t - state_.time) <= kRounding * T))
    throw InputError(fmt::format(
        "a step from t = {} s, allowed: from {} s, where the last one ended", t, state_.time));
  if (!(h >= 0) || !std::isfinite(h))
    throw InputError(fmt::format("a step of {} s, allowed: 0 s or more", h));
  for (const std::size_t k : ChangedInputs(state_.values)) {
    Apply(k, state_.values[k]);
    state_.changes.push_back({state_.period, k, state_.values[k]});
  }
  const double end = (t + h - state_.start_time) / T;
  const auto last = static_cast<long long>(std::floor(end + kRounding));
  while (run_->periods() < last) run_->Period();
  state_.period = run_->periods();
  state_.time = t + h;
  ReadOutputs();
}

void FmuInstance::Restore(const FmuState& wanted) {
  const FmuState state = wanted;  // may be a copy of state_ itself
  state_ = state;
  run_.reset();
  if (state.phase == FmuPhase::kInstantiated || state.phase == FmuPhase::kInitialising) return;
  Build();
  for (const FmuState::Change& c : state.changes) {
    while (run_->periods() < c.period) run_->Period();
    Apply(c.reference, c.value);
  }
  while (run_->periods() < state.period) run_->Period();
  ReadOutputs();
  state_.values = state.values;
  told_ = run_->events().size();
}

void FmuInstance::Terminate() {
  if (state_.phase != FmuPhase::kStepping)
    throw InputError("terminated without having been initialized");
  state_.phase = FmuPhase::kTerminated;
}

std::vector<std::string> FmuInstance::TakeEvents() {
  std::vector<std::string> lines;
  if (!run_) return lines;
  for (const std::vector<RunEvent>& events = run_->events(); told_ < events.size(); ++told_) {
    const RunEvent& e = events[told_];
    lines.push_back(fmt::format("t = {:.6g} s: {} {}{}{}", state_.start_time + e.t, e.kind,
                                e.target, e.fault_class.empty() ? "" : " ", e.fault_class));
  }
  return lines;
}

}  // namespace ambrig
