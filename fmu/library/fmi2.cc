/// The 34 functions of FMI 2.0 for co-simulation (standard of 2014, section 4.2).
#include <cstdarg>
#include <cstring>

#include "fmu/library/component.h"
#include "fmu/library/fmi2_api.h"

#define AMBRIG_FMI extern "C" __attribute__((visibility("default")))

namespace ambrig {
namespace {

using Type = FmuVariable::Type;

struct Component2 {
  std::unique_ptr<FmuComponent> component;
  std::string name;
  bool logging = false;
  double start_time = 0;
};

Component2* Of2(fmi2Component c) { return static_cast<Component2*>(c); }

template <class Work>
fmi2Status Do2(fmi2Component c, Work&& work) {
  if (!c) return fmi2Error;
  return Worked(Of2(c)->component.get(), std::forward<Work>(work)) ? fmi2OK : fmi2Error;
}

fmi2Status NotProvided(fmi2Component c, const char* what) {
  return Do2(c, [what](FmuInstance&) { throw InputError(what); });
}

/// @throws InputError for a variable of another type.
void CheckType(const FmuInstance& fmu, fmi2ValueReference r, Type type, const char* words) {
  if (r < fmu.variables().size() && fmu.variables()[r].type != type)
    throw InputError(fmu.variables()[r].name + " is not " + words);
}

template <class Value>
fmi2Status GetValues(fmi2Component c, const fmi2ValueReference* r, std::size_t n, Value* values,
                     Type type, const char* words) {
  return Do2(c, [&](FmuInstance& fmu) {
    for (std::size_t k = 0; k < n; ++k) {
      CheckType(fmu, r[k], type, words);
      values[k] = static_cast<Value>(fmu.Get(r[k]));
    }
  });
}

template <class Value>
fmi2Status SetValues(fmi2Component c, const fmi2ValueReference* r, std::size_t n,
                     const Value* values, Type type, const char* words) {
  return Do2(c, [&](FmuInstance& fmu) {
    for (std::size_t k = 0; k < n; ++k) {
      CheckType(fmu, r[k], type, words);
      fmu.Set(r[k], type == Type::kBoolean ? (values[k] != 0 ? 1.0 : 0.0)
                                           : static_cast<double>(values[k]));
    }
  });
}

}  // namespace
}  // namespace ambrig

using namespace ambrig;  // NOLINT: the functions below belong to the standard

AMBRIG_FMI const char* fmi2GetTypesPlatform() { return "default"; }
AMBRIG_FMI const char* fmi2GetVersion() { return "2.0"; }

AMBRIG_FMI fmi2Status fmi2SetDebugLogging(fmi2Component c, fmi2Boolean on, std::size_t,
                                          const fmi2String*) {
  if (!c) return fmi2Error;
  Of2(c)->component->events = on != 0;
  return fmi2OK;
}

AMBRIG_FMI fmi2Component fmi2Instantiate(fmi2String name, fmi2Type type, fmi2String guid,
                                         fmi2String resources,
                                         const fmi2CallbackFunctions* functions, fmi2Boolean,
                                         fmi2Boolean logging) {
  auto made = std::make_unique<Component2>();
  made->name = name ? name : "";
  const fmi2CallbackFunctions f = functions ? *functions : fmi2CallbackFunctions{};
  const auto tell = [f, owner = made.get()](FmuComponent::Told told, const std::string& text) {
    const bool error = told == FmuComponent::Told::kError;
    if (f.logger)
      f.logger(f.componentEnvironment, owner->name.c_str(), error ? fmi2Error : fmi2OK,
               error ? "logStatusError" : "logEvents", "%s", text.c_str());
  };
  try {
    if (type != fmi2CoSimulation) throw InputError("fmuType, allowed: fmi2CoSimulation");
    if (!guid || !resources)
      throw InputError("fmi2Instantiate needs fmuGUID and fmuResourceLocation");
    made->component = FmuComponent::Make(FolderOfUri(resources), guid, tell);
    made->component->events = logging != 0;
  } catch (const std::exception& e) {
    tell(FmuComponent::Told::kError, e.what());
    return nullptr;
  }
  return made.release();
}

AMBRIG_FMI void fmi2FreeInstance(fmi2Component c) { delete Of2(c); }

