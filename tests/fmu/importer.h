#pragma once
/// A small importer of FMUs for co-simulation, FMI 2.0 and 3.0: unpacks, loads, finds every
/// function by its name. Written from the standard; nothing of fmu/ is in it.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <cstdarg>
#include <filesystem>
#include <string>
#include <vector>

#include "control/external/fmu_description.h"
#include "core/base/zip_file.h"
#include "tests/core/temporary_folder.h"

namespace ambrig::testing {

inline std::string& LastMessage() {
  static std::string text;
  return text;
}

inline void Log2(void*, const char*, int status, const char*, const char* message, ...) {
  char text[1000];
  va_list list;
  va_start(list, message);
  std::vsnprintf(text, sizeof text, message, list);
  va_end(list);
  if (status >= 2) LastMessage() = text;
}
inline void Log3(void*, int status, const char*, const char* message) {
  if (status >= 2) LastMessage() = message;
}

/// An unpacked FMU and one instance of it.
class Importer {
 public:
  explicit Importer(const std::string& fmu) : Importer(fmu, nullptr) {}
  /// Another instance of the same library.
  explicit Importer(const Importer& other) : Importer("", &other) {}
  Importer& operator=(const Importer&) = delete;
  ~Importer() {
    if (instance) Call<void>("FreeInstance", instance);
  }

  /// fmi2NAME or fmi3NAME.
  template <class Result, class... Arguments>
  Result Call(const std::string& name, Arguments... arguments) const {
    void* p = dlsym(library_, ((two() ? "fmi2" : "fmi3") + name).c_str());
    EXPECT_NE(p, nullptr) << name;
    return reinterpret_cast<Result (*)(Arguments...)>(p)(arguments...);
  }
  bool two() const { return interface.fmi == 2; }
  bool Has(const std::string& name) const { return dlsym(library_, name.c_str()) != nullptr; }
  std::string LibraryFile() const {
    return folder_ + "/binaries/" + (two() ? "linux64/" : "x86_64-linux/") + interface.identifier +
           ".so";
  }

  void Instantiate(const std::string& token) {
    if (two()) {
      instance = Call<void*>("Instantiate", "rig", 1, token.c_str(),
                             ("file://" + folder_ + "/resources").c_str(),
                             static_cast<const void*>(&callbacks_), 0, 0);
    } else {
      const std::string place = folder_ + "/resources/";
      instance =
          Call<void*>("InstantiateCoSimulation", "rig", token.c_str(), place.c_str(), false, false,
                      false, false, static_cast<const unsigned*>(nullptr), std::size_t{0},
                      static_cast<void*>(nullptr), &Log3, static_cast<void*>(nullptr));
    }
  }
  int EnterInitialization(double start = 0) const {
    if (!two())
      return Call<int>("EnterInitializationMode", instance, false, 0.0, start, false, 0.0);
    const int status = Call<int>("SetupExperiment", instance, 0, 0.0, start, 0, 0.0);
    return status == 0 ? Call<int>("EnterInitializationMode", instance) : status;
  }
  int ExitInitialization() const { return Call<int>("ExitInitializationMode", instance); }
  void Initialize() const {
    EXPECT_EQ(EnterInitialization(), 0);
    EXPECT_EQ(ExitInitialization(), 0);
  }

  int Set(const std::string& name, double value) const {
    const FmuInterface::Variable& v = interface.variables.at(name);
    const unsigned r = v.reference;
    const std::size_t one = 1;
    const bool yes = value != 0;
    const int whole = v.type == 'b' ? yes : static_cast<int>(value);
    const auto longer = static_cast<long long>(value);
    const unsigned* at = &r;
    if (two() && v.type == 'r') return Call<int>("SetReal", instance, at, one, &value);
    if (two())
      return Call<int>(v.type == 'b' ? "SetBoolean" : "SetInteger", instance, at, one, &whole);
    if (v.type == 'r') return Call<int>("SetFloat64", instance, at, one, &value, one);
    if (v.type == 'b') return Call<int>("SetBoolean", instance, at, one, &yes, one);
    return Call<int>("SetInt64", instance, at, one, &longer, one);
  }
  double Get(const std::string& name) const {
    const FmuInterface::Variable& v = interface.variables.at(name);
    const unsigned r = v.reference;
    const std::size_t one = 1;
    double real = 0;
    int whole = 0;
    bool yes = false;
    long long longer = 0;
    const unsigned* at = &r;
    int status = 0;
    if (v.type == 'r') {
      status = two() ? Call<int>("GetReal", instance, at, one, &real)
                     : Call<int>("GetFloat64", instance, at, one, &real, one);
    } else if (two()) {
      status = Call<int>(v.type == 'b' ? "GetBoolean" : "GetInteger", instance, at, one, &whole);
      real = whole;
    } else if (v.type == 'b') {
      status = Call<int>("GetBoolean", instance, at, one, &yes, one);
      real = yes;
    } else {
      status = Call<int>("GetInt64", instance, at, one, &longer, one);
      real = static_cast<double>(longer);
    }
    EXPECT_EQ(status, 0) << name << ": " << LastMessage();
    return real;
  }
  int Step(double t, double h) const {
    if (two()) return Call<int>("DoStep", instance, t, h, 1);
    bool event = true, end = true, early = true;
    double last = -1;
    const int status = Call<int>("DoStep", instance, t, h, true, &event, &end, &early, &last);
    EXPECT_FALSE(event || end || early);
    if (status == 0) {
      EXPECT_EQ(last, t + h);
    }
    return status;
  }
  /// Values of these variables.
  std::vector<double> Values(const std::vector<std::string>& names) const {
    std::vector<double> values;
    for (const std::string& name : names) values.push_back(Get(name));
    return values;
  }
  std::vector<std::string> Names(const std::string& causality) const {
    std::vector<std::string> names;
    for (const auto& [name, v] : interface.variables)
      if (v.causality == causality) names.push_back(name);
    return names;
  }

  FmuInterface interface;
  void* instance = nullptr;

 private:
  Importer(const std::string& fmu, const Importer* other) {
    if (other) {
      folder_ = other->folder_;
    } else {
      folder_ = own_.File("unpacked");
      std::filesystem::create_directories(folder_);
      UnpackZip(fmu, folder_);
    }
    interface = ReadFmuInterface(folder_ + "/modelDescription.xml", fmu);
    library_ = dlopen(LibraryFile().c_str(), RTLD_NOW | RTLD_LOCAL);
    EXPECT_NE(library_, nullptr) << dlerror();
    Instantiate(interface.token);
    EXPECT_NE(instance, nullptr) << LastMessage();
  }

  struct Callbacks2 {
    void (*logger)(void*, const char*, int, const char*, const char*, ...) = Log2;
    void* (*allocate)(std::size_t, std::size_t) = std::calloc;
    void (*release)(void*) = std::free;
    void (*finished)(void*, int) = nullptr;
    void* environment = nullptr;
  };
  const Callbacks2 callbacks_;
  TemporaryFolder own_;
  std::string folder_;
  void* library_ = nullptr;
};

}  // namespace ambrig::testing
