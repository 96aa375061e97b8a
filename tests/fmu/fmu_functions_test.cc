/// What the library of an FMU shows: every function of the standard, nothing else, no library of
/// ours.
#include <gtest/gtest.h>

#include <set>
#include <sstream>

#include "tests/fmu/exported.h"

namespace ambrig::testing {
namespace {

const std::set<std::string> kFunctions2 = {"fmi2GetTypesPlatform",
                                           "fmi2GetVersion",
                                           "fmi2SetDebugLogging",
                                           "fmi2Instantiate",
                                           "fmi2FreeInstance",
                                           "fmi2SetupExperiment",
                                           "fmi2EnterInitializationMode",
                                           "fmi2ExitInitializationMode",
                                           "fmi2Terminate",
                                           "fmi2Reset",
                                           "fmi2GetReal",
                                           "fmi2GetInteger",
                                           "fmi2GetBoolean",
                                           "fmi2GetString",
                                           "fmi2SetReal",
                                           "fmi2SetInteger",
                                           "fmi2SetBoolean",
                                           "fmi2SetString",
                                           "fmi2GetFMUstate",
                                           "fmi2SetFMUstate",
                                           "fmi2FreeFMUstate",
                                           "fmi2SerializedFMUstateSize",
                                           "fmi2SerializeFMUstate",
                                           "fmi2DeSerializeFMUstate",
                                           "fmi2GetDirectionalDerivative",
                                           "fmi2SetRealInputDerivatives",
                                           "fmi2GetRealOutputDerivatives",
                                           "fmi2DoStep",
                                           "fmi2CancelStep",
                                           "fmi2GetStatus",
                                           "fmi2GetRealStatus",
                                           "fmi2GetIntegerStatus",
                                           "fmi2GetBooleanStatus",
                                           "fmi2GetStringStatus"};

std::set<std::string> Functions3() {
  std::istringstream names(
      "GetVersion SetDebugLogging InstantiateModelExchange InstantiateCoSimulation "
      "InstantiateScheduledExecution FreeInstance EnterInitializationMode ExitInitializationMode "
      "EnterEventMode Terminate Reset GetFloat32 GetFloat64 GetInt8 GetUInt8 GetInt16 GetUInt16 "
      "GetInt32 GetUInt32 GetInt64 GetUInt64 GetBoolean GetString GetBinary GetClock SetFloat32 "
      "SetFloat64 SetInt8 SetUInt8 SetInt16 SetUInt16 SetInt32 SetUInt32 SetInt64 SetUInt64 "
      "SetBoolean SetString SetBinary SetClock GetNumberOfVariableDependencies "
      "GetVariableDependencies GetFMUState SetFMUState FreeFMUState SerializedFMUStateSize "
      "SerializeFMUState DeserializeFMUState GetDirectionalDerivative GetAdjointDerivative "
      "EnterConfigurationMode ExitConfigurationMode GetIntervalDecimal GetIntervalFraction "
      "GetShiftDecimal GetShiftFraction SetIntervalDecimal SetIntervalFraction SetShiftDecimal "
      "SetShiftFraction EvaluateDiscreteStates UpdateDiscreteStates EnterContinuousTimeMode "
      "CompletedIntegratorStep SetTime SetContinuousStates GetContinuousStateDerivatives "
      "GetEventIndicators GetContinuousStates GetNominalsOfContinuousStates "
      "GetNumberOfEventIndicators GetNumberOfContinuousStates EnterStepMode GetOutputDerivatives "
      "DoStep ActivateModelPartition");
  std::set<std::string> all;
  for (std::string name; names >> name;) all.insert("fmi3" + name);
  return all;
}

TEST(FmuFunctions, TheLibraryShowsTheStandardAndNothingElse) {
  const Exported exported("2.0");
  const Importer fmu(exported.fmu);
  EXPECT_EQ(kFunctions2.size(), 34U);
  std::set<std::string> wanted = Functions3();
  wanted.insert(kFunctions2.begin(), kFunctions2.end());
  std::istringstream shown(Shell("nm -D --defined-only " + fmu.LibraryFile()).text);
  std::set<std::string> found;
  for (std::string address, kind, name; shown >> address >> kind >> name;) found.insert(name);
  EXPECT_EQ(found, wanted);
  // What it needs: the C library and NLopt, which comes with it.
  std::istringstream needs(Shell("readelf -d " + fmu.LibraryFile() + " | grep NEEDED").text);
  for (std::string line; std::getline(needs, line);) {
    const std::string name = line.substr(line.find('[') + 1);
    EXPECT_TRUE(name.starts_with("libc.so") || name.starts_with("libm.so") ||
                name.starts_with("libnlopt.so") || name.starts_with("ld-linux"))
        << line;
  }
}

TEST(FmuFunctions, WhatFmi2DoesNotProvideAnswersSo) {
  const Exported exported("2.0");
  const Importer fmu(exported.fmu);
  void* const c = fmu.instance;
  EXPECT_STREQ(fmu.Call<const char*>("GetTypesPlatform"), "default");
  EXPECT_STREQ(fmu.Call<const char*>("GetVersion"), "2.0");
  EXPECT_EQ(fmu.Call<int>("SetDebugLogging", c, 1, std::size_t{0}, static_cast<void*>(nullptr)), 0);
  fmu.Initialize();
  const unsigned one = 1;
  const int order = 1;
  double value = 1;
  int whole = 0;
  const char* text = nullptr;
  const std::size_t n = 1;
  EXPECT_EQ(fmu.Call<int>("GetDirectionalDerivative", c, &one, n, &one, n,
                          static_cast<const double*>(&value), &value),
            3);
  EXPECT_EQ(LastMessage(), "directional derivatives are not provided");
  EXPECT_EQ(fmu.Call<int>("GetRealOutputDerivatives", c, &one, n, &order, &value), 3);
  EXPECT_EQ(fmu.Call<int>("SetRealInputDerivatives", c, &one, n, &order,
                          static_cast<const double*>(&value)),
            3);
  const unsigned speed = fmu.interface.variables.at("speed").reference;
  EXPECT_EQ(fmu.Call<int>("SetRealInputDerivatives", c, &speed, n, &order,
                          static_cast<const double*>(&value)),
            0);
  EXPECT_EQ(fmu.Get("acceleration"), 1);
  EXPECT_EQ(fmu.Call<int>("GetString", c, &one, n, &text), 3);
  EXPECT_EQ(fmu.Call<int>("SetString", c, &one, n, &text), 3);
  EXPECT_EQ(fmu.Call<int>("CancelStep", c), 3);
  EXPECT_EQ(fmu.Step(0, 1e-3), 0);
  EXPECT_NEAR(fmu.Get("omega"), 1e-3, 1e-12);
  EXPECT_EQ(fmu.Call<int>("GetStatus", c, 0, &whole), 2);
  EXPECT_EQ(fmu.Call<int>("GetRealStatus", c, 2, &value), 0);
  EXPECT_EQ(value, 1e-3);
  EXPECT_EQ(fmu.Call<int>("GetIntegerStatus", c, 0, &whole), 2);
  EXPECT_EQ(fmu.Call<int>("GetBooleanStatus", c, 3, &whole), 0);
  EXPECT_EQ(whole, 0);
  EXPECT_EQ(fmu.Call<int>("GetStringStatus", c, 1, &text), 2);
  EXPECT_EQ(fmu.Call<int>("DoStep", static_cast<void*>(nullptr), 0.0, 1.0, 1), 3);
}

TEST(FmuFunctions, WhatFmi3DoesNotProvideAnswersSo) {
  const Exported exported("3.0");
  const Importer fmu(exported.fmu);
  void* const c = fmu.instance;
  EXPECT_STREQ(fmu.Call<const char*>("GetVersion"), "3.0");
  fmu.Initialize();
  for (const char* name :
       {"EnterEventMode", "EnterStepMode", "EvaluateDiscreteStates", "EnterConfigurationMode",
        "ExitConfigurationMode", "EnterContinuousTimeMode"})
    EXPECT_EQ(fmu.Call<int>(name, c), 3) << name;
  std::size_t count = 7;
  EXPECT_EQ(fmu.Call<int>("GetNumberOfContinuousStates", c, &count), 0);
  EXPECT_EQ(count, 0U);
  const unsigned one = 1;
  double value = 0;
  float small = 0;
  const std::size_t n = 1;
  EXPECT_EQ(fmu.Call<int>("GetFloat32", c, &one, n, &small, n), 3);
  EXPECT_EQ(LastMessage(), "the FMU has no variable of this type");
  EXPECT_EQ(fmu.Call<int>("GetFloat32", c, &one, std::size_t{0}, &small, std::size_t{0}), 0);
  EXPECT_EQ(fmu.Call<int>("GetFloat64", c, &one, n, &value, std::size_t{2}), 3);
  EXPECT_EQ(fmu.Call<int>("GetDirectionalDerivative", c, &one, n, &one, n,
                          static_cast<const double*>(&value), n, &value, n),
            3);
  EXPECT_EQ(LastMessage(), "derivatives are not provided");
}

TEST(FmuFunctions, TwoExportsAreTheSameBytesAndForeignFilesAreKept) {
  const Exported exported("2.0");
  const std::string first = ReadBytes(exported.fmu);
  EXPECT_EQ(exported.folder.Ambrig("export rig.toml --fmu rig.fmu").exit, 0);
  EXPECT_EQ(ReadBytes(exported.fmu), first);
  exported.folder.Write("mine.fmu", "not ours");
  const Outcome refused = exported.folder.Ambrig("export rig.toml --fmu mine.fmu");
  EXPECT_EQ(refused.exit, 2);
  EXPECT_NE(refused.text.find("mine.fmu exists and is not an output of ambrig"), std::string::npos)
      << refused.text;
  EXPECT_EQ(exported.folder.Read("mine.fmu"), "not ours");
}

}  // namespace
}  // namespace ambrig::testing