AMBRIG_FMI fmi2Status fmi2SetupExperiment(fmi2Component c, fmi2Boolean, fmi2Real, fmi2Real start,
                                          fmi2Boolean, fmi2Real) {
  return Do2(c, [&](FmuInstance& fmu) {
    if (fmu.phase() != FmuPhase::kInstantiated)
      throw InputError("fmi2SetupExperiment is allowed before the initialization");
    Of2(c)->start_time = start;
  });
}

AMBRIG_FMI fmi2Status fmi2EnterInitializationMode(fmi2Component c) {
  return Do2(c, [&](FmuInstance& fmu) { fmu.EnterInitialization(Of2(c)->start_time); });
}
AMBRIG_FMI fmi2Status fmi2ExitInitializationMode(fmi2Component c) {
  return Do2(c, [](FmuInstance& fmu) { fmu.ExitInitialization(); });
}
AMBRIG_FMI fmi2Status fmi2Terminate(fmi2Component c) {
  return Do2(c, [](FmuInstance& fmu) { fmu.Terminate(); });
}
AMBRIG_FMI fmi2Status fmi2Reset(fmi2Component c) {
  return Do2(c, [](FmuInstance& fmu) { fmu.Reset(); });
}

AMBRIG_FMI fmi2Status fmi2GetReal(fmi2Component c, const fmi2ValueReference* r, std::size_t n,
                                  fmi2Real* values) {
  return GetValues(c, r, n, values, Type::kReal, "a Real");
}
AMBRIG_FMI fmi2Status fmi2GetInteger(fmi2Component c, const fmi2ValueReference* r, std::size_t n,
                                     fmi2Integer* values) {
  return GetValues(c, r, n, values, Type::kInteger, "an Integer");
}
AMBRIG_FMI fmi2Status fmi2GetBoolean(fmi2Component c, const fmi2ValueReference* r, std::size_t n,
                                     fmi2Boolean* values) {
  return GetValues(c, r, n, values, Type::kBoolean, "a Boolean");
}
AMBRIG_FMI fmi2Status fmi2GetString(fmi2Component c, const fmi2ValueReference*, std::size_t n,
                                    fmi2String*) {
  return n == 0 && c ? fmi2OK : NotProvided(c, "the FMU has no String");
}
AMBRIG_FMI fmi2Status fmi2SetReal(fmi2Component c, const fmi2ValueReference* r, std::size_t n,
                                  const fmi2Real* values) {
  return SetValues(c, r, n, values, Type::kReal, "a Real");
}
AMBRIG_FMI fmi2Status fmi2SetInteger(fmi2Component c, const fmi2ValueReference* r, std::size_t n,
                                     const fmi2Integer* values) {
  return SetValues(c, r, n, values, Type::kInteger, "an Integer");
}
AMBRIG_FMI fmi2Status fmi2SetBoolean(fmi2Component c, const fmi2ValueReference* r, std::size_t n,
                                     const fmi2Boolean* values) {
  return SetValues(c, r, n, values, Type::kBoolean, "a Boolean");
}
AMBRIG_FMI fmi2Status fmi2SetString(fmi2Component c, const fmi2ValueReference*, std::size_t n,
                                    const fmi2String*) {
  return n == 0 && c ? fmi2OK : NotProvided(c, "the FMU has no String");
}

AMBRIG_FMI fmi2Status fmi2GetFMUstate(fmi2Component c, fmi2FMUstate* state) {
  return Do2(c, [&](FmuInstance& fmu) {
    if (*state)
      *static_cast<FmuState*>(*state) = fmu.state();
    else
      *state = new FmuState(fmu.state());
  });
}
AMBRIG_FMI fmi2Status fmi2SetFMUstate(fmi2Component c, fmi2FMUstate state) {
  return Do2(c, [&](FmuInstance& fmu) {
    if (!state) throw InputError("fmi2SetFMUstate: no state");
    fmu.Restore(*static_cast<const FmuState*>(state));
  });
}
AMBRIG_FMI fmi2Status fmi2FreeFMUstate(fmi2Component, fmi2FMUstate* state) {
  if (!state) return fmi2OK;
  delete static_cast<FmuState*>(*state);
  *state = nullptr;
  return fmi2OK;
}
AMBRIG_FMI fmi2Status fmi2SerializedFMUstateSize(fmi2Component c, fmi2FMUstate state,
                                                 std::size_t* size) {
  return Do2(c, [&](FmuInstance&) {
    if (!state) throw InputError("fmi2SerializedFMUstateSize: no state");
    *size = static_cast<const FmuState*>(state)->Bytes().size();
  });
}
AMBRIG_FMI fmi2Status fmi2SerializeFMUstate(fmi2Component c, fmi2FMUstate state, fmi2Byte* bytes,
                                            std::size_t size) {
  return Do2(c, [&](FmuInstance&) {
    const std::string text = state ? static_cast<const FmuState*>(state)->Bytes() : "";
    if (!state || size < text.size())
      throw InputError("fmi2SerializeFMUstate: no state, or no room for it");
    std::memcpy(bytes, text.data(), text.size());
  });
}
AMBRIG_FMI fmi2Status fmi2DeSerializeFMUstate(fmi2Component c, const fmi2Byte* bytes,
                                              std::size_t size, fmi2FMUstate* state) {
  return Do2(c, [&](FmuInstance& fmu) {
    *state = new FmuState(FmuState::FromBytes(std::string(bytes, size), fmu.variables().size()));
  });
}

