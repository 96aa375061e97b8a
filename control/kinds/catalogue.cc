/// The catalogue of controllers: one line per file of this folder.
#include "control/interface/controller_kind.h"

// In the order of the documentation.
#define AMBRIG_CONTROLLERS(CONTROLLER)  \
  CONTROLLER(PidKind)                   \
  CONTROLLER(DutyPidKind)               \
  CONTROLLER(StateFeedbackKind)         \
  CONTROLLER(FeedbackLinearisationKind) \
  CONTROLLER(TransferFunctionKind)      \
  CONTROLLER(StateSpaceKind)            \
  CONTROLLER(LqgKind)                   \
  CONTROLLER(HInfinityKind)             \
  CONTROLLER(TiltTranslationKind)       \
  CONTROLLER(LibraryKind)               \
  CONTROLLER(SocketKind)                \
  CONTROLLER(FmuKind)                   \
  CONTROLLER(NoneKind)

namespace ambrig {

#define AMBRIG_DECLARE(name) const ControllerKind& name();
AMBRIG_CONTROLLERS(AMBRIG_DECLARE)
#undef AMBRIG_DECLARE

std::span<const ControllerKind* const> ControllerKinds() {
#define AMBRIG_ADDRESS(name) &name(),
  static const ControllerKind* const all[] = {AMBRIG_CONTROLLERS(AMBRIG_ADDRESS)};
#undef AMBRIG_ADDRESS
  return all;
}

std::string ControllerKindNames() {
  std::string names;
  for (const ControllerKind* k : ControllerKinds())
    names += (names.empty() ? "" : ", ") + std::string(k->name);
  return names;
}

const ControllerKind& ControllerKindByName(std::string_view name) {
  for (const ControllerKind* k : ControllerKinds())
    if (k->name == name) return *k;
  Require(false, "a kind of controller of the catalogue");
  return *ControllerKinds().front();
}

}  // namespace ambrig
