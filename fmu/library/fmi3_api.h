#pragma once
/// Types of FMI 3.0 (Functional Mock-up Interface, standard of 2022, "fmi3PlatformTypes" and
/// "fmi3FunctionTypes"), and what the sources of its functions share.
#include <cstddef>
#include <cstdint>

#include "fmu/library/component.h"

#define AMBRIG_FMI extern "C" __attribute__((visibility("default")))

extern "C" {

using fmi3Instance = void*;
using fmi3InstanceEnvironment = void*;
using fmi3FMUState = void*;
using fmi3ValueReference = std::uint32_t;
using fmi3String = const char*;
using fmi3Binary = const std::uint8_t*;
using fmi3Clock = bool;

enum fmi3Status { fmi3OK, fmi3Warning, fmi3Discard, fmi3Error, fmi3Fatal };
enum fmi3DependencyKind {
  fmi3Independent,
  fmi3Constant,
  fmi3Fixed,
  fmi3Tunable,
  fmi3Discrete,
  fmi3Dependent
};
enum fmi3IntervalQualifier { fmi3IntervalNotYetKnown, fmi3IntervalUnchanged, fmi3IntervalChanged };

using fmi3LogMessageCallback = void (*)(fmi3InstanceEnvironment, fmi3Status, fmi3String category,
                                        fmi3String message);
}

namespace ambrig {

template <class Work>
fmi3Status Do3(fmi3Instance c, Work&& work) {
  const bool worked = Worked(static_cast<FmuComponent*>(c), std::forward<Work>(work));
  return worked ? fmi3OK : fmi3Error;
}

/// Of a function that an FMU of this kind has no use for.
inline fmi3Status NotProvided3(fmi3Instance c, const char* what) {
  return Do3(c, [what](FmuInstance&) { throw InputError(what); });
}

}  // namespace ambrig