AMBRIG_FMI fmi2Status fmi2GetDirectionalDerivative(fmi2Component c, const fmi2ValueReference*,
                                                   std::size_t, const fmi2ValueReference*,
                                                   std::size_t, const fmi2Real*, fmi2Real*) {
  return NotProvided(c, "directional derivatives are not provided");
}

/// Of the speed: its acceleration.
AMBRIG_FMI fmi2Status fmi2SetRealInputDerivatives(fmi2Component c, const fmi2ValueReference* r,
                                                  std::size_t n, const fmi2Integer* order,
                                                  const fmi2Real* values) {
  return Do2(c, [&](FmuInstance& fmu) {
    for (std::size_t k = 0; k < n; ++k) {
      const bool speed =
          r[k] < fmu.variables().size() && fmu.variables()[r[k]].role == FmuVariable::Role::kSpeed;
      if (!speed || order[k] != 1)
        throw InputError("an input's derivative, allowed: the first one of speed");
      fmu.Set(r[k] - 1, values[k]);  // FmuVariable::Role::kAcceleration stands before it
    }
  });
}
AMBRIG_FMI fmi2Status fmi2GetRealOutputDerivatives(fmi2Component c, const fmi2ValueReference*,
                                                   std::size_t, const fmi2Integer*, fmi2Real*) {
  return NotProvided(c, "derivatives of outputs are not provided (maxOutputDerivativeOrder = 0)");
}

AMBRIG_FMI fmi2Status fmi2DoStep(fmi2Component c, fmi2Real t, fmi2Real h, fmi2Boolean) {
  const fmi2Status status = Do2(c, [&](FmuInstance& fmu) { fmu.Step(t, h); });
  if (c) Of2(c)->component->TellEvents();
  return status;
}
AMBRIG_FMI fmi2Status fmi2CancelStep(fmi2Component c) {
  return NotProvided(c, "fmi2CancelStep: no step is pending (canRunAsynchronuously = false)");
}

AMBRIG_FMI fmi2Status fmi2GetStatus(fmi2Component c, fmi2StatusKind, fmi2Status*) {
  return c ? fmi2Discard : fmi2Error;  // no step is ever pending
}
AMBRIG_FMI fmi2Status fmi2GetRealStatus(fmi2Component c, fmi2StatusKind kind, fmi2Real* value) {
  if (!c) return fmi2Error;
  if (kind != fmi2LastSuccessfulTime) return fmi2Discard;
  *value = Of2(c)->component->fmu->time();
  return fmi2OK;
}
AMBRIG_FMI fmi2Status fmi2GetIntegerStatus(fmi2Component c, fmi2StatusKind, fmi2Integer*) {
  return c ? fmi2Discard : fmi2Error;
}
AMBRIG_FMI fmi2Status fmi2GetBooleanStatus(fmi2Component c, fmi2StatusKind kind,
                                           fmi2Boolean* value) {
  if (!c) return fmi2Error;
  if (kind != fmi2Terminated) return fmi2Discard;
  *value = 0;
  return fmi2OK;
}
AMBRIG_FMI fmi2Status fmi2GetStringStatus(fmi2Component c, fmi2StatusKind, fmi2String*) {
  return c ? fmi2Discard : fmi2Error;
}
