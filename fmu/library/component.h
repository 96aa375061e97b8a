#pragma once
/// What stands behind the handle of an instance, in both versions of FMI: the instance, who is told
/// of errors, and how an exception becomes a status.
#include <exception>
#include <functional>
#include <memory>
#include <string>
#include <utility>

#include "fmu/instance.h"

namespace ambrig {

struct FmuComponent {
  enum class Told { kEvent, kError };

  std::string resources;
  std::function<void(Told, const std::string&)> tell;
  bool events = false;  // told too
  std::unique_ptr<FmuInstance> fmu;

  /// @throws InputError when the folder is no FMU of ambrig or another one than `token` says.
  static std::unique_ptr<FmuComponent> Make(const std::string& resources, const std::string& token,
                                            std::function<void(Told, const std::string&)> tell);

  void TellEvents() {
    for (const std::string& line : fmu->TakeEvents())
      if (events) tell(Told::kEvent, line);
  }
};

/// Whether `work` went through; otherwise its reason was told.
template <class Work>
bool Worked(FmuComponent* component, Work&& work) {
  if (!component) return false;
  try {
    std::forward<Work>(work)(*component->fmu);
    return true;
  } catch (const std::exception& e) {
    component->tell(FmuComponent::Told::kError, e.what());
  } catch (...) {
    component->tell(FmuComponent::Told::kError, "an unknown error");
  }
  return false;
}

/// The folder that a URI "file:///..." (FMI 2.0) or a path (FMI 3.0) names.
std::string FolderOfUri(const std::string& uri);

}  // namespace ambrig
