/// FMI 3.0 for co-simulation (standard of 2022, section 4): life of an instance, steps, states.
#include <cstring>

#include "fmu/library/fmi3_api.h"

using namespace ambrig;  // NOLINT: the functions below belong to the standard

AMBRIG_FMI const char* fmi3GetVersion() { return "3.0"; }

AMBRIG_FMI fmi3Status fmi3SetDebugLogging(fmi3Instance c, bool on, std::size_t, const fmi3String*) {
  return Do3(c, [&](FmuInstance&) { static_cast<FmuComponent*>(c)->events = on; });
}

AMBRIG_FMI fmi3Instance fmi3InstantiateCoSimulation(fmi3String, fmi3String token,
                                                    fmi3String resources, bool, bool logging, bool,
                                                    bool, const fmi3ValueReference*,
                                                    std::size_t intermediate,
                                                    fmi3InstanceEnvironment environment,
                                                    fmi3LogMessageCallback log, void*) {
  const auto tell = [=](FmuComponent::Told told, const std::string& text) {
    const bool error = told == FmuComponent::Told::kError;
    if (log)
      log(environment, error ? fmi3Error : fmi3OK, error ? "logStatusError" : "logEvents",
          text.c_str());
  };
  try {
    if (!token || !resources)
      throw InputError("fmi3InstantiateCoSimulation needs instantiationToken and resourcePath");
    if (intermediate > 0)
      throw InputError(
          "requiredIntermediateVariables, allowed: none (providesIntermediateUpdate = false)");
    auto made = FmuComponent::Make(FolderOfUri(resources), token, tell);
    made->events = logging;
    return made.release();
  } catch (const std::exception& e) {
    tell(FmuComponent::Told::kError, e.what());
    return nullptr;
  }
}

AMBRIG_FMI void fmi3FreeInstance(fmi3Instance c) { delete static_cast<FmuComponent*>(c); }

AMBRIG_FMI fmi3Status fmi3EnterInitializationMode(fmi3Instance c, bool, double, double start, bool,
                                                  double) {
  return Do3(c, [start](FmuInstance& fmu) { fmu.EnterInitialization(start); });
}
AMBRIG_FMI fmi3Status fmi3ExitInitializationMode(fmi3Instance c) {
  return Do3(c, [](FmuInstance& fmu) { fmu.ExitInitialization(); });
}
AMBRIG_FMI fmi3Status fmi3Terminate(fmi3Instance c) {
  return Do3(c, [](FmuInstance& fmu) { fmu.Terminate(); });
}
AMBRIG_FMI fmi3Status fmi3Reset(fmi3Instance c) {
  return Do3(c, [](FmuInstance& fmu) { fmu.Reset(); });
}

AMBRIG_FMI fmi3Status fmi3DoStep(fmi3Instance c, double t, double h, bool, bool* event,
                                 bool* terminate, bool* early, double* last) {
  if (event) *event = false;
  if (terminate) *terminate = false;
  if (early) *early = false;
  const fmi3Status status = Do3(c, [&](FmuInstance& fmu) { fmu.Step(t, h); });
  if (!c) return status;
  auto* component = static_cast<FmuComponent*>(c);
  if (last) *last = component->fmu->time();
  component->TellEvents();
  return status;
}

AMBRIG_FMI fmi3Status fmi3GetFMUState(fmi3Instance c, fmi3FMUState* state) {
  return Do3(c, [&](FmuInstance& fmu) {
    if (*state)
      *static_cast<FmuState*>(*state) = fmu.state();
    else
      *state = new FmuState(fmu.state());
  });
}
AMBRIG_FMI fmi3Status fmi3SetFMUState(fmi3Instance c, fmi3FMUState state) {
  return Do3(c, [&](FmuInstance& fmu) {
    if (!state) throw InputError("fmi3SetFMUState: no state");
    fmu.Restore(*static_cast<const FmuState*>(state));
  });
}
AMBRIG_FMI fmi3Status fmi3FreeFMUState(fmi3Instance, fmi3FMUState* state) {
  if (!state) return fmi3OK;
  delete static_cast<FmuState*>(*state);
  *state = nullptr;
  return fmi3OK;
}
AMBRIG_FMI fmi3Status fmi3SerializedFMUStateSize(fmi3Instance c, fmi3FMUState state,
                                                 std::size_t* size) {
  return Do3(c, [&](FmuInstance&) {
    if (!state) throw InputError("fmi3SerializedFMUStateSize: no state");
    *size = static_cast<const FmuState*>(state)->Bytes().size();
  });
}
AMBRIG_FMI fmi3Status fmi3SerializeFMUState(fmi3Instance c, fmi3FMUState state, std::uint8_t* bytes,
                                            std::size_t size) {
  return Do3(c, [&](FmuInstance&) {
    const std::string text = state ? static_cast<const FmuState*>(state)->Bytes() : "";
    if (!state || size < text.size())
      throw InputError("fmi3SerializeFMUState: no state, or no room for it");
    std::memcpy(bytes, text.data(), text.size());
  });
}
AMBRIG_FMI fmi3Status fmi3DeserializeFMUState(fmi3Instance c, const std::uint8_t* bytes,
                                              std::size_t size, fmi3FMUState* state) {
  return Do3(c, [&](FmuInstance& fmu) {
    const std::string text(reinterpret_cast<const char*>(bytes), size);
    *state = new FmuState(FmuState::FromBytes(text, fmu.variables().size()));
  });
}
