/// FMI 3.0: functions that modelDescription.xml says this FMU does not provide. They are there, as
/// the standard asks, and answer with an error that says why.
#include "fmu/library/fmi3_api.h"

using namespace ambrig;  // NOLINT: the functions below belong to the standard

namespace {
constexpr const char* kNoModelExchange = "model exchange is not provided, only co-simulation";
constexpr const char* kNoScheduled = "scheduled execution is not provided, only co-simulation";
constexpr const char* kNoEventMode = "the FMU has no event mode (hasEventMode = false)";
constexpr const char* kNoClock = "the FMU has no clock";
constexpr const char* kNoDerivative = "derivatives are not provided";
constexpr const char* kNoDependencies = "dependencies are not provided at run time";
constexpr const char* kNoStructure = "the FMU has no structural parameter";
using Reference = fmi3ValueReference;
}  // namespace

AMBRIG_FMI fmi3Instance fmi3InstantiateModelExchange(fmi3String, fmi3String, fmi3String, bool, bool,
                                                     fmi3InstanceEnvironment environment,
                                                     fmi3LogMessageCallback log) {
  if (log) log(environment, fmi3Error, "logStatusError", kNoModelExchange);
  return nullptr;
}
AMBRIG_FMI fmi3Instance fmi3InstantiateScheduledExecution(fmi3String, fmi3String, fmi3String, bool,
                                                          bool, fmi3InstanceEnvironment environment,
                                                          fmi3LogMessageCallback log, void*, void*,
                                                          void*) {
  if (log) log(environment, fmi3Error, "logStatusError", kNoScheduled);
  return nullptr;
}

AMBRIG_FMI fmi3Status fmi3EnterEventMode(fmi3Instance c) { return NotProvided3(c, kNoEventMode); }
AMBRIG_FMI fmi3Status fmi3EnterStepMode(fmi3Instance c) { return NotProvided3(c, kNoEventMode); }
AMBRIG_FMI fmi3Status fmi3EvaluateDiscreteStates(fmi3Instance c) {
  return NotProvided3(c, kNoEventMode);
}
AMBRIG_FMI fmi3Status fmi3UpdateDiscreteStates(fmi3Instance c, bool*, bool*, bool*, bool*, bool*,
                                               double*) {
  return NotProvided3(c, kNoEventMode);
}
AMBRIG_FMI fmi3Status fmi3EnterConfigurationMode(fmi3Instance c) {
  return NotProvided3(c, kNoStructure);
}
AMBRIG_FMI fmi3Status fmi3ExitConfigurationMode(fmi3Instance c) {
  return NotProvided3(c, kNoStructure);
}

AMBRIG_FMI fmi3Status fmi3GetNumberOfVariableDependencies(fmi3Instance c, Reference, std::size_t*) {
  return NotProvided3(c, kNoDependencies);
}
AMBRIG_FMI fmi3Status fmi3GetVariableDependencies(fmi3Instance c, Reference, std::size_t*,
                                                  Reference*, std::size_t*, fmi3DependencyKind*,
                                                  std::size_t) {
  return NotProvided3(c, kNoDependencies);
}
AMBRIG_FMI fmi3Status fmi3GetDirectionalDerivative(fmi3Instance c, const Reference*, std::size_t,
                                                   const Reference*, std::size_t, const double*,
                                                   std::size_t, double*, std::size_t) {
  return NotProvided3(c, kNoDerivative);
}
AMBRIG_FMI fmi3Status fmi3GetAdjointDerivative(fmi3Instance c, const Reference*, std::size_t,
                                               const Reference*, std::size_t, const double*,
                                               std::size_t, double*, std::size_t) {
  return NotProvided3(c, kNoDerivative);
}
AMBRIG_FMI fmi3Status fmi3GetOutputDerivatives(fmi3Instance c, const Reference*, std::size_t,
                                               const std::int32_t*, double*, std::size_t) {
  return NotProvided3(c, kNoDerivative);
}

