/// FMI 3.0: values of variables. A rig has Float64, Int64 and Boolean, all scalar.
#include "fmu/library/fmi3_api.h"

using namespace ambrig;  // NOLINT: the functions below belong to the standard

namespace {

using Type = FmuVariable::Type;

/// @throws InputError for a variable of another type, or for more or fewer values than variables.
void CheckScalars(const FmuInstance& fmu, const fmi3ValueReference* r, std::size_t n,
                  std::size_t values, Type type, const char* words) {
  if (n != values) throw InputError("nValues differs from nValueReferences, allowed: scalars only");
  for (std::size_t k = 0; k < n; ++k)
    if (r[k] < fmu.variables().size() && fmu.variables()[r[k]].type != type)
      throw InputError(fmu.variables()[r[k]].name + " is not " + words);
}

template <class Value>
fmi3Status GetScalars(fmi3Instance c, const fmi3ValueReference* r, std::size_t n, Value* values,
                      std::size_t count, Type type, const char* words) {
  return Do3(c, [&](FmuInstance& fmu) {
    CheckScalars(fmu, r, n, count, type, words);
    for (std::size_t k = 0; k < n; ++k) values[k] = static_cast<Value>(fmu.Get(r[k]));
  });
}

template <class Value>
fmi3Status SetScalars(fmi3Instance c, const fmi3ValueReference* r, std::size_t n,
                      const Value* values, std::size_t count, Type type, const char* words) {
  return Do3(c, [&](FmuInstance& fmu) {
    CheckScalars(fmu, r, n, count, type, words);
    for (std::size_t k = 0; k < n; ++k) fmu.Set(r[k], static_cast<double>(values[k]));
  });
}

fmi3Status NoneOf(fmi3Instance c, std::size_t n) {
  return n == 0 && c ? fmi3OK : NotProvided3(c, "the FMU has no variable of this type");
}

}  // namespace

AMBRIG_FMI fmi3Status fmi3GetFloat64(fmi3Instance c, const fmi3ValueReference* r, std::size_t n,
                                     double* values, std::size_t count) {
  return GetScalars(c, r, n, values, count, Type::kReal, "a Float64");
}
AMBRIG_FMI fmi3Status fmi3SetFloat64(fmi3Instance c, const fmi3ValueReference* r, std::size_t n,
                                     const double* values, std::size_t count) {
  return SetScalars(c, r, n, values, count, Type::kReal, "a Float64");
}
AMBRIG_FMI fmi3Status fmi3GetInt64(fmi3Instance c, const fmi3ValueReference* r, std::size_t n,
                                   std::int64_t* values, std::size_t count) {
  return GetScalars(c, r, n, values, count, Type::kInteger, "an Int64");
}
AMBRIG_FMI fmi3Status fmi3SetInt64(fmi3Instance c, const fmi3ValueReference* r, std::size_t n,
                                   const std::int64_t* values, std::size_t count) {
  return SetScalars(c, r, n, values, count, Type::kInteger, "an Int64");
}
AMBRIG_FMI fmi3Status fmi3GetBoolean(fmi3Instance c, const fmi3ValueReference* r, std::size_t n,
                                     bool* values, std::size_t count) {
  return GetScalars(c, r, n, values, count, Type::kBoolean, "a Boolean");
}
AMBRIG_FMI fmi3Status fmi3SetBoolean(fmi3Instance c, const fmi3ValueReference* r, std::size_t n,
                                     const bool* values, std::size_t count) {
  return SetScalars(c, r, n, values, count, Type::kBoolean, "a Boolean");
}

#define AMBRIG_NO_VARIABLE(NAME, VALUE)                                                         \
  AMBRIG_FMI fmi3Status fmi3Get##NAME(fmi3Instance c, const fmi3ValueReference*, std::size_t n, \
                                      VALUE*, std::size_t) {                                    \
    return NoneOf(c, n);                                                                        \
  }                                                                                             \
  AMBRIG_FMI fmi3Status fmi3Set##NAME(fmi3Instance c, const fmi3ValueReference*, std::size_t n, \
                                      const VALUE*, std::size_t) {                              \
    return NoneOf(c, n);                                                                        \
  }
AMBRIG_NO_VARIABLE(Float32, float)
AMBRIG_NO_VARIABLE(Int8, std::int8_t)
AMBRIG_NO_VARIABLE(UInt8, std::uint8_t)
AMBRIG_NO_VARIABLE(Int16, std::int16_t)
AMBRIG_NO_VARIABLE(UInt16, std::uint16_t)
AMBRIG_NO_VARIABLE(Int32, std::int32_t)
AMBRIG_NO_VARIABLE(UInt32, std::uint32_t)
AMBRIG_NO_VARIABLE(UInt64, std::uint64_t)
AMBRIG_NO_VARIABLE(String, fmi3String)
#undef AMBRIG_NO_VARIABLE

AMBRIG_FMI fmi3Status fmi3GetBinary(fmi3Instance c, const fmi3ValueReference*, std::size_t n,
                                    std::size_t*, fmi3Binary*, std::size_t) {
  return NoneOf(c, n);
}
AMBRIG_FMI fmi3Status fmi3SetBinary(fmi3Instance c, const fmi3ValueReference*, std::size_t n,
                                    const std::size_t*, const fmi3Binary*, std::size_t) {
  return NoneOf(c, n);
}
AMBRIG_FMI fmi3Status fmi3GetClock(fmi3Instance c, const fmi3ValueReference*, std::size_t n,
                                   fmi3Clock*) {
  return NoneOf(c, n);
}
AMBRIG_FMI fmi3Status fmi3SetClock(fmi3Instance c, const fmi3ValueReference*, std::size_t n,
                                   const fmi3Clock*) {
  return NoneOf(c, n);
}