AMBRIG_FMI fmi3Status fmi3GetIntervalDecimal(fmi3Instance c, const Reference*, std::size_t, double*,
                                             fmi3IntervalQualifier*) {
  return NotProvided3(c, kNoClock);
}
AMBRIG_FMI fmi3Status fmi3GetIntervalFraction(fmi3Instance c, const Reference*, std::size_t,
                                              std::uint64_t*, std::uint64_t*,
                                              fmi3IntervalQualifier*) {
  return NotProvided3(c, kNoClock);
}
AMBRIG_FMI fmi3Status fmi3GetShiftDecimal(fmi3Instance c, const Reference*, std::size_t, double*) {
  return NotProvided3(c, kNoClock);
}
AMBRIG_FMI fmi3Status fmi3GetShiftFraction(fmi3Instance c, const Reference*, std::size_t,
                                           std::uint64_t*, std::uint64_t*) {
  return NotProvided3(c, kNoClock);
}
AMBRIG_FMI fmi3Status fmi3SetIntervalDecimal(fmi3Instance c, const Reference*, std::size_t,
                                             const double*) {
  return NotProvided3(c, kNoClock);
}
AMBRIG_FMI fmi3Status fmi3SetIntervalFraction(fmi3Instance c, const Reference*, std::size_t,
                                              const std::uint64_t*, const std::uint64_t*) {
  return NotProvided3(c, kNoClock);
}
AMBRIG_FMI fmi3Status fmi3SetShiftDecimal(fmi3Instance c, const Reference*, std::size_t,
                                          const double*) {
  return NotProvided3(c, kNoClock);
}
AMBRIG_FMI fmi3Status fmi3SetShiftFraction(fmi3Instance c, const Reference*, std::size_t,
                                           const std::uint64_t*, const std::uint64_t*) {
  return NotProvided3(c, kNoClock);
}
AMBRIG_FMI fmi3Status fmi3ActivateModelPartition(fmi3Instance c, Reference, double) {
  return NotProvided3(c, kNoScheduled);
}

AMBRIG_FMI fmi3Status fmi3EnterContinuousTimeMode(fmi3Instance c) {
  return NotProvided3(c, kNoModelExchange);
}
AMBRIG_FMI fmi3Status fmi3CompletedIntegratorStep(fmi3Instance c, bool, bool*, bool*) {
  return NotProvided3(c, kNoModelExchange);
}
AMBRIG_FMI fmi3Status fmi3SetTime(fmi3Instance c, double) {
  return NotProvided3(c, kNoModelExchange);
}
AMBRIG_FMI fmi3Status fmi3SetContinuousStates(fmi3Instance c, const double*, std::size_t) {
  return NotProvided3(c, kNoModelExchange);
}
AMBRIG_FMI fmi3Status fmi3GetContinuousStateDerivatives(fmi3Instance c, double*, std::size_t) {
  return NotProvided3(c, kNoModelExchange);
}
AMBRIG_FMI fmi3Status fmi3GetEventIndicators(fmi3Instance c, double*, std::size_t) {
  return NotProvided3(c, kNoModelExchange);
}
AMBRIG_FMI fmi3Status fmi3GetContinuousStates(fmi3Instance c, double*, std::size_t) {
  return NotProvided3(c, kNoModelExchange);
}
AMBRIG_FMI fmi3Status fmi3GetNominalsOfContinuousStates(fmi3Instance c, double*, std::size_t) {
  return NotProvided3(c, kNoModelExchange);
}
AMBRIG_FMI fmi3Status fmi3GetNumberOfEventIndicators(fmi3Instance c, std::size_t* count) {
  if (count) *count = 0;
  return c ? fmi3OK : fmi3Error;
}
AMBRIG_FMI fmi3Status fmi3GetNumberOfContinuousStates(fmi3Instance c, std::size_t* count) {
  if (count) *count = 0;
  return c ? fmi3OK : fmi3Error;
}
